//! What a run asks of the points that it reaches.

use core::ops::ControlFlow;

use crate::error::{Callback, Error, Reason, Setting};
use crate::frames::Matrix;
use crate::inner::{LogDeterminant, on_the_group, sum_of_squares};
use crate::model::Constraint;
use crate::state::Phase;

/// Part of `|phi|^n` above which a determinant is positive whatever the rounding of a few products.
const CLEARLY_POSITIVE: f64 = 1e-12;

pub(super) fn go_on(flow: ControlFlow<()>, callback: Callback) -> Result<(), Reason> {
    match flow {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(Reason::Interrupted(callback)),
    }
}

/// Refuses a phase point that is not finite or whose placement does not keep orientation.
pub(super) fn check<const N: usize, P: Phase<N>>(t: f64, point: &P) -> Result<(), Reason> {
    if !point.is_finite() {
        return Err(Reason::NotFinite);
    }
    if is_clearly_positive(point.phi()) {
        return Ok(());
    }
    let determinant = LogDeterminant::of(point.phi());
    if determinant.is_positive() {
        return Ok(());
    }
    Err(Reason::Placement { determinant: determinant.to_f64(), rate: None, t })
}

/// Placements are this many times as far off a constraint as constructors allow, before a motion does not start from them: long ones
/// leave some of it.
const FAR_OFF: f64 = 1e8;

/// Refuses a start that is off the constraint of its model, if that has one. Its group is that of orthonormal bases, and constraints
/// go with no others.
pub(super) fn check_constraint<const N: usize, P: Phase<N>>(
    constraint: Option<Constraint>,
    start: &P,
) -> Result<(), Reason> {
    match constraint.map(|constraint| on_the_group(constraint, start.phi())) {
        Some(Err(Error::OffConstraint { defect, threshold, .. })) if defect > FAR_OFF * threshold => {
            Err(Setting::OffConstraint { defect }.into())
        }
        _ => Ok(()),
    }
}

/// A few products settle the sign of most determinants; what is close to zero, or out of the range of numbers,
/// is left to the careful way. Without branches, for many placements at once.
#[inline(always)]
pub(super) fn is_clearly_positive<const N: usize>(phi: &Matrix<N>) -> bool {
    let scale = sum_of_squares(phi.as_slice());
    // `det > c |phi|^n` without the root.
    let exceeds = |determinant: f64, power: f64| {
        (determinant > 0.0) & (determinant * determinant > CLEARLY_POSITIVE * CLEARLY_POSITIVE * power)
    };
    match N {
        2 => exceeds(determinant(phi), scale * scale),
        3 => exceeds(determinant(phi), scale * scale * scale),
        _ => false,
    }
}

/// The determinant by products in two and three dimensions, as far as these are in the range of numbers; NaN in others.
#[inline(always)]
pub(super) fn determinant<const N: usize>(phi: &Matrix<N>) -> f64 {
    let minor = |a: usize, b: usize| phi[(1, a)] * phi[(2, b)] - phi[(1, b)] * phi[(2, a)];
    match N {
        2 => phi[(0, 0)] * phi[(1, 1)] - phi[(0, 1)] * phi[(1, 0)],
        3 => phi[(0, 0)] * minor(1, 2) - phi[(0, 1)] * minor(0, 2) + phi[(0, 2)] * minor(0, 1),
        _ => f64::NAN,
    }
}
