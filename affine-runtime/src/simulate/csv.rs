//! Tables and trajectories as comma-separated values.

use std::io::{self, Write};
use std::path::Path;

use csv::Writer;

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
        let mut lines = Writer::from_writer(writer);
        lines.write_record(self.names())?;
        for row in 0..self.len() {
            lines.write_record(self.row(row).map(number))?;
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
        let mut lines = Writer::from_writer(writer);
        let head = ["event", "rising", "t"].map(str::to_owned);
        lines.write_record(head.into_iter().chain(columns.names()))?;
        for event in self.events() {
            let head = [event.name.to_owned(), event.rising.to_string(), number(event.t)];
            lines
                .write_record(head.into_iter().chain(columns.values(&event.point).into_iter().map(number)))?;
        }
        lines.flush()
    }
}

/// The shortest decimals that read back as the same double.
fn number(value: f64) -> String {
    format!("{value:e}")
}
