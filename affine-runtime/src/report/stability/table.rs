//! A stability report as a table in the terminal and as comma-separated values.

use core::fmt;
use std::path::Path;

use super::{Demand, Finding, StabilityCase, StabilityReport, Verdict};
use crate::error::Result;
use crate::report::save;
use crate::simulate::csv_line;

impl StabilityReport {
    /// The cases as comma-separated values below a line of names: `heading`, `model`, `n`, `scene`, `quantity`, `oracle`,
    /// `demanded`, `error`, `steps`, `verdict`, `stopped`.
    #[must_use]
    pub fn to_csv(&self) -> String {
        let head = [
            "heading", "model", "n", "scene", "quantity", "oracle", "demanded", "error", "steps", "verdict",
            "stopped",
        ];
        let rows = self.cases().iter().map(|case| {
            let (error, steps, stopped) = match &case.finding {
                Finding::Ran { error, steps } => (format!("{error:e}"), steps.to_string(), String::new()),
                Finding::Stopped(text) => (String::new(), String::new(), text.clone()),
            };
            vec![
                case.heading.to_owned(),
                case.model.to_owned(),
                case.n.to_string(),
                case.scene.clone(),
                case.quantity.to_owned(),
                case.oracle.name().to_owned(),
                demanded(case),
                error,
                steps,
                case.verdict().name().to_owned(),
                stopped,
            ]
        });
        core::iter::once(head.map(str::to_owned).to_vec()).chain(rows).map(csv_line).collect()
    }

    /// Writes [`to_csv`](Self::to_csv) to a file.
    ///
    /// # Errors
    /// [`Error::File`](crate::Error::File) with path and kind of the failure.
    pub fn save_csv(&self, path: impl AsRef<Path>) -> Result<()> {
        save(path.as_ref(), &self.to_csv())
    }
}

impl fmt::Display for StabilityReport {
    /// Headings, a line per case, and the words of every refusal.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let width = |text: fn(&StabilityCase) -> &str| {
            self.cases().iter().map(|case| text(case).chars().count()).max().unwrap_or(0)
        };
        let (model, scene) = (width(|case| case.model), width(|case| &case.scene));
        let quantity = width(|case| case.quantity);
        let mut heading = "";
        for case in self.cases() {
            if case.heading != heading {
                heading = case.heading;
                writeln!(f, "\n{heading}")?;
            }
            let (error, steps) = match &case.finding {
                Finding::Ran { error, steps } => (format!("{error:.1e}"), steps.to_string()),
                Finding::Stopped(_) => ("-".to_owned(), "-".to_owned()),
            };
            writeln!(
                f,
                "  {:10}  {:model$} n = {}  {:scene$}  {:quantity$}  {:11}  {error:>8} of {:>8}  {steps:>8} steps",
                case.verdict().name(),
                case.model,
                case.n,
                case.scene,
                case.quantity,
                case.oracle.name(),
                demanded(case),
            )?;
            if let Finding::Stopped(text) = &case.finding {
                writeln!(f, "              {text}")?;
            }
        }
        let count = |verdict| self.cases().iter().filter(|case| case.verdict() == verdict).count();
        writeln!(
            f,
            "\n{} cases: {} held, {} refused in words, {} fell short",
            self.cases().len(),
            count(Verdict::Held),
            count(Verdict::Refused),
            count(Verdict::FellShort)
        )
    }
}

fn demanded(case: &StabilityCase) -> String {
    match case.demand {
        Demand::Held(most) | Demand::HeldOrRefused(most) => format!("{most:.1e}"),
        Demand::Refused(_) => "refusal".to_owned(),
    }
}
