//! A trajectory as a picture.

use std::path::Path;

use super::axes::{Area, Axis, Panel, brief_time};
use super::canvas::{Canvas, Lettering, Pen, Spot};
use super::drift::History;
use super::palette::{INK, category, early_to_late};
use super::scene::{Body, Scene};
use super::{method_name, save};
use crate::error::Result;
use crate::frames::Matrix;
use crate::simulate::Trajectory;
use crate::state::Phase;

/// The page and its parts.
const WIDTH: u32 = 890;
const HEIGHT: u32 = 860;
const SCENE: Area = Area { left: 84.0, top: 84.0, right: 610.0, bottom: 470.0 };
const STRETCHES: Area = Area { left: 84.0, top: 508.0, right: 610.0, bottom: 638.0 };
const DRIFTS: Area = Area { left: 84.0, top: 682.0, right: 610.0, bottom: 812.0 };
/// Of the path of the centre, where the bodies stand side by side.
const PATH: Area = Area { left: 644.0, top: 234.0, right: 844.0, bottom: 334.0 };
/// Origin of the axes of space.
const AXES: Spot = (690.0, 410.0);
/// Where the legends begin, right of everything.
const LEGEND: f64 = 634.0;
const LEGEND_LINE: f64 = 19.0;
const SMALL: f64 = 12.0;

/// Times at which the body is drawn.
const BODIES: usize = 6;

impl<const N: usize, P: Phase<N>> Trajectory<N, P> {
    /// The trajectory as an SVG document: the deformed unit ball `{x + phi u : |u| <= 1}` at a few times, from
    /// dark (early) to bright (late), with the path of the centre of mass; the log-stretches `q_a`, half the
    /// logarithms of the eigenvalues of `phi^T phi`, over time; and the largest relative drift so far of the
    /// conserved quantities (see [`conservation`](Self::conservation)). Bodies of a model with `metrics(...)` are drawn in
    /// orthonormal bases, where lengths are those of the metrics.
    ///
    /// In three dimensions the view is orthographic, from azimuth 35 and elevation 25 degrees, and the lines on
    /// the body are the images of the great circles in its coordinate planes, where the eye sees them. In two dimensions the
    /// line on the body is its first axis. Bodies whose centre stays are set side by side in reading order, and so are bodies of
    /// the plane that would cover one another, with the path beside them. Lines join the outputs of the trajectory: ask for as many as smooth lines need.
    #[must_use]
    pub fn to_svg(&self) -> String {
        let samples = Samples::of(self);
        Canvas::draw(WIDTH, HEIGHT, |canvas| {
            self.caption(canvas);
            samples.scene().paint(canvas, &SCENE, &PATH, AXES);
            samples.time_legend(canvas);
            samples.paint_stretches(canvas);
            self.paint_drifts(canvas, &samples);
        })
    }

    /// Writes the picture of [`to_svg`](Self::to_svg) to a file.
    ///
    /// # Errors
    /// [`Error::File`](crate::Error::File) with path and kind of the failure.
    pub fn save_svg(&self, path: impl AsRef<Path>) -> Result<()> {
        save(path.as_ref(), &self.to_svg())
    }

    fn caption(&self, canvas: &mut Canvas) {
        canvas.text(self.description().name, (84.0, 30.0), Lettering::new(16.0, INK).bold());
        canvas.text(&summary(self), (84.0, 52.0), Lettering::new(SMALL, INK));
    }

    fn paint_drifts(&self, canvas: &mut Canvas, samples: &Samples<N>) {
        let history = History::of(self);
        let panel = Panel { area: DRIFTS, x: samples.time_axis(), y: history.axis() };
        panel.frame(canvas, "t", "relative drift");
        for (index, row) in history.rows().iter().enumerate() {
            panel.curve(canvas, row.worst_so_far.iter().copied(), Pen::new(category(index), 1.6));
        }
        let mut spot = (LEGEND, DRIFTS.top + 6.0);
        for (index, row) in history.rows().iter().enumerate() {
            spot = legend_line(canvas, spot, category(index), &row.label());
        }
        for remark in history.remarks() {
            canvas.text(&remark, (spot.0, spot.1), Lettering::new(SMALL - 1.0, INK));
            spot.1 += LEGEND_LINE;
        }
    }
}

/// Interval, method and cost in a line.
pub(super) fn summary<const N: usize, P: Phase<N>>(run: &Trajectory<N, P>) -> String {
    let computation = run.computation();
    let (method, (t0, _), (t_end, _)) = (method_name(computation.method), run.start(), run.end());
    let accuracy = match run.statistics().steps {
        0 => String::new(),
        steps if computation.method.step().is_some() => format!(", {steps} steps"),
        steps => format!(", tolerance {:e}, {steps} steps", computation.tolerance),
    };
    format!("t = {t0} to {t_end}: {method}{accuracy}")
}

