//! Work-precision diagrams: run time over true error.

use std::io;
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
const HEIGHT: u32 = 470;
const AREA: Area = Area { left: 84.0, top: 56.0, right: 560.0, bottom: 412.0 };
const LEGEND: Spot = (584.0, 70.0);
const LEGEND_LINE: f64 = 22.0;
/// From a line of the legend to its text, and the room a character of it takes: the width of most sans-serif
/// fonts' broader letters at this size, since the document leaves the font to its reader.
const LEGEND_TEXT: f64 = 32.0;
const LETTER: f64 = 7.2;

/// A picture of run time over true error, both logarithmic: precision grows to the right, cost upward, as in
/// Hairer and Wanner, Solving Ordinary Differential Equations II. One line per series; the better method is the
/// lower line.
#[derive(Clone, Debug, PartialEq)]
pub struct WorkPrecisionDiagram {
    title: String,
    error: String,
    series: Vec<WorkPrecisionSeries>,
}

/// One line of a [`WorkPrecisionDiagram`].
#[derive(Clone, Debug, PartialEq)]
pub struct WorkPrecisionSeries {
    /// Name in the legend.
    pub name: String,
    /// Points, joined in this order.
    pub points: Vec<WorkPrecisionPoint>,
}

/// One measurement of a [`WorkPrecisionSeries`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorkPrecisionPoint {
    /// True relative error.
    pub error: f64,
    /// Run time in seconds.
    pub seconds: f64,
}

impl WorkPrecisionDiagram {
    /// An empty diagram. `error` names what the errors are errors of, with its time: `relative error of phi at
    /// t = 10`.
    #[must_use]
    pub fn new(title: impl Into<String>, error: impl Into<String>) -> Self {
        Self { title: title.into(), error: error.into(), series: Vec::new() }
    }

    /// Adds a line.
    #[must_use]
    pub fn series(mut self, series: WorkPrecisionSeries) -> Self {
        self.series.push(series);
        self
    }

    /// Adds lines, for instance [all of a report](super::WorkPrecisionReport::series).
    #[must_use]
    pub fn all(mut self, series: impl IntoIterator<Item = WorkPrecisionSeries>) -> Self {
        self.series.extend(series);
        self
    }

    /// The picture as an SVG document. Points whose error is not a number, or whose run time is not positive,
    /// are left out.
    ///
    /// # Errors
    /// Those of the drawing library.
    pub fn to_svg(&self) -> io::Result<String> {
        let panel = self.panel();
        let letters = self.series.iter().map(|series| series.name.chars().count()).max().unwrap_or(0);
        let width = (LEGEND.0 + LEGEND_TEXT + LETTER * letters as f64 + 20.0).ceil() as u32;
        let legend = (LEGEND.1 + self.series.len() as f64 * LEGEND_LINE).ceil() as u32;
        Canvas::draw(width, HEIGHT.max(legend), |canvas| {
            canvas.text(&self.title, (AREA.left, 28.0), Lettering::new(15.0, INK).bold());
            panel.frame(canvas, &self.error, "run time");
            for (index, series) in self.series.iter().enumerate() {
                draw_series(canvas, &panel, index, series);
            }
        })
    }

    /// Writes the picture to a file.
    ///
    /// # Errors
    /// [`Error::File`](crate::Error::File) with path and kind of the failure.
    pub fn save_svg(&self, path: impl AsRef<Path>) -> Result<()> {
        save(path.as_ref(), self.to_svg())
    }

    fn panel(&self) -> Panel {
        let points = || self.series.iter().flat_map(|series| series.points.iter());
        let errors = points().map(|point| drawn_error(point.error));
        let figure = |value: f64| if value < LEAST_ERROR { String::new() } else { format!("{value:e}") };
        let mut x = Axis::decades(errors, 9, figure).reversed();
        if points().any(|point| point.error <= LEAST_ERROR) {
            x = x.relabel(LEAST_ERROR, "0");
        }
        let y = Axis::decades(points().map(|point| point.seconds), 8, time_label);
        Panel { area: AREA, x, y }
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

fn draw_series(canvas: &mut Canvas<'_>, panel: &Panel, index: usize, series: &WorkPrecisionSeries) {
    let colour = category(index);
    let points = || series.points.iter().map(|point| (drawn_error(point.error), point.seconds));
    panel.curve(canvas, points(), Pen::new(colour, 2.0));
    for spot in points().filter_map(|(error, seconds)| panel.spot(error, seconds)) {
        mark(canvas, index, spot, colour);
    }
    let spot = (LEGEND.0, LEGEND.1 + index as f64 * LEGEND_LINE);
    canvas.line((spot.0, spot.1), (spot.0 + 24.0, spot.1), Pen::new(colour, 2.0));
    mark(canvas, index, (spot.0 + 12.0, spot.1), colour);
    canvas.text(&series.name, (spot.0 + LEGEND_TEXT, spot.1), Lettering::new(12.0, INK));
}

/// Disc, square, triangle or diamond: with six colours, twelve series look different.
fn mark(canvas: &mut Canvas<'_>, index: usize, (x, y): Spot, colour: Colour) {
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
