//! When a body collapses.

use super::distortion::{is_rounding, products};
use super::mechanics::Mechanics;
use crate::error::Reason;
use crate::frames::Matrix;
use crate::inner::LogDeterminant;
use crate::inner::norm;
use crate::state::Phase;

/// A step that fails where `det phi` falls to zero within this part of the time since the start has run into the collapse.
const AT_HAND: f64 = 1e-6;
/// The same of a step of given length that would reach the collapse, where `det phi` is this part of what it is for a sphere of
/// the same size.
const FLAT: f64 = 0.05;

/// The rate of `det phi` along the motion at a point: the sum over columns of the determinant with that column moved.
pub(super) fn rate_of_determinant<const N: usize, P: Phase<N>>(
    model: &dyn Mechanics<N, P>,
    point: &P,
) -> f64 {
    let velocity = model.velocity(point).phi_dot;
    let moved = |column: usize| {
        let mut matrix = *point.phi();
        matrix.set_column(column, &velocity.column(column));
        LogDeterminant::of(&matrix).to_f64()
    };
    (0..N).map(moved).sum()
}

/// The part of the products in `det phi` by which that changes along the motion, at a rate, while the body changes by as much as it is.
pub(super) fn change_of_determinant<const N: usize, P: Phase<N>>(
    model: &dyn Mechanics<N, P>,
    point: &P,
    rate: f64,
) -> f64 {
    let (phi, phi_dot) = (point.phi(), model.velocity(point).phi_dot);
    rate / (products(phi) * norm(phi_dot.as_slice()) / norm(phi.as_slice()))
}

/// Why no step leads on from a point, if that is because the body is about to collapse: `det phi` falls to zero, at the rate that
/// it has, within the step, of a length where it has one, or within a small part of the time since the start.
pub(super) fn failing<const N: usize, P: Phase<N>>(
    model: &dyn Mechanics<N, P>,
    (t, point): (f64, &P),
    since: f64,
    step: Option<f64>,
) -> Option<Reason> {
    let determinant = LogDeterminant::of(point.phi()).to_f64();
    let rate = rate_of_determinant(model, point);
    let ahead = (t - since).signum();
    let fall = -ahead * change_of_determinant(model, point, rate);
    let falls = rate * ahead < 0.0 && !is_rounding(determinant, point.phi(), fall);
    let left = (determinant / rate).abs();
    let flatness = determinant / of_sphere(point.phi());
    let is_at_hand = left <= AT_HAND * (t - since).abs();
    let is_reached = step.is_some_and(|step| left <= step && flatness <= FLAT);
    (falls && (is_at_hand || is_reached)).then_some(Reason::Placement { determinant, rate: Some(rate), t })
}

/// `(|phi|/sqrt n)^n`, which is `det phi` where all stretches are equal.
fn of_sphere<const N: usize>(phi: &Matrix<N>) -> f64 {
    libm::pow(norm(phi.as_slice()) / libm::sqrt(N as f64), N as f64)
}

/// The time, to the rounding of times, from which a condition fails that holds at `good` and not at `bad`: bisection.
/// Where it fails more than once in between, one of these times.
pub(super) fn first_failure(mut good: f64, mut bad: f64, mut holds: impl FnMut(f64) -> bool) -> f64 {
    loop {
        let middle = good + 0.5 * (bad - good);
        if middle == good || middle == bad {
            return bad;
        }
        if holds(middle) { good = middle } else { bad = middle }
    }
}

#[cfg(test)]
mod tests {
    use super::first_failure;

    #[test]
    fn the_next_double_past_the_edge() {
        for (good, bad, edge) in [(0.0, 3.0, 2.0_f64.sqrt()), (-1.0, -5.0, -3.3), (0.0, 1.0, 1e-200)] {
            let inside = |t: f64| (t - edge) * (bad - good) <= 0.0;
            let found = first_failure(good, bad, inside);
            assert!(!inside(found) && (found - edge).abs() <= 2.0 * f64::EPSILON * edge.abs(), "{found}");
        }
    }
}
