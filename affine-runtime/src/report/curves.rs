//! Curves in panels side by side: for portraits, and for errors over time.

use std::path::Path;

use super::axes::{Area, Axis, Panel};
use super::canvas::{Canvas, Lettering, Pen};
use super::palette::{INK, category};
use super::save;
use crate::error::Result;

/// Width and height of a panel.
pub(crate) const PANEL: (f64, f64) = (400.0, 330.0);
const MARGIN: (f64, f64, f64) = (84.0, 56.0, 66.0);
/// Length of a line, and size of letters, in a legend.
const DASH: f64 = 16.0;
const LETTER: f64 = 11.0;
/// Of letters in the title.
const TITLE: f64 = 15.0;

/// A picture of panels side by side, each with curves.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveDiagram {
    title: String,
    panels: Vec<CurvePanel>,
    legend: Vec<(usize, String)>,
}

/// One panel of a [`CurveDiagram`].
#[derive(Clone, Debug, PartialEq)]
pub struct CurvePanel {
    /// Name of the horizontal axis.
    pub x: String,
    /// Name of the vertical axis.
    pub y: String,
    /// Is the vertical axis logarithmic? Then only positive values are drawn.
    pub logarithmic: bool,
    /// The part of the vertical axis that is drawn; all of it where there is none.
    pub range: Option<(f64, f64)>,
    /// The curves.
    pub curves: Vec<Curve>,
}

/// One curve of a [`CurvePanel`].
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Its colour: curves of one category look alike.
    pub category: usize,
    /// Points, joined in this order.
    pub points: Vec<(f64, f64)>,
}

impl CurveDiagram {
    /// A diagram of panels.
    #[must_use]
    pub fn new(title: impl Into<String>, panels: Vec<CurvePanel>) -> Self {
        Self { title: title.into(), panels, legend: Vec::new() }
    }

    /// What the curves of these categories are, in a line below the title.
    #[must_use]
    pub fn legend<'n>(self, names: impl IntoIterator<Item = (usize, &'n str)>) -> Self {
        let legend = names.into_iter().map(|(category, name)| (category, name.to_owned())).collect();
        Self { legend, ..self }
    }

    /// The picture as an SVG document.
    #[must_use]
    pub fn to_svg(&self) -> String {
        let (left, top, bottom) = MARGIN;
        let step = PANEL.0 + left;
        let title = left + 0.6 * TITLE * self.title.chars().count() as f64;
        let (width, height) = (title.max(step * self.panels.len() as f64) + 24.0, top + PANEL.1 + bottom);
        Canvas::draw(width.ceil() as u32, height.ceil() as u32, |canvas| {
            canvas.text(&self.title, (left, 28.0), Lettering::new(TITLE, INK).bold());
            let mut x = left;
            for (index, name) in &self.legend {
                canvas.line((x, 43.0), (x + DASH, 43.0), Pen::new(category(*index), 2.0));
                canvas.text(name, (x + DASH + 5.0, 43.0), Lettering::new(LETTER, INK));
                x += DASH + 19.0 + 0.55 * LETTER * name.chars().count() as f64;
            }
            for (index, panel) in self.panels.iter().enumerate() {
                let start = left + step * index as f64;
                let area = Area { left: start, top, right: start + PANEL.0, bottom: top + PANEL.1 };
                panel.draw(canvas, area);
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
}

impl CurvePanel {
    fn draw(&self, canvas: &mut Canvas, area: Area) {
        let points = || self.curves.iter().flat_map(|curve| curve.points.iter());
        let inside = |y: f64| self.range.is_none_or(|(low, high)| low <= y && y <= high);
        let x = Axis::linear(points().map(|point| point.0), 5);
        let y = match (self.logarithmic, self.range) {
            (true, _) => Axis::decades(points().map(|point| point.1), 8, |value| format!("{value:e}")),
            (false, Some((low, high))) => Axis::tight(low, high, 6),
            (false, None) => Axis::linear(points().map(|point| point.1), 6),
        };
        let panel = Panel { area, x, y };
        panel.frame(canvas, &self.x, &self.y);
        for curve in &self.curves {
            // What leaves the range is cut, not joined across.
            for part in curve.points.split(|point| !inside(point.1)) {
                panel.curve(canvas, part.iter().copied(), Pen::new(category(curve.category), 1.5));
            }
        }
    }
}
