//! A trajectory as a page on which the body moves: `page.html` with the data of the run, drawn by `page.js`.

use core::fmt;
use std::path::Path;

use pulldown_latex::config::DisplayMode;
use pulldown_latex::{Parser, RenderConfig, Storage, push_mathml};

use super::picture::{Samples, log_stretches, summary};
use super::{escaped, reproduction, save};
use crate::error::Result;
use crate::model::Formula;
use crate::parametric::{Field, Fields};
use crate::simulate::{Drift, Trajectory};
use crate::state::Phase;

/// The page, with comments where something is filled in.
const PAGE: &str = include_str!("page.html");
/// What draws it.
const SCRIPT: &str = include_str!("page.js");

/// A page of a run being made, [`Trajectory::page`].
#[derive(Clone, Debug)]
pub struct Page<'a, const N: usize, P> {
    run: &'a Trajectory<N, P>,
    fields: Vec<(&'static str, Vec<f64>)>,
    program: Option<String>,
}

impl<const N: usize, P: Phase<N>> Trajectory<N, P> {
    /// The trajectory as one page of HTML that needs nothing else, no network either: the body in motion, the deformed unit
    /// ball or disc `x + phi u` with its axes and the path of its centre, by WebGL 2, with a time to scrub; log-stretches,
    /// energies and relative drifts over time; what is conserved; why the run was made as it was; events; the formulas of the
    /// model; the settings, and a program that makes the run again. It can be worked by keyboard, and read on a phone and in the
    /// dark.
    ///
    /// Between outputs `x` and `phi` are drawn along straight lines: ask for as many outputs as a smooth motion needs. An output
    /// takes some 300 bytes. Bodies of a model with `metrics(...)` are drawn in orthonormal bases.
    ///
    /// ```no_run
    /// use affine_runtime::prelude::*;
    ///
    /// #[affine_model(dim = 3, kinetic(dalembert = 1, space_translation = 1), potential = orthogonality(k) + x[3])]
    /// struct Block { k: f64 }
    ///
    /// let block = Block { k: 2.0 };
    /// let model = block.prepare()?;
    /// let (x, v) = (Vector::<3>::zeros(), Vector::<3>::new(1.0, 0.0, 3.0));
    /// let start = model.at_velocity(x, Matrix::<3>::identity(), v, Matrix::<3>::new(0.2, -1.0, 0.0, 1.0, 0.0, 0.5, 0.0, 0.0, -0.3))?;
    /// let run = Simulation::new(&model, start).until(5.0).every(0.02).run()?;
    /// run.save_html("block.html")?;
    /// // The run does not know the fields of its model; the page can.
    /// run.page().fields(&block).save("block.html")?;
    /// # Ok::<(), affine_runtime::Error>(())
    /// ```
    #[must_use]
    pub fn to_html(&self) -> String {
        self.page().to_html()
    }

    /// Writes the page of [`to_html`](Self::to_html) to a file.
    ///
    /// # Errors
    /// [`Error::File`](crate::Error::File) with path and kind of the failure.
    pub fn save_html(&self, path: impl AsRef<Path>) -> Result<()> {
        self.page().save(path)
    }

    /// The page of [`to_html`](Self::to_html), to which more can be added.
    #[must_use]
    pub fn page(&self) -> Page<'_, N, P> {
        Page { run: self, fields: Vec::new(), program: None }
    }
}

impl<const N: usize, P: Phase<N>> Page<'_, N, P> {
    /// Shows the values of the fields of the model, which the run does not keep.
    #[must_use]
    pub fn fields<F: Fields<N>>(mut self, fields: &F) -> Self {
        let values = fields.values();
        let mut values = values.as_ref().iter().copied();
        let mut value = |field: &Field| (field.name, values.by_ref().take(field.rows * field.rows).collect());
        self.fields = F::FIELDS.iter().map(&mut value).collect();
        self
    }

    /// Shows a program, as `include_str!(..)` gives it, in place of the one that is derived from the run.
    #[must_use]
    pub fn program(self, text: impl Into<String>) -> Self {
        Self { program: Some(text.into()), ..self }
    }

    /// The page as one document.
    #[must_use]
    pub fn to_html(&self) -> String {
        let run = self.run;
        let name = escaped(run.description().name);
        let program = self.program.clone().unwrap_or_else(|| reproduction::program(run, &self.fields));
        // In the order in which they stand.
        let parts = [
            ("<!--title-->", name.clone()),
            ("<!--title-->", name),
            ("<!--caption-->", escaped(&summary(run))),
            ("<!--conservation-->", run.conservation_table()),
            ("<!--why-->", escaped(&run.why().to_string())),
            ("<!--events-->", run.event_table()),
            ("<!--formulas-->", run.formulas()),
            ("<!--settings-->", table(&["setting", "value"], &reproduction::settings(run, &self.fields))),
            ("<!--program-->", escaped(&program)),
            ("/*data*/", run.data()),
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

    /// Writes [`to_html`](Self::to_html) to a file.
    ///
    /// # Errors
    /// [`Error::File`](crate::Error::File) with path and kind of the failure.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<()> {
        save(path.as_ref(), &self.to_html())
    }
}

impl<const N: usize, P: Phase<N>> Trajectory<N, P> {
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
        let table = self.table();
        let energy = |(name, symbol): (&str, &str)| {
            let values = table.column(name)?.iter().copied();
            Some(object([("symbol", string(symbol)), ("values", list(values.map(number)))]))
        };
        let energies = [("energy", "H"), ("work", "W, work of forces without a potential")];
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
            ("energies", list(energies.into_iter().filter_map(energy))),
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
        let table = match rows.is_empty() {
            true => "<p>Nothing is.</p>".to_owned(),
            false => table(&["quantity", "relative drift", "absolute", "scale"], &rows),
        };
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
        energies.iter().chain(description.equations).map(formula).collect()
    }
}

/// MathML; the plain text where there is none of it, as of a model that the attribute has not made.
fn formula(formula: &Formula) -> String {
    let text = || format!("<pre>{}</pre>\n", escaped(formula.text));
    let Some(latex) = formula.latex else { return text() };
    let (storage, mut mathml) = (Storage::new(), String::new());
    let config = RenderConfig { display_mode: DisplayMode::Block, ..RenderConfig::default() };
    let parsed: core::result::Result<Vec<_>, _> = Parser::new(latex, &storage).collect();
    let written =
        parsed.map(|events| push_mathml(&mut mathml, events.into_iter().map(Ok::<_, fmt::Error>), config));
    match written {
        Ok(Ok(())) => format!("<div class=\"wide\">{mathml}</div>\n"),
        _ => text(),
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
