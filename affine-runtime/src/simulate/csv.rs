//! Tables and trajectories as comma-separated values.

use std::io::{self, BufWriter, Write};
use std::path::Path;

use super::format::Format;
use super::table::{Columns, Table};
use super::trajectory::Trajectory;
use crate::error::Result;
use crate::state::Phase;

impl Table {
    /// Writes a line of names, then a line per row. Numbers are the shortest decimals that read back as the same doubles.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn csv(&self, writer: impl Write) -> io::Result<()> {
        let mut lines = BufWriter::new(writer);
        lines.write_all(csv_line(self.names()).as_bytes())?;
        for row in 0..self.len() {
            lines.write_all(csv_line(self.row(row).map(number)).as_bytes())?;
        }
        lines.flush()
    }
}

impl<const N: usize, P: Phase<N>> Trajectory<N, P> {
    /// Writes the outputs to a file, as [`csv`](Self::csv) does.
    ///
    /// # Errors
    /// [`Error::File`](crate::Error::File) with path and kind of the failure.
    pub fn save_csv(&self, path: impl AsRef<Path>) -> Result<()> {
        self.table().save(path, Format::Csv)
    }

    /// Writes the [`table`](Self::table) of the outputs.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn csv(&self, writer: impl Write) -> io::Result<()> {
        self.table().csv(writer)
    }

    /// Writes the events, a line per event: `event`, its name, `rising`, `true` or `false`, and then time and point under the
    /// names of the [`table`](Self::table).
    ///
    /// # Errors
    /// Those of the writer.
    pub fn events_csv(&self, writer: impl Write) -> io::Result<()> {
        let columns = Columns::<N, P>::of(self.description);
        let mut lines = BufWriter::new(writer);
        let head = ["event", "rising", "t"].map(str::to_owned);
        lines.write_all(csv_line(head.into_iter().chain(columns.names())).as_bytes())?;
        for event in self.events() {
            let head = [event.name.to_owned(), event.rising.to_string(), number(event.t)];
            let point = columns.values(&event.point).into_iter().map(number);
            lines.write_all(csv_line(head.into_iter().chain(point)).as_bytes())?;
        }
        lines.flush()
    }
}

/// The shortest decimals that read back as the same double.
fn number(value: f64) -> String {
    format!("{value:e}")
}

/// A line of fields, of which those stand in quotation marks that would not be read as they are (RFC 4180): with a comma, a quotation
/// mark or an end of a line in them.
pub(crate) fn csv_line(fields: impl IntoIterator<Item = impl AsRef<str>>) -> String {
    let mut line = String::new();
    for field in fields {
        let field = field.as_ref();
        match field.contains([',', '"', '\n', '\r']) {
            true => line.extend(["\"", &field.replace('"', "\"\""), "\","]),
            false => line.extend([field, ","]),
        }
    }
    // Each field has a comma behind it.
    line.pop();
    line.push('\n');
    line
}
