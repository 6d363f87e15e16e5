//! Steps that rounding makes ever shorter, where stretches grow apart.

use super::layout::moves_on_group;
use super::mechanics::Mechanics;
use crate::decompose::LinearMap;
use crate::frames::Matrix;
use crate::inner::{larger, norm};
use crate::state::Phase;

/// Steps after which the pace is looked at, after twice as many, and so on.
const STEPS_UNTIL_A_LOOK: u64 = 1024;
/// Of what is made of two entries of the inverse of `phi` half of the digits are rounding below this part, `sqrt eps`.
const FAR_APART: f64 = 1.5e-8;
/// Roundings by which entries of a placement are changed to see what becomes of the velocity.
const ROUNDINGS: f64 = 4.0 * f64::EPSILON;

/// The square of the smallest stretch over that of the largest one. What is made of two entries of `phi^-1`, as a mass matrix that
/// depends on the placement, is rounded by the inverse of it.
pub(super) fn likeness<const N: usize, P: Phase<N>>(model: &dyn Mechanics<N, P>, point: &P) -> f64 {
    let q = point.in_orthonormal(model.bases().as_ref()).phi().log_stretches();
    let least = q.iter().copied().fold(f64::INFINITY, f64::min);
    let most = q.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    libm::exp(2.0 * (least - most))
}

/// How far the steps of a motion lead.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Pace {
    last: Option<Look>,
}

/// A look at it.
#[derive(Clone, Copy, Debug)]
struct Look {
    steps: u64,
    t: f64,
    likeness: f64,
    /// The mean length of the steps since the look before.
    mean: f64,
}

impl Pace {
    /// After so many steps the pace is looked at.
    pub(super) fn is_looked_at(steps: u64) -> bool {
        steps >= STEPS_UNTIL_A_LOOK && steps.is_power_of_two()
    }

    /// Is the motion lost in rounding after so many steps by their error? From look to look steps have become shorter and stretches
    /// have grown apart, rounding changes the velocity by more than the tolerance, and as long as since the last look the steps that
    /// are left do not lead to the end: the run would use them all up.
    pub(super) fn is_lost<const N: usize, P: Phase<N>>(
        &mut self,
        model: &dyn Mechanics<N, P>,
        (t, point, steps): (f64, &P, u64),
        (t_end, steps_left): (f64, u64),
        tolerance: f64,
    ) -> bool {
        let likeness = likeness(model, point);
        let last = self.last.filter(|last| last.steps < steps);
        let mean = last.map_or(f64::NAN, |last| (t - last.t).abs() / (steps - last.steps) as f64);
        self.last = Some(Look { steps, t, likeness, mean });
        let Some(last) = last else { return false };
        let goes_on = mean < last.mean && likeness < last.likeness && likeness <= FAR_APART;
        goes_on
            && (t_end - t).abs() > mean * steps_left as f64
            && rounding_of_velocity(model, point) > tolerance
    }
}

/// The largest part of itself by which rounding of one entry of `phi` changes the velocity of a body whose momentum stays, as steps
/// take it: on a group by `phi^-1 phi_dot`.
fn rounding_of_velocity<const N: usize, P: Phase<N>>(model: &dyn Mechanics<N, P>, point: &P) -> f64 {
    let is_on_group = moves_on_group(model.description(), N);
    let back = |phi: &Matrix<N>| if is_on_group { phi.try_inverse() } else { Some(Matrix::identity()) };
    let taken = |point: &P| Some(back(point.phi())? * model.velocity(point).phi_dot);
    let forth = if is_on_group { *point.phi() } else { Matrix::identity() };
    let Some(velocity) = taken(point) else { return f64::INFINITY };
    let change = |entry: usize| {
        let mut phi = *point.phi();
        phi[(entry / N, entry % N)] *= 1.0 + ROUNDINGS;
        let moved = taken(&point.moved(point.x(), phi, |spin| *spin));
        moved.map_or(f64::INFINITY, |moved| norm((forth * (moved - velocity)).as_slice()))
    };
    (0..N * N).map(change).fold(0.0, larger) / norm(model.velocity(point).phi_dot.as_slice())
}
