//! Pictures of modes.

use core::f64::consts::TAU;
use std::path::Path;

use super::modes::{Mode, Modes};
use crate::error::Result;
use crate::frames::Matrix;
use crate::report::{Curve, CurveDiagram, CurvePanel};

/// Points of an outline.
const POINTS: usize = 96;
/// How far the largest entry of a shape goes.
const AMPLITUDE: f64 = 0.25;

impl<const N: usize> Modes<N> {
    /// A picture: the outline of the unit disc at rest, and at either end of the vibration, in the plane of the axes in which it
    /// moves most. One panel a mode, its first shape.
    ///
    /// # Errors
    /// [`Error::File`](crate::Error::File).
    pub fn save_svg(&self, path: impl AsRef<Path>) -> Result<()> {
        let panels = self.modes.iter().filter_map(|mode| panel(&self.rest, mode)).collect();
        CurveDiagram::new("Modes", panels).save_svg(path)
    }
}

fn panel<const N: usize>(rest: &Matrix<N>, mode: &Mode<N>) -> Option<CurvePanel> {
    let shape = mode.shapes.first()?;
    let pairs = (0..N).flat_map(|a| (0..a).map(move |b| (b, a)));
    let inside = |(a, b): (usize, usize)| {
        [(a, a), (a, b), (b, a), (b, b)].iter().map(|entry| shape.phi_dot[*entry].powi(2)).sum::<f64>()
    };
    let (a, b) = pairs.max_by(|one, other| inside(*one).total_cmp(&inside(*other)))?;
    let amplitude = AMPLITUDE / shape.phi_dot.amax().max(shape.x_dot.amax());
    let outline = |category: usize, shift: f64| {
        let phi = rest + shape.phi_dot * shift;
        let point = |k: usize| {
            let (sin, cos) = (TAU * k as f64 / POINTS as f64).sin_cos();
            let at = |i: usize| phi[(i, a)] * cos + phi[(i, b)] * sin + shape.x_dot[i] * shift;
            (at(a), at(b))
        };
        Curve { category, points: (0..=POINTS).map(point).collect() }
    };
    Some(CurvePanel {
        x: format!("{:?}, w = {:.4}, {} shapes", mode.class, mode.frequency(), mode.multiplicity()),
        y: format!("axes {}, {}", a + 1, b + 1),
        logarithmic: false,
        range: None,
        curves: vec![outline(0, 0.0), outline(1, amplitude), outline(2, -amplitude)],
    })
}
