//! Work-precision diagrams: run time over true error.

use std::path::Path;

use super::axes::{Area, Axis, Panel};
use super::canvas::{Canvas, Lettering, Pen, Spot};
use super::palette::{Colour, INK, category};
use super::save;
use crate::error::Result;

/// Errors at or below this are drawn at it, above the figure 0: a logarithmic axis has no place for an error of
/// exactly 0, and nothing smaller is an error of double precision.
const LEAST_ERROR: f64 = 1e-17;

/// The page and its parts; its width depends on the legend.
const AREA: Area = Area { left: 84.0, top: 56.0, right: 560.0, bottom: 412.0 };
/// Of panels so many side by side; their size, and what is between the corners of one and the next.
const COLUMNS: usize = 3;
const PANEL: (f64, f64) = (230.0, 190.0);
const STEP: (f64, f64) = (296.0, 254.0);
/// Between panels and what stands beside and below them.
const BESIDE: f64 = 24.0;
const BELOW: f64 = 58.0;
const LEGEND_LINE: f64 = 22.0;
/// From a line of the legend to its text, and the room a character of it takes: the width of most sans-serif
/// fonts' broader letters at this size, since the document leaves the font to its reader.
const LEGEND_TEXT: f64 = 32.0;
const LETTER: f64 = 7.2;

/// A picture of run time over true error, both logarithmic: precision grows to the right, cost upward, as in
/// Hairer and Wanner, Solving Ordinary Differential Equations II. One line per series; the better method is the
/// lower line. Of several problems each has a [panel](Self::panel) of its own, and each name of a series one colour.
#[derive(Clone, Debug, PartialEq)]
pub struct WorkPrecisionDiagram {
    title: String,
    error: String,
    /// At least one.
    parts: Vec<Part>,
}

/// The lines of one panel.
#[derive(Clone, Debug, Default, PartialEq)]
struct Part {
    name: String,
    series: Vec<Series>,
}

/// One line: its name in the legend, and errors with run times in seconds.
#[derive(Clone, Debug, PartialEq)]
struct Series {
    name: String,
    points: Vec<(f64, f64)>,
}

impl WorkPrecisionDiagram {
    /// An empty diagram. `error` names what the errors are errors of, with its time: `relative error of phi at
    /// t = 10`.
    #[must_use]
    pub fn new(title: impl Into<String>, error: impl Into<String>) -> Self {
        Self { title: title.into(), error: error.into(), parts: vec![Part::default()] }
    }

    /// Begins a panel: what is added from here on stands in it.
    #[must_use]
    pub fn panel(mut self, name: impl Into<String>) -> Self {
        // The panel that a new diagram has is there for what is added without one.
        if self.parts == [Part::default()] {
            self.parts.clear();
        }
        self.parts.push(Part { name: name.into(), series: Vec::new() });
        self
    }

    /// Adds the points of one method, joined by a line in this order: true relative errors, each with its run time in seconds.
    #[must_use]
    pub fn series(mut self, name: impl Into<String>, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let series = Series { name: name.into(), points: points.into_iter().collect() };
        if let Some(part) = self.parts.last_mut() {
            part.series.push(series);
        }
        self
    }

    /// Adds lines, for instance [all of a report](super::WorkPrecisionReport::series).
    #[must_use]
    pub fn all(self, series: impl IntoIterator<Item = (String, Vec<(f64, f64)>)>) -> Self {
        series.into_iter().fold(self, |diagram, (name, points)| diagram.series(name, points))
    }

    /// The picture as an SVG document. Points whose error is not a number, or whose run time is not positive,
    /// are left out.
    #[must_use]
    pub fn to_svg(&self) -> String {
        let names = self.names();
        let panels: Vec<Panel> = (0..self.parts.len()).map(|place| self.panel_at(place)).collect();
        let edge =
            |of: fn(&Area) -> f64, least| panels.iter().map(|panel| of(&panel.area)).fold(least, f64::max);
        let (right, bottom) = (edge(|area| area.right, AREA.left), edge(|area| area.bottom, AREA.top));
        let letters = names.iter().map(|name| name.chars().count()).max().unwrap_or(0);
        let width = right + BESIDE + LEGEND_TEXT + LETTER * letters as f64 + 20.0;
        let legend = AREA.top + 14.0 + names.len() as f64 * LEGEND_LINE;
        let height = if legend > bottom + BELOW { legend } else { bottom + BELOW };
        Canvas::draw(width.ceil() as u32, height.ceil() as u32, |canvas| {
            canvas.text(&self.title, (AREA.left, 28.0), Lettering::new(15.0, INK).bold());
            for (place, (part, panel)) in self.parts.iter().zip(&panels).enumerate() {
                let Area { left, top, .. } = panel.area;
                let is_lowest = place + COLUMNS >= panels.len();
                let time = if place % COLUMNS == 0 { "run time" } else { "" };
                panel.frame(canvas, if is_lowest { &self.error } else { "" }, time);
                canvas.text(&part.name, (left, top - 8.0), Lettering::new(12.0, INK).bold());
                for series in &part.series {
                    let index = names.iter().position(|name| *name == series.name).unwrap_or(0);
                    draw_series(canvas, panel, index, series);
                }
            }
            for (index, name) in names.iter().enumerate() {
                explain(canvas, index, name, (right + BESIDE, AREA.top + 14.0 + index as f64 * LEGEND_LINE));
            }
        })
    }

