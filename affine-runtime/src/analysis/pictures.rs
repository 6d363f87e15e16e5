//! Pictures of modes and branches.

use core::f64::consts::TAU;
use std::path::Path;

use super::branch::{Branch, BranchPoint};
use super::modes::{Mode, Modes};
use super::stability::StabilityVerdict;
use crate::error::Result;
use crate::report::{Curve, CurveDiagram, CurvePanel, PANEL};
use crate::state::Phase;

/// Points of an outline.
const POINTS: usize = 96;
/// How far the largest entry of a shape goes.
const AMPLITUDE: f64 = 0.25;

impl<const N: usize> Modes<N> {
    /// A picture: the outline of the unit disc at rest, and at either end of the vibration, in the plane of the axes in which it
    /// moves most, in bases in which the metrics are the identity. One panel a mode, its first shape.
    ///
    /// # Errors
    /// [`Error::File`](crate::Error::File).
    pub fn save_svg(&self, path: impl AsRef<Path>) -> Result<()> {
        let panels = self.modes.iter().filter_map(|mode| panel(self, mode)).collect();
        let names = [(0, "at rest"), (1, "at one end"), (2, "at the other")];
        CurveDiagram::new("Modes", panels).legend(names).save_svg(path)
    }
}

fn panel<const N: usize>(modes: &Modes<N>, mode: &Mode<N>) -> Option<CurvePanel> {
    let (rest, shape) = modes.measured(mode.shapes.first()?);
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
    let mut curves = vec![outline(0, 0.0), outline(1, amplitude), outline(2, -amplitude)];
    // Lengths are the same on both axes: two points alone stand in opposite corners.
    let far = curves.iter().flat_map(|curve| &curve.points);
    let far = far.fold(0.0, |far: f64, (x, y)| far.max(x.abs()).max(y.abs()));
    let corner = [1.0, -1.0].map(|sign| vec![(sign * far * PANEL.0 / PANEL.1, sign * far)]);
    curves.extend(corner.map(|points| Curve { category: 0, points }));
    Some(CurvePanel {
        x: format!("{:?}, w = {:.4}, multiplicity {}", mode.class, mode.frequency(), mode.multiplicity()),
        y: format!("axes {}, {}", a + 1, b + 1),
        logarithmic: false,
        range: None,
        curves,
    })
}

/// Size of the mark of a special point, in parts of the panel.
const MARK: f64 = 0.012;
/// What curves of each category are; the last one is that of marks.
const LEGEND: [&str; 5] = ["stable", "linearly stable", "unstable", "undecided", "special points"];

/// A branch diagram: numbers of each point, as its stretches, against its parameter. A branch changes its colour with its
/// stability, and special points are marked, see [`Special`](super::Special); a legend tells which is which.
pub fn branch_diagram<const N: usize, P: Phase<N>>(
    title: &str,
    branches: &[&Branch<N, P>],
    (x, y): (&str, &str),
    numbers: impl Fn(&BranchPoint<N, P>) -> Vec<f64>,
) -> CurveDiagram {
    let places = |point: &BranchPoint<N, P>| -> Vec<(f64, f64)> {
        numbers(point).into_iter().map(|number| (point.parameter, number)).collect()
    };
    let color = |point: &BranchPoint<N, P>| match point.stability.verdict {
        StabilityVerdict::Stable => 0,
        StabilityVerdict::LinearlyStable => 1,
        StabilityVerdict::Unstable { .. } => 2,
        StabilityVerdict::Undecided(_) => 3,
    };
    let all = || branches.iter().flat_map(|branch| &branch.points).flat_map(places);
    let reach = |of: fn((f64, f64)) -> f64| {
        all().map(of).fold(f64::MIN, f64::max) - all().map(of).fold(f64::MAX, f64::min)
    };
    let (width, height) = (MARK * reach(|place| place.0), MARK * reach(|place| place.1));
    let mut curves = Vec::new();
    for branch in branches {
        for pair in branch.points.windows(2) {
            for (from, to) in places(&pair[0]).into_iter().zip(places(&pair[1])) {
                curves.push(Curve { category: color(&pair[1]), points: vec![from, to] });
            }
        }
        for (x, y) in branch.special.iter().flat_map(|(_, point)| places(point)) {
            let corners = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0), (1.0, 0.0)];
            let points = corners.iter().map(|(a, b)| (x + a * width, y + b * height)).collect();
            curves.push(Curve { category: LEGEND.len() - 1, points });
        }
    }
    let has = |category: usize| curves.iter().any(|curve| curve.category == category);
    let legend: Vec<_> = LEGEND.into_iter().enumerate().filter(|(category, _)| has(*category)).collect();
    let panel = CurvePanel { x: x.into(), y: y.into(), logarithmic: false, range: None, curves };
    CurveDiagram::new(title, vec![panel]).legend(legend)
}
