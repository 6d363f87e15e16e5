//! What a run asks of the points that it reaches.

use core::ops::ControlFlow;

use super::mechanics::Mechanics;
use crate::error::{Callback, Reason};
use crate::frames::Matrix;
use crate::inner::LogDeterminant;
use crate::inner::{larger, norm, sum_of_squares};
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

/// The energy of a point, with what it is made of.
#[derive(Clone, Copy, Debug)]
pub(super) struct Energy {
    /// `H`.
    pub(super) value: f64,
    /// `(|Pi| |phi_dot| + |p| |x_dot|)/2` in orthonormal bases, which is at least `|T|`.
    bound: f64,
    /// `T = (tr(Pi phi_dot) + p . x_dot)/2` of a quadratic energy.
    kinetic: f64,
}

impl Energy {
    pub(super) fn at<const N: usize, P: Phase<N>>(model: &dyn Mechanics<N, P>, t: f64, point: &P) -> Self {
        let value = model.hamiltonian(t, point);
        let bases = model.bases();
        let velocity = model.velocity(point);
        let velocity = bases.as_ref().map_or(velocity, |bases| bases.velocity(&velocity));
        let point = point.in_orthonormal(bases.as_ref());
        let (pi, p) = (point.pi().0.0, point.p());
        let internal = norm(pi.as_slice()) * norm(velocity.phi_dot.as_slice());
        let translational = norm(p.as_slice()) * norm(velocity.x_dot.as_slice());
        let kinetic = pi.transpose().dot(&velocity.phi_dot) + p.dot(&velocity.x_dot);
        Self { value, bound: 0.5 * (internal + translational), kinetic: 0.5 * kinetic }
    }

    /// What an error of the energy is measured against: `|H|`, or the bound of `|T|`.
    pub(super) fn scale(&self) -> f64 {
        larger(self.value.abs(), self.bound)
    }

    /// `|T| + |U|`, with a bound of `|T|` that an indefinite kinetic energy has too.
    pub(super) fn size(&self) -> f64 {
        self.bound + (self.value - self.kinetic).abs()
    }
}
