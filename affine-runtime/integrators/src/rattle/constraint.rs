//! The constraint `det phi = 1` and the hidden constraint `tr(adj(phi) phi') = 0`, solved to rounding.

use super::layout::Layout;
use crate::Failure;
use crate::lie::{Sum, adjugate};
use affine_core::__private::numerics::norm;
use affine_core::frames::Matrix;
use affine_core::system::StateVector;

/// Newton's iteration for one number, from a start near the solution, converges within ten, or wanders.
const MOST_ITERATIONS: u32 = 30;
/// Roundings of the products in a determinant.
const ROUNDINGS: f64 = 4.0;
/// What an iteration that no longer gains may leave, relative to the products.
const SOLVED: f64 = 1e-13;
/// What it may leave of `det phi - 1` itself: where the products are so large that their rounding is more than that, the
/// placement is lost, and with it the constraint.
const RESOLVED: f64 = 1e-8;
/// Corrections of the momentum: the first leaves the rounding of what it takes away, the second that of what is left.
const CORRECTIONS: u32 = 2;

/// `phi(mu) = phi + carry + free + mu along`.
pub(super) struct Motion<const N: usize> {
    pub(super) phi: Matrix<N>,
    pub(super) carry: Matrix<N>,
    pub(super) free: Matrix<N>,
    pub(super) along: Matrix<N>,
}

/// A multiplier, and what it leaves of `det phi - 1`: relative to the products in the determinant, and itself.
pub(super) struct Found {
    pub(super) value: f64,
    pub(super) residual: f64,
    defect: f64,
}

/// `mu` with `det phi(mu) = 1`, by Newton's iteration from `guess`: on a polynomial of degree n.
pub(super) fn multiplier<const N: usize>(motion: &Motion<N>, guess: f64) -> Result<Found, Failure> {
    let mut value = guess;
    let mut best = Found { value, residual: f64::INFINITY, defect: f64::INFINITY };
    for _ in 0..MOST_ITERATIONS {
        let phi = motion.phi + (motion.carry + motion.free + motion.along * value);
        let cofactors = adjugate(&phi);
        let products = |k: usize| phi[(0, k)] * cofactors[(k, 0)];
        let determinant: f64 = (0..N).map(products).sum();
        let size: f64 = (0..N).map(|k| products(k).abs()).sum();
        let defect = (determinant - 1.0).abs();
        let residual = defect / size;
        if residual.is_nan() {
            break;
        }
        // At rounding, another iteration may gain or lose a rounding.
        let gains = residual < best.residual;
        if gains {
            best = Found { value, residual, defect };
        }
        if best.residual <= ROUNDINGS * f64::EPSILON || (!gains && best.residual <= SOLVED) {
            break;
        }
        value -= (determinant - 1.0) / pairing(&cofactors, &motion.along);
    }
    if best.residual <= SOLVED && best.defect <= RESOLVED {
        Ok(best)
    } else if best.defect.is_finite() {
        Err(Failure::NoSolution { residual: best.defect })
    } else {
        Err(Failure::NotFinite)
    }
}

/// The state with a multiple of `normal` added to the momentum, such that `tr(adj(phi) phi') = 0`.
pub(super) fn tangent<const N: usize, S: StateVector<f64>>(
    layout: &Layout<N>,
    state: Sum<S>,
    normal: &S,
) -> Sum<S> {
    let gradient = adjugate(&layout.placement(&state.value));
    let stiffness = pairing(&gradient, &layout.placement(&layout.drift(normal, 1.0)));
    let mut tangent = state;
    for _ in 0..CORRECTIONS {
        let velocity = layout.placement(&layout.drift(&tangent.value, 1.0));
        let carried = layout.placement(&layout.drift(&tangent.carry, 1.0));
        let factor = -(pairing(&gradient, &velocity) + pairing(&gradient, &carried)) / stiffness;
        let mut rise = *normal;
        for value in rise.as_mut() {
            *value *= factor;
        }
        tangent = tangent.plus(&rise);
    }
    tangent
}

/// Takes a state that is on both constraints but for small defects to them; the larger of `|det phi - 1|` and
/// `|tr(adj(phi) phi')|/(|adj(phi)| |phi'|)` before.
pub(super) fn settle<const N: usize, S: StateVector<f64>>(layout: &Layout<N>, state: &mut S) -> f64 {
    let phi = layout.placement(state);
    let cofactors = adjugate(&phi);
    let determinant: f64 = (0..N).map(|k| phi[(0, k)] * cofactors[(k, 0)]).sum();
    let velocity = layout.placement(&layout.drift(state, 1.0));
    let along = pairing(&cofactors, &velocity).abs();
    let size = norm(cofactors.as_slice()) * norm(velocity.as_slice());
    let hidden = if along == 0.0 { 0.0 } else { along / size };
    layout.place(state, &(phi * libm::pow(determinant, -1.0 / N as f64)));
    let normal = layout.momentum(&adjugate(&layout.placement(state)));
    *state = tangent(layout, Sum::of(*state), &normal).value;
    let off = (determinant - 1.0).abs();
    if off <= hidden { hidden } else { off }
}

/// `tr(A B)`.
fn pairing<const N: usize>(a: &Matrix<N>, b: &Matrix<N>) -> f64 {
    let mut sum = 0.0;
    for i in 0..N {
        for k in 0..N {
            sum += a[(i, k)] * b[(k, i)];
        }
    }
    sum
}
