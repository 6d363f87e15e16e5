//! A work-precision report as a table in the terminal and as comma-separated values.

use core::fmt::{self, Write as _};
use std::path::Path;
use std::time::Duration;

use super::work_precision::{Measurement, Row, WorkPrecisionReport};
use super::{method_name, save};
use crate::error::Result;
use crate::simulate::csv_line;

impl WorkPrecisionReport {
    /// The rows as comma-separated values, below a line of names: `model`, `method`, `tolerance`, `error_...` for
    /// each quantity, `steps`, `rejected`, `evaluations`, `series`, `equivalent_evaluations`, `seconds`, `repeats`, `energy_drift`, `above_tolerance`, `stopped`.
    ///
    /// Numbers are the shortest decimals that read back as the same doubles. A field is empty where there is
    /// nothing to say: the tolerance of a closed form, the energy drift of a model that does not conserve energy,
    /// all measurements of a run that stopped. `stopped` is the reason, else empty.
    #[must_use]
    pub fn to_csv(&self) -> String {
        let mut head = vec!["model".to_owned(), "method".to_owned(), "tolerance".to_owned()];
        head.extend(self.quantities().iter().map(|quantity| format!("error_{quantity}")));
        let rest = [
            "steps",
            "rejected",
            "evaluations",
            "series",
            "equivalent_evaluations",
            "seconds",
            "repeats",
            "energy_drift",
            "above_tolerance",
            "stopped",
        ];
        head.extend(rest.map(str::to_owned));
        core::iter::once(head).chain(self.rows().iter().map(|row| self.fields(row))).map(csv_line).collect()
    }

    /// Writes [`to_csv`](Self::to_csv) to a file.
    ///
    /// # Errors
    /// [`Error::File`](crate::Error::File) with path and kind of the failure.
    pub fn save_csv(&self, path: impl AsRef<Path>) -> Result<()> {
        save(path.as_ref(), &self.to_csv())
    }

    fn fields(&self, row: &Row) -> Vec<String> {
        let mut fields = vec![self.model().to_owned(), method_name(row.method).to_owned()];
        fields.push(exponential(row.tolerance));
        match &row.outcome {
            Ok(measured) => {
                fields.extend(measured.errors.iter().map(|&error| exponential(Some(error))));
                let statistics = measured.statistics;
                let counts =
                    [statistics.steps, statistics.rejected, statistics.evaluations, statistics.series];
                fields.extend(counts.map(|count| count.to_string()));
                fields.push(statistics.equivalent_evaluations().to_string());
                fields.push(exponential(Some(measured.run_time.as_secs_f64())));
                fields.push(measured.repeats.to_string());
                fields.push(exponential(measured.energy_drift));
                fields.push(measured.above_tolerance.map_or_else(String::new, |share| share.to_string()));
                fields.push(String::new());
            }
            Err(stop) => {
                fields.extend(vec![String::new(); self.quantities().len() + 9]);
                fields.push(stop.to_string());
            }
        }
        fields
    }
}

fn exponential(value: Option<f64>) -> String {
    value.map_or_else(String::new, |value| format!("{value:e}"))
}

impl fmt::Display for WorkPrecisionReport {
    /// One line per row, in columns; run times in s, ms, µs or ns.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (t0, t_end) = self.interval();
        writeln!(f, "{}: relative errors at t = {t_end} of runs from t = {t0}", self.model())?;
        let mut lines = vec![self.head()];
        lines.extend(self.rows().iter().map(|row| self.line(row)));
        let columns = lines[0].len();
        let width = |column: usize| {
            lines
                .iter()
                .filter_map(|line| line.get(column))
                .map(|cell| cell.chars().count())
                .max()
                .unwrap_or(0)
        };
        let widths: Vec<usize> = (0..columns).map(width).collect();
        for (index, line) in lines.iter().enumerate() {
            let mut text = String::new();
            for (column, cell) in line.iter().enumerate() {
                // The method's name reads from the left, numbers line up at the right.
                match column {
                    0 => write!(text, "{cell:<0$}", widths[0])?,
                    _ => write!(text, "  {cell:>0$}", widths[column])?,
                }
            }
            writeln!(f, "{}", text.trim_end())?;
            if let Some(Row { outcome: Err(stop), .. }) = index.checked_sub(1).map(|row| &self.rows()[row]) {
                writeln!(f, "  {stop}")?;
            }
        }
        Ok(())
    }
}

impl WorkPrecisionReport {
    fn head(&self) -> Vec<String> {
        let mut head = vec!["method".to_owned(), "tolerance".to_owned()];
        head.extend(self.quantities().iter().map(|quantity| format!("err {quantity}")));
        head.extend(
            ["steps", "rejected", "evaluations", "run time", "energy drift", "above tol"].map(str::to_owned),
        );
        head
    }

    fn line(&self, row: &Row) -> Vec<String> {
        let mut line = vec![method_name(row.method).to_owned()];
        line.push(row.tolerance.map_or_else(dash, |tolerance| format!("{tolerance:.0e}")));
        match &row.outcome {
            Ok(measured) => line.extend(cells(measured)),
            Err(_) => line.push("stopped".to_owned()),
        }
        line
    }
}

fn cells(measured: &Measurement) -> Vec<String> {
    let mut cells: Vec<String> = measured.errors.iter().map(|&error| short(error, 2)).collect();
    let statistics = measured.statistics;
    cells.extend([statistics.steps, statistics.rejected].map(|n| n.to_string()));
    // Derived where there are series, and no count.
    let derived = if statistics.series > 0 { "~" } else { "" };
    cells.push(format!("{derived}{}", statistics.equivalent_evaluations()));
    cells.push(in_units(measured.run_time));
    cells.push(measured.energy_drift.map_or_else(dash, |drift| short(drift, 1)));
    cells.push(measured.above_tolerance.map_or_else(dash, |share| format!("{:.0} %", 100.0 * share)));
    cells
}

/// A number in exponential notation; 0 is exact and says so.
fn short(value: f64, decimals: usize) -> String {
    if value == 0.0 { "0".to_owned() } else { format!("{value:.decimals$e}") }
}

fn dash() -> String {
    "-".to_owned()
}

/// Three or more significant digits in the unit that keeps the number below 1000.
fn in_units(time: Duration) -> String {
    let seconds = time.as_secs_f64();
    let (unit, name) = [(1.0, "s "), (1e-3, "ms"), (1e-6, "µs")]
        .into_iter()
        .find(|(unit, _)| seconds >= *unit)
        .unwrap_or((1e-9, "ns"));
    let number = seconds / unit;
    let decimals = if number < 10.0 { 2 } else { usize::from(number < 100.0) };
    format!("{number:.decimals$} {name}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_have_units() {
        for (nanoseconds, text) in
            [(0, "0.00 ns"), (732, "732 ns"), (1_500, "1.50 µs"), (23_400, "23.4 µs"), (7_000_000, "7.00 ms")]
        {
            assert_eq!(in_units(Duration::from_nanos(nanoseconds)), text);
        }
        assert_eq!(in_units(Duration::from_millis(61_500)), "61.5 s ");
    }
}