/// A stroke of the colour with a text; where the next line begins.
fn legend_line(canvas: &mut Canvas, spot: Spot, colour: (u8, u8, u8), text: &str) -> Spot {
    canvas.line(spot, (spot.0 + 18.0, spot.1), Pen::new(colour, 2.4));
    canvas.text(text, (spot.0 + 26.0, spot.1), Lettering::new(SMALL - 1.0, INK));
    (spot.0, spot.1 + LEGEND_LINE)
}

/// Start, outputs and end of a trajectory, each time once.
pub(super) struct Samples<const N: usize> {
    pub(super) bodies: Vec<(f64, Body<N>)>,
}

impl<const N: usize> Samples<N> {
    pub(super) fn of<P: Phase<N>>(trajectory: &Trajectory<N, P>) -> Self {
        let (start, end) = (trajectory.start().0, trajectory.end().0);
        let span = end - start;
        let body = |(t, point): (f64, P::InOrthonormal)| {
            let fraction = if span == 0.0 { 0.0 } else { (t - start) / span };
            (t, Body { x: point.x(), phi: *point.phi(), fraction })
        };
        Self { bodies: trajectory.samples().into_iter().map(body).collect() }
    }

    /// The bodies drawn: those nearest to equally spaced times.
    fn shown(&self) -> Vec<(f64, Body<N>)> {
        let mut shown: Vec<(f64, Body<N>)> = Vec::with_capacity(BODIES);
        for k in 0..BODIES {
            let wanted = k as f64 / (BODIES - 1) as f64;
            let distance = |body: &Body<N>| (body.fraction - wanted).abs();
            let nearest = self.bodies.iter().min_by(|a, b| distance(&a.1).total_cmp(&distance(&b.1)));
            shown.extend(nearest.filter(|nearest| shown.last().is_none_or(|last| last.0 != nearest.0)));
        }
        shown
    }

    fn scene(&self) -> Scene<N> {
        let moves = self.bodies.windows(2).any(|pair| pair[0].1.x != pair[1].1.x);
        let path = self.bodies.iter().filter(|_| moves).map(|(_, body)| (body.fraction, body.x)).collect();
        Scene { bodies: self.shown().into_iter().map(|(_, body)| body).collect(), path }
    }

    fn ends(&self) -> (f64, f64) {
        let time = |sample: Option<&(f64, Body<N>)>| sample.map_or(0.0, |sample| sample.0);
        (time(self.bodies.first()), time(self.bodies.last()))
    }

    fn time_axis(&self) -> Axis {
        let (t0, t_end) = self.ends();
        Axis::tight(t0.min(t_end), t0.max(t_end), 10)
    }

    fn time_legend(&self, canvas: &mut Canvas) {
        let (t0, t_end) = self.ends();
        let mut spot = (LEGEND, SCENE.top + 6.0);
        for (t, body) in self.shown() {
            canvas.disc((spot.0 + 9.0, spot.1), 5.0, early_to_late(body.fraction));
            let label = format!("t = {}", brief_time(t, t_end - t0));
            canvas.text(&label, (spot.0 + 26.0, spot.1), Lettering::new(SMALL, INK));
            spot.1 += LEGEND_LINE;
        }
    }

    fn paint_stretches(&self, canvas: &mut Canvas) {
        let curves: Vec<(f64, Vec<f64>)> =
            self.bodies.iter().map(|(t, body)| (*t, log_stretches(&body.phi))).collect();
        let values = curves.iter().flat_map(|(_, stretches)| stretches.iter().copied());
        let panel = Panel { area: STRETCHES, x: self.time_axis(), y: Axis::linear(values, 5) };
        panel.frame(canvas, "", "log-stretches");
        for (t, body) in self.shown() {
            if let Some((x, _)) = panel.spot(t, 0.0) {
                canvas.disc((x, STRETCHES.top - 8.0), 3.4, early_to_late(body.fraction));
            }
        }
        let mut spot = (LEGEND, STRETCHES.top + 6.0);
        for a in 0..N {
            let points = curves.iter().map(|(t, stretches)| (*t, stretches[a]));
            panel.curve(canvas, points, Pen::new(category(a), 1.6));
            spot = legend_line(canvas, spot, category(a), &format!("q{}", a + 1));
        }
    }
}

/// Half the logarithms of the eigenvalues of `phi^T phi`, the largest first; good for a picture, since squaring
/// costs the small ones digits.
pub(super) fn log_stretches<const N: usize>(phi: &Matrix<N>) -> Vec<f64> {
    let green = phi.tr_mul(phi);
    let eigenvalues = nalgebra::DMatrix::from_fn(N, N, |a, b| green[(a, b)]).symmetric_eigenvalues();
    let mut stretches: Vec<f64> = eigenvalues.iter().map(|value| 0.5 * value.ln()).collect();
    stretches.sort_by(|a, b| b.total_cmp(a));
    stretches
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn log_stretches_come_in_order() {
        let phi = Matrix::<3>::new(0.0, -2.0, 0.0, 0.5, 0.0, 0.0, 0.0, 0.0, 3.0);
        for (q, stretch) in log_stretches(&phi).iter().zip([3.0f64, 2.0, 0.5]) {
            assert!((q - stretch.ln()).abs() < 1e-15);
        }
    }
}
