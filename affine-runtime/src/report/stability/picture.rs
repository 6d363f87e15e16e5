//! A stability report as a picture: error of every case beside what was demanded, on one logarithmic axis.

use std::io;
use std::path::Path;

use super::{Demand, Finding, StabilityCase, StabilityReport, Verdict};
use crate::error::Result;
use crate::report::canvas::{Canvas, Lettering, Pen};
use crate::report::palette::{Colour, GRID, INK, category};
use crate::report::save;

/// Decades of the axis: an error at or below the first is drawn there, one above the last, or none, at the last.
const DECADES: (i32, i32) = (-17, 0);
const WIDTH: u32 = 1000;
const LEFT: f64 = 520.0;
const RIGHT: f64 = 970.0;
const TOP: f64 = 70.0;
const LINE: f64 = 15.0;
const TEXT: f64 = 10.0;

impl StabilityReport {
    /// The picture as an SVG document: a disc at the error of each case, a stroke at what was demanded, a square for a
    /// refusal.
    ///
    /// # Errors
    /// Those of the drawing library.
    pub fn to_svg(&self) -> io::Result<String> {
        let headings = self.cases().windows(2).filter(|pair| pair[0].heading != pair[1].heading).count() + 1;
        let lines = self.cases().len() + headings;
        let bottom = TOP + LINE * (lines as f64 + 1.0);
        Canvas::draw(WIDTH, (bottom + 30.0).ceil() as u32, |canvas| {
            canvas.text("Stiff and extreme cases", (20.0, 24.0), Lettering::new(15.0, INK).bold());
            canvas.text(
                "disc: error, stroke: demanded, square: refused in words",
                (20.0, 46.0),
                Lettering::new(11.0, INK),
            );
            for decade in DECADES.0..=DECADES.1 {
                let x = place(10f64.powi(decade));
                canvas.line((x, TOP - 8.0), (x, bottom), Pen::new(GRID, 1.0));
                if decade % 4 == 0 {
                    canvas.text(&format!("1e{decade}"), (x, TOP - 18.0), Lettering::new(TEXT, INK).centred());
                }
            }
            let (mut y, mut heading) = (TOP, "");
            for case in self.cases() {
                if case.heading != heading {
                    heading = case.heading;
                    canvas.text(heading, (20.0, y), Lettering::new(11.0, INK).bold());
                    y += LINE;
                }
                draw(canvas, case, y);
                y += LINE;
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
}

fn draw(canvas: &mut Canvas<'_>, case: &StabilityCase, y: f64) {
    let label = format!("{}, n = {}, {}: {}", case.model, case.n, case.scene, case.quantity);
    canvas.text(&label, (30.0, y), Lettering::new(TEXT, INK));
    if let Demand::Held(most) | Demand::HeldOrRefused(most) = case.demand {
        let x = place(most);
        canvas.line((x, y - 5.0), (x, y + 5.0), Pen::new(INK, 1.5));
    }
    let colour = colour(case.verdict());
    match case.finding {
        Finding::Ran { error, .. } => canvas.disc((place(error), y), 3.5, colour),
        Finding::Stopped(_) => canvas.rectangle((RIGHT - 3.5, y - 3.5), (RIGHT + 3.5, y + 3.5), colour),
    }
}

fn colour(verdict: Verdict) -> Colour {
    match verdict {
        Verdict::Held => category(0),
        Verdict::Refused => category(2),
        Verdict::FellShort => category(1),
    }
}

fn place(error: f64) -> f64 {
    let (first, last) = (f64::from(DECADES.0), f64::from(DECADES.1));
    // NaN has the place of the worst.
    let decade = if error < 1.0 { error.max(f64::MIN_POSITIVE).log10().clamp(first, last) } else { last };
    LEFT + (decade - first) / (last - first) * (RIGHT - LEFT)
}
