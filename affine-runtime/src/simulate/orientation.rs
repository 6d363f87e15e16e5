//! Whether a body in a flat metric keeps its orientation throughout a step, not only at its ends.

use super::layout::{carries_dilatation, is_free_in_pi};
use super::mechanics::Mechanics;
use super::method::Method;
use super::motion::WithWork;
use super::point::{check, determinant};
use crate::error::Reason;
use crate::frames::Matrix;
use crate::inner::LogDeterminant;
use crate::inner::{norm, sum_of_squares};
use crate::model::{Constraint, Description};
use crate::state::Phase;

/// Nothing in the equations of a body in a flat metric stops at `det phi = 0` unless its potential knows `q`; then the forces
/// are singular there, and steps do not get past.
pub(super) const fn passes_through_zero(model: &Description) -> bool {
    is_free_in_pi(model) && !carries_dilatation(model)
}

/// Taylor steps of a conformal body are in the space around its group, where nothing stops at `phi = 0` either.
pub(super) fn steps_through_zero(model: &Description, method: Method) -> bool {
    let leaves_its_group =
        matches!(method, Method::Taylor { .. }) && model.constraint == Some(Constraint::Conformal);
    leaves_its_group || passes_through_zero(model)
}

/// A placement may change within a part of a step by so much of itself; by all of itself it could lose its orientation.
const LARGEST_CHANGE: f64 = 0.5;
/// So much of itself it changes by as far as squares tell: far above rounding, far below what steps change.
const LEAST_CHANGE: f64 = 1e-9;

/// A placement with its velocity, and the lengths of both as far as these have squares.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moment<const N: usize> {
    t: f64,
    phi: Matrix<N>,
    rate: Matrix<N>,
    size: f64,
    speed: f64,
}

#[inline(always)]
fn length<const N: usize>(matrix: &Matrix<N>) -> f64 {
    sum_of_squares(matrix.as_slice()).sqrt()
}

impl<const N: usize> Moment<N> {
    pub(super) fn of<P: Phase<N>>(model: &dyn Mechanics<N, P>, (t, point): (f64, &P)) -> Self {
        Self::at(t, *point.phi(), model.velocity(point).phi_dot)
    }

    /// Of a placement and its velocity.
    #[inline(always)]
    pub(super) fn at(t: f64, phi: Matrix<N>, rate: Matrix<N>) -> Self {
        Self { t, phi, rate, size: length(&phi), speed: length(&rate) }
    }

    /// Does `det phi` keep its sign up to another moment?
    ///
    /// With `E(t) = phi(a)^-1 phi(t) - 1` and `|E| < 1` in between, `1 + E` has an inverse. `E` is the cubic polynomial
    /// through both moments, `E(s) = s E(b) + h_10(s) (h E'(a) - E(b)) + h_11(s) (h E'(b) - E(b))`, `|h_10|` and `|h_11|`
    /// at most 4/27, but for an error that half of 1 leaves room for.
    fn reaches(&self, other: &Self) -> bool {
        let size = norm(self.phi.as_slice());
        let Some(inverse) = (self.phi / size).try_inverse() else { return false };
        let h = other.t - self.t;
        let change = inverse * ((other.phi - self.phi) / size);
        let [from, to] = [self, other].map(|moment| inverse * (moment.rate * (h / size)) - change);
        let bend = 4.0 / 27.0 * (norm(from.as_slice()) + norm(to.as_slice()));
        norm(change.as_slice()) + bend <= LARGEST_CHANGE
    }

    /// Does it so clearly, as in most steps? By Frobenius norms: `|phi^-1|` is `|phi|/det phi` in the plane, and at most
    /// `|phi|^2/(3^(1/2) det phi)` in space. What has no such squares is left to the careful way: where the determinant is
    /// above `LEAST_CHANGE |phi|^n`, changes whose squares vanish are below `LEAST_CHANGE |phi|`. Without branches, for many bodies
    /// at once.
    #[inline(always)]
    pub(super) fn clearly_reaches(&self, other: &Self) -> bool {
        let (size, h) = (self.size, (other.t - self.t).abs());
        let change = length(&(other.phi - self.phi)) + LEAST_CHANGE * size;
        let bend = 4.0 / 27.0 * (h * (self.speed + other.speed) + 2.0 * change);
        let determinant = determinant(&self.phi);
        let bound = match N {
            2 => size * (change + bend),
            3 => size * size * (change + bend) / 3.0_f64.sqrt(),
            _ => f64::NAN,
        };
        (bound < LARGEST_CHANGE * determinant) & determinant.is_finite()
    }
}

/// Refuses a step within which the orientation is lost, found again or not: parts of it that are too long to tell are
/// halved, with the dense output, down to the rounding of times.
pub(super) fn keeps_orientation<const N: usize, P: Phase<N>>(
    model: &dyn Mechanics<N, P>,
    between: &mut dyn FnMut(f64) -> Result<WithWork<P>, Reason>,
    (begin, end): (&Moment<N>, &Moment<N>),
) -> Result<(), Reason> {
    if begin.reaches(end) {
        return Ok(());
    }
    let middle = begin.t + 0.5 * (end.t - begin.t);
    if middle == begin.t || middle == end.t {
        let determinant = LogDeterminant::of(&end.phi).to_f64();
        return Err(Reason::Placement { determinant, rate: None, t: end.t });
    }
    let (point, _) = between(middle)?;
    check(middle, &point)?;
    let halfway = Moment::of(model, (middle, &point));
    keeps_orientation(model, between, (begin, &halfway))?;
    keeps_orientation(model, between, (&halfway, end))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Placements and velocities of any size, some of them nearly flat, and others a short or long step away.
    #[test]
    fn what_is_clear_is_true() {
        drawn::<2>();
        drawn::<3>();
    }

    fn drawn<const N: usize>() {
        let mut state = 1_u64;
        let mut uniform = move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        };
        let mut counts = [0; 3];
        for _ in 0..40_000 {
            let size = 10.0_f64.powf(310.0 * uniform());
            let flat = 10.0_f64.powf(-8.0 * uniform().abs());
            let step = 10.0_f64.powf(6.0 * uniform() - 4.0);
            let mut matrix = || Matrix::<N>::from_fn(|i, _| uniform() * if i == 0 { flat } else { 1.0 });
            let (phi, change, rates) = (matrix(), matrix() * step, [matrix() * step, matrix() * step]);
            let moment = |t: f64, phi: Matrix<N>, rate: Matrix<N>| {
                let (phi, rate) = (phi * size, rate * size);
                Moment { t, phi, rate, size: length(&phi), speed: length(&rate) }
            };
            let begin = moment(0.5, phi, rates[0]);
            let end = moment(1.5, phi + change, rates[1]);
            let (clear, careful) = (begin.clearly_reaches(&end), begin.reaches(&end));
            assert!(careful || !clear, "{begin:?} {end:?}");
            let is_positive = LogDeterminant::of(&begin.phi).is_positive();
            assert!(is_positive || !clear, "{begin:?}");
            counts[usize::from(careful && is_positive) + usize::from(clear)] += 1;
        }
        assert!(counts.iter().all(|count| *count > 1000), "{counts:?}");
    }
}
