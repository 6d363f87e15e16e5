//! A stability report as a picture: errors beside what was demanded of them, on one logarithmic axis.

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
const RIGHT: f64 = 940.0;
/// Where refusals are counted, beside the axis.
const REFUSED: f64 = 962.0;
const TOP: f64 = 84.0;
/// Above a heading.
const GAP: f64 = 8.0;
const LINE: f64 = 15.0;
const TEXT: f64 = 10.0;

/// The cases of one quantity of one model under one heading: a line of the picture.
struct Line<'a> {
    heading: &'static str,
    cases: Vec<&'a StabilityCase>,
}

impl StabilityReport {
    /// The picture as an SVG document: a line for each quantity of each model, with a disc at the error of each of its cases,
    /// a stroke at what was demanded of it, and a square with the number of its refusals.
    #[must_use]
    pub fn to_svg(&self) -> String {
        let lines = self.lines();
        let headings = lines.windows(2).filter(|pair| pair[0].heading != pair[1].heading).count() + 1;
        let bottom = TOP + LINE * (lines.len() as f64 + headings as f64) + GAP * headings as f64;
        Canvas::draw(WIDTH, (bottom + 20.0).ceil() as u32, |canvas| {
            canvas.text("Stiff and extreme cases", (20.0, 24.0), Lettering::new(15.0, INK).bold());
            legend(canvas, 48.0);
            for decade in DECADES.0..=DECADES.1 {
                let x = place(10f64.powi(decade));
                canvas.line((x, TOP - 8.0), (x, bottom), Pen::new(GRID, 1.0));
                if decade % 4 == 0 {
                    canvas.text(&format!("1e{decade}"), (x, TOP - 18.0), Lettering::new(TEXT, INK).centred());
                }
            }
            let (mut y, mut heading) = (TOP, "");
            for line in &lines {
                if line.heading != heading {
                    heading = line.heading;
                    y += GAP;
                    canvas.text(heading, (20.0, y), Lettering::new(11.0, INK).bold());
                    y += LINE;
                }
                line.draw(canvas, y);
                y += LINE;
            }
        })
    }

    fn lines(&self) -> Vec<Line<'_>> {
        let mut lines: Vec<Line<'_>> = Vec::new();
        for case in self.cases() {
            let same = |line: &&mut Line<'_>| {
                line.cases.iter().any(|first| {
                    (first.heading, first.model, first.n, first.quantity)
                        == (case.heading, case.model, case.n, case.quantity)
                })
            };
            match lines.iter_mut().find(same) {
                Some(line) => line.cases.push(case),
                None => lines.push(Line { heading: case.heading, cases: vec![case] }),
            }
        }
        lines
    }

    /// Writes the picture to a file.
    ///
    /// # Errors
    /// [`Error::File`](crate::Error::File) with path and kind of the failure.
    pub fn save_svg(&self, path: impl AsRef<Path>) -> Result<()> {
        save(path.as_ref(), &self.to_svg())
    }
}

impl Line<'_> {
    fn draw(&self, canvas: &mut Canvas, y: f64) {
        let [first, .., last] = self.cases.as_slice() else {
            return self.cases.iter().for_each(|only| {
                label(canvas, &format!("{}: {}", about(only), only.scene), y);
                self.marks(canvas, y);
            });
        };
        let scenes = format!("{} cases, {} to {}", self.cases.len(), first.scene, last.scene);
        label(canvas, &format!("{}: {scenes}", about(first)), y);
        self.marks(canvas, y);
    }

    fn marks(&self, canvas: &mut Canvas, y: f64) {
        for case in &self.cases {
            if let Demand::Held(most) | Demand::HeldOrRefused(most) = case.demand {
                let x = place(most);
                canvas.line((x, y - 5.0), (x, y + 5.0), Pen::new(INK, 1.2).opacity(0.6));
            }
        }
        for case in &self.cases {
            if let Finding::Ran { error, .. } = case.finding {
                canvas.disc((place(error), y), 3.0, colour(case.verdict()));
            }
        }
        let stopped = || self.cases.iter().filter(|case| matches!(case.finding, Finding::Stopped(_)));
        // A refusal that falls short colours the square.
        if let Some(worst) = stopped().find(|case| case.verdict() == Verdict::FellShort).or(stopped().next())
        {
            square(canvas, (REFUSED, y), colour(worst.verdict()));
            let count = stopped().count().to_string();
            canvas.text(&count, (REFUSED + 8.0, y), Lettering::new(TEXT, INK));
        }
    }
}

fn about(case: &StabilityCase) -> String {
    format!("{}, n = {}, {}", case.model, case.n, case.quantity)
}

/// The text of a line, cut where the axis begins.
fn label(canvas: &mut Canvas, text: &str, y: f64) {
    let most = ((LEFT - 45.0) / (0.52 * TEXT)) as usize;
    let text = match text.char_indices().nth(most) {
        Some((end, _)) => format!("{} ...", text[..end].trim_end()),
        None => text.to_owned(),
    };
    canvas.text(&text, (30.0, y), Lettering::new(TEXT, INK));
}

fn square(canvas: &mut Canvas, (x, y): (f64, f64), colour: Colour) {
    canvas.rectangle((x - 3.5, y - 3.5), (x + 3.5, y + 3.5), colour);
}

fn legend(canvas: &mut Canvas, y: f64) {
    let text = Lettering::new(11.0, INK);
    canvas.disc((24.0, y), 3.0, colour(Verdict::Held));
    canvas.text("error", (32.0, y), text);
    canvas.line((84.0, y - 5.0), (84.0, y + 5.0), Pen::new(INK, 1.2));
    canvas.text("demanded", (92.0, y), text);
    square(canvas, (170.0, y), colour(Verdict::Refused));
    canvas.text("refused in words, how often", (180.0, y), text);
    canvas.disc((350.0, y), 3.0, colour(Verdict::FellShort));
    canvas.text("fell short", (358.0, y), text);
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
