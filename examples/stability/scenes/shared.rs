//! What several kinds of cases need.

use affine_runtime::model::Conserved;
use affine_runtime::prelude::*;
use affine_runtime::report::{Oracle, Scene};

/// Tolerance of all integrations.
pub(super) const TOLERANCE: f64 = 1e-13;

/// A run to its end without output on the way.
pub(super) fn run<const N: usize, M: Model<N>>(
    model: &M,
    start: M::Point<f64>,
    t_end: f64,
) -> affine_runtime::Result<Trajectory<N, M::Point<f64>>> {
    let simulation = Simulation::new(model, start).until(t_end).tolerance(TOLERANCE);
    Ok(simulation.output([t_end]).max_steps(1_000_000_000).run()?)
}

/// The same by a method.
pub(super) fn run_by<const N: usize, M: Model<N>>(
    method: Method,
    model: &M,
    start: M::Point<f64>,
    t_end: f64,
) -> affine_runtime::Result<Trajectory<N, M::Point<f64>>> {
    let simulation = Simulation::new(model, start).until(t_end).tolerance(TOLERANCE).method(method);
    Ok(simulation.output([t_end]).max_steps(1_000_000_000).run()?)
}

/// `max(tolerance, 10 eps omega t)`: ten roundings of the phase of a vibration.
pub(super) fn floor(omega: f64, t: f64) -> f64 {
    (10.0 * f64::EPSILON * omega * t).max(1e-12)
}

/// Relative drift of the energy.
pub(super) fn energy<const N: usize, P: Phase<N>>(run: &Trajectory<N, P>) -> f64 {
    run.conservation().of(Conserved::Energy).map_or(f64::NAN, |drift| drift.relative())
}

/// `|a - b|/|b|` in the Frobenius norm; 0 where they agree even in a vanishing `b`. Both are scaled by the largest
/// entry first, so that squares stay in range.
pub(super) fn relative_distance<const N: usize>(a: &Matrix<N>, b: &Matrix<N>) -> f64 {
    let largest = b.iter().fold(0.0_f64, |largest, v| if v.abs() > largest { v.abs() } else { largest });
    let (a, b) = if largest > 0.0 { (a / largest, b / largest) } else { (*a, *b) };
    let distance = (a - b).norm();
    if distance == 0.0 { 0.0 } else { distance / b.norm() }
}

/// The largest `|a_i - b_i|/|b_i|` over rows: every row against its own size, as an affine map of space that scales the axes
/// differently demands. 0 where rows agree even in a vanishing one; NaN where an entry is.
pub(super) fn relative_distance_by_rows<const N: usize>(a: &Matrix<N>, b: &Matrix<N>) -> f64 {
    let alone = |m: &Matrix<N>, i: usize| Matrix::<N>::from_fn(|k, j| if k == 0 { m[(i, j)] } else { 0.0 });
    let errors = (0..N).map(|i| relative_distance(&alone(a, i), &alone(b, i)));
    // `f64::max` would drop a NaN.
    errors.fold(0.0, |largest: f64, error| if error <= largest || largest.is_nan() { largest } else { error })
}

/// Distance of the placements at the ends of two runs, and the steps of the first.
pub(super) fn apart<const N: usize, P: Phase<N>, Q: Phase<N>>(
    a: &Trajectory<N, P>,
    b: &Trajectory<N, Q>,
) -> (f64, u64) {
    (relative_distance(a.end().1.phi(), b.end().1.phi()), a.statistics().steps)
}

/// A scene by its names.
pub(super) fn scene(
    model: &'static str,
    n: usize,
    scene: String,
    quantity: &'static str,
    oracle: Oracle,
) -> Scene {
    Scene { model, n, scene, quantity, oracle }
}

#[cfg(test)]
mod tests {
    use super::{Matrix, relative_distance_by_rows};

    #[test]
    fn a_row_that_is_no_number_is_not_passed_over() {
        let b = Matrix::<3>::new(1.0, 2.0, 3.0, 4e200, 5e200, 6e200, 0.0, 0.0, 0.0);
        assert_eq!(relative_distance_by_rows(&b, &b), 0.0);
        let mut a = b;
        a[(1, 2)] = 6.6e200;
        let expected = 0.6 / 77.0_f64.sqrt();
        assert!((relative_distance_by_rows(&a, &b) - expected).abs() < 1e-15);
        for row in 0..3 {
            let mut a = b;
            a[(row, 0)] = f64::NAN;
            assert!(relative_distance_by_rows(&a, &b).is_nan(), "row {row}");
        }
    }
}