    /// Writes the picture to a file.
    ///
    /// # Errors
    /// [`Error::File`](crate::Error::File) with path and kind of the failure.
    pub fn save_svg(&self, path: impl AsRef<Path>) -> Result<()> {
        save(path.as_ref(), &self.to_svg())
    }

    /// What series are called, in all panels.
    fn names(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        for series in self.parts.iter().flat_map(|part| &part.series) {
            if !names.contains(&series.name.as_str()) {
                names.push(&series.name);
            }
        }
        names
    }

    /// The panel of a part: errors have the same axis in all of them, run times their own.
    fn panel_at(&self, place: usize) -> Panel {
        let points =
            || self.parts.iter().flat_map(|part| &part.series).flat_map(|series| series.points.iter());
        let own = || self.parts[place].series.iter().flat_map(|series| series.points.iter());
        let (area, labels) = match self.parts.len() {
            1 => (AREA, (9, 8)),
            _ => {
                let left = AREA.left + STEP.0 * (place % COLUMNS) as f64;
                let top = AREA.top + 12.0 + STEP.1 * (place / COLUMNS) as f64;
                (Area { left, top, right: left + PANEL.0, bottom: top + PANEL.1 }, (5, 5))
            }
        };
        let figure = |value: f64| if value < LEAST_ERROR { String::new() } else { format!("{value:e}") };
        let mut x = Axis::decades(points().map(|point| drawn_error(point.0)), labels.0, figure).reversed();
        if points().any(|point| point.0 <= LEAST_ERROR) {
            x = x.relabel(LEAST_ERROR, "0");
        }
        let y = Axis::decades(own().map(|point| point.1), labels.1, time_label);
        Panel { area, x, y }
    }
}

fn drawn_error(error: f64) -> f64 {
    if error <= LEAST_ERROR { LEAST_ERROR } else { error }
}

/// 1, 2 or 5 times a power of ten seconds in the unit that makes it a small number.
fn time_label(seconds: f64) -> String {
    let (unit, name) = [(1.0, "s"), (1e-3, "ms"), (1e-6, "µs")]
        .into_iter()
        .find(|(unit, _)| seconds >= 0.999 * unit)
        .unwrap_or((1e-9, "ns"));
    format!("{} {name}", (seconds / unit).round())
}

fn draw_series(canvas: &mut Canvas, panel: &Panel, index: usize, series: &Series) {
    let colour = category(index);
    let points = || series.points.iter().map(|(error, seconds)| (drawn_error(*error), *seconds));
    panel.curve(canvas, points(), Pen::new(colour, 2.0));
    for spot in points().filter_map(|(error, seconds)| panel.spot(error, seconds)) {
        mark(canvas, index, spot, colour);
    }
}

/// A line of the legend.
fn explain(canvas: &mut Canvas, index: usize, name: &str, (x, y): Spot) {
    let colour = category(index);
    canvas.line((x, y), (x + 24.0, y), Pen::new(colour, 2.0));
    mark(canvas, index, (x + 12.0, y), colour);
    canvas.text(name, (x + LEGEND_TEXT, y), Lettering::new(12.0, INK));
}

/// Disc, square, triangle or diamond: with six colours, twelve series look different.
fn mark(canvas: &mut Canvas, index: usize, (x, y): Spot, colour: Colour) {
    match index % 4 {
        0 => canvas.disc((x, y), 4.0, colour),
        1 => canvas.rectangle((x - 3.6, y - 3.6), (x + 3.6, y + 3.6), colour),
        2 => canvas.polygon([(x, y - 5.0), (x + 4.6, y + 3.4), (x - 4.6, y + 3.4)], colour, 1.0),
        _ => canvas.polygon([(x, y - 5.2), (x + 5.2, y), (x, y + 5.2), (x - 5.2, y)], colour, 1.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panels_share_a_legend_and_an_axis_of_errors() {
        let empty = WorkPrecisionDiagram::new("problems", "error");
        let one = empty.panel("first").series("the one", [(1e-3, 1e-3)]).series("the other", [(1e-4, 1e-3)]);
        let diagram = one.panel("second").series("the other", [(1e-9, 1e-3)]);
        assert_eq!(diagram.names(), ["the one", "the other"]);
        let [first, second] = [0, 1].map(|place| diagram.panel_at(place));
        let at = |panel: &Panel| panel.spot(1e-4, 1e-3).map(|(x, _)| x - panel.area.left);
        assert!(at(&first).is_some() && at(&first) == at(&second), "one place for one error");
        let svg = diagram.to_svg();
        for name in ["first", "second", "the one", "the other", "error"] {
            assert!(svg.contains(name), "{name}");
        }
        assert_eq!(svg.matches("the other").count(), 1, "one line of the legend");
    }

    #[test]
    fn times_are_labelled_in_fitting_units() {
        for (seconds, label) in [
            (1e-9, "1 ns"),
            (5e-7, "500 ns"),
            (1e-6, "1 µs"),
            (2e-5, "20 µs"),
            (1e-3, "1 ms"),
            (100.0, "100 s"),
        ] {
            assert_eq!(time_label(seconds), label);
        }
    }
}
