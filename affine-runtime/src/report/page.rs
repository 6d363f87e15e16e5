//! A trajectory as a page on which the body moves: `page.html` with the data of the run, drawn by `page.js`.

use std::path::Path;

use super::picture::{Samples, log_stretches, summary};
use super::save;
use crate::error::Result;
use crate::simulate::{Drift, Trajectory};
use crate::state::Phase;

/// The page, with comments where something is filled in.
const PAGE: &str = include_str!("page.html");
/// What draws it.
const SCRIPT: &str = include_str!("page.js");

impl<const N: usize, P: Phase<N>> Trajectory<N, P> {
    /// The trajectory as one page of HTML that needs nothing else, no network either: the body in motion, the deformed unit
    /// ball or disc `x + phi u` with the path of its centre, by WebGL 2, with a time to scrub; log-stretches and relative drifts
    /// over time; what is conserved; why the run was made as it was; events and equations. It can be worked by keyboard, and
    /// read on a phone and in the dark.
    ///
    /// Between outputs `x` and `phi` are drawn along straight lines: ask for as many outputs as a smooth motion needs. An output
    /// takes some 300 bytes. Bodies of a model with `metrics(...)` are drawn in orthonormal bases.
    ///
    /// ```no_run
    /// use affine_runtime::prelude::*;
    ///
    /// #[affine_model(dim = 3, kinetic(dalembert = 1, space_translation = 1), potential = orthogonality(2) + x[3])]
    /// struct Block;
    ///
    /// let (x, v) = (Vector::<3>::zeros(), Vector::<3>::new(1.0, 0.0, 3.0));
    /// let start = Block.at_velocity(x, Matrix::<3>::identity(), v, Matrix::<3>::new(0.2, -1.0, 0.0, 1.0, 0.0, 0.5, 0.0, 0.0, -0.3))?;
    /// Simulation::new(&Block, start).until(5.0).every(0.02).run()?.save_html("block.html")?;
    /// # Ok::<(), affine_runtime::Error>(())
    /// ```
    #[must_use]
    pub fn to_html(&self) -> String {
        let name = escaped(self.description().name);
        // In the order in which they stand.
        let parts = [
            ("<!--title-->", name.clone()),
            ("<!--title-->", name),
            ("<!--caption-->", escaped(&summary(self))),
            ("<!--conservation-->", self.conservation_table()),
            ("<!--why-->", escaped(&self.why().to_string())),
            ("<!--events-->", self.event_table()),
            ("<!--formulas-->", escaped(&self.formulas())),
            ("/*data*/", self.data()),
            ("/*script*/", SCRIPT.to_owned()),
        ];
        let (mut page, mut rest) = (String::new(), PAGE);
        for (place, part) in parts {
            if let Some((before, after)) = rest.split_once(place) {
                page.extend([before, &part]);
                rest = after;
            }
        }
        page + rest
    }

    /// Writes the page of [`to_html`](Self::to_html) to a file.
    ///
    /// # Errors
    /// [`Error::File`](crate::Error::File) with path and kind of the failure.
    pub fn save_html(&self, path: impl AsRef<Path>) -> Result<()> {
        save(path.as_ref(), Ok(self.to_html()))
    }

    /// The numbers of the page as JSON. Matrices stand row by row; what is no number is `null`.
    fn data(&self) -> String {
        let bodies = Samples::of(self).bodies;
        let drift = |drift: &Drift| {
            let values = self.relative_drifts(drift);
            object([
                ("symbol", string(drift.quantity.symbol())),
                ("values", list(values.into_iter().map(number))),
            ])
        };
        let event = |(name, t): (&str, f64)| object([("name", string(name)), ("t", number(t))]);
        let events = self.events().iter().map(|happened| (happened.name, happened.t));
        object([
            ("model", string(self.description().name)),
            ("n", N.to_string()),
            ("t", list(bodies.iter().map(|(t, _)| number(*t)))),
            ("x", list(bodies.iter().map(|(_, body)| list(body.x.iter().copied().map(number))))),
            (
                "phi",
                list(bodies.iter().map(|(_, body)| {
                    let rows = body.phi.transpose();
                    list(rows.iter().copied().map(number))
                })),
            ),
            (
                "stretches",
                list(bodies.iter().map(|(_, body)| list(log_stretches(&body.phi).into_iter().map(number)))),
            ),
            ("outputs", list(self.times().iter().copied().map(number))),
            ("drifts", list(self.conservation().drifts().iter().map(drift))),
            ("events", list(events.map(event))),
        ])
    }

    fn conservation_table(&self) -> String {
        let conservation = self.conservation();
        let row = |drift: &Drift| {
            let numbers = [drift.relative(), drift.absolute, drift.scale].map(|value| format!("{value:.2e}"));
            [drift.quantity.symbol().to_owned()].into_iter().chain(numbers).collect()
        };
        let rows: Vec<Vec<String>> = conservation.drifts().iter().map(row).collect();
        let table = table(&["quantity", "relative drift", "absolute", "scale"], &rows);
        match conservation.balance() {
            Some(balance) => format!("{table}<p>{}</p>", escaped(&balance.to_string())),
            None => table,
        }
    }

    /// Nothing where nothing happened.
    fn event_table(&self) -> String {
        let row = |(name, t): (&str, f64)| vec![name.to_owned(), t.to_string()];
        let rows: Vec<Vec<String>> =
            self.events().iter().map(|happened| row((happened.name, happened.t))).collect();
        if rows.is_empty() {
            return String::new();
        }
        format!("<h2>Events</h2>\n<div class=\"wide\">{}</div>", table(&["event", "t"], &rows))
    }

    fn formulas(&self) -> String {
        let description = self.description();
        let energies = [description.kinetic_energy, description.hamiltonian];
        let all = energies.iter().chain(description.equations);
        all.map(|formula| formula.text).collect::<Vec<_>>().join("\n")
    }
}

fn table(head: &[&str], rows: &[Vec<String>]) -> String {
    let cells = |tag: &str, row: &mut dyn Iterator<Item = &str>| {
        let cells: String = row.map(|cell| format!("<{tag}>{}</{tag}>", escaped(cell))).collect();
        format!("<tr>{cells}</tr>\n")
    };
    let lines: String = rows.iter().map(|row| cells("td", &mut row.iter().map(String::as_str))).collect();
    format!("<table>\n{}{lines}</table>", cells("th", &mut head.iter().copied()))
}

/// Text of HTML.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// The shortest decimals that read back as the same double.
fn number(value: f64) -> String {
    if value.is_finite() { format!("{value:e}") } else { "null".to_owned() }
}

/// A string of JSON, in which nothing ends the element of HTML that it stands in.
fn string(text: &str) -> String {
    let character = |c: char| match c {
        '"' | '\\' | '<' | '\0'..='\u{1f}' => format!("\\u{:04x}", u32::from(c)),
        c => c.to_string(),
    };
    format!("\"{}\"", text.chars().map(character).collect::<String>())
}

fn list(values: impl Iterator<Item = String>) -> String {
    format!("[{}]", values.collect::<Vec<_>>().join(","))
}

fn object<const K: usize>(entries: [(&str, String); K]) -> String {
    let entries = entries.map(|(key, value)| format!("{}:{value}", string(key)));
    format!("{{{}}}", entries.join(","))
}
