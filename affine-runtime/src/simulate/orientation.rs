//! Whether a body in a flat metric keeps its orientation throughout a step, not only at its ends.

use super::layout::{carries_dilatation, is_free_in_pi};
use super::mechanics::Mechanics;
use super::motion::Motion;
use super::point::check;
use crate::error::Reason;
use crate::frames::Matrix;
use crate::inner::LogDeterminant;
use crate::inner::norm;
use crate::model::Description;
use crate::state::Phase;

/// Nothing in the equations of a body in a flat metric stops at `det phi = 0` unless its potential knows `q`; then the forces
/// are singular there, and steps do not get past.
pub(super) fn passes_through_zero(model: &Description) -> bool {
    is_free_in_pi(model) && !carries_dilatation(model)
}

/// A placement may change within a part of a step by so much of itself; by all of itself it could lose its orientation.
const LARGEST_CHANGE: f64 = 0.5;

/// A placement with its velocity.
#[derive(Clone, Copy)]
pub(super) struct Moment<const N: usize> {
    t: f64,
    phi: Matrix<N>,
    rate: Matrix<N>,
}

impl<const N: usize> Moment<N> {
    pub(super) fn of<P: Phase<N>>(model: &dyn Mechanics<N, P>, (t, point): (f64, &P)) -> Self {
        Self { t, phi: *point.phi(), rate: model.velocity(point).phi_dot }
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
}

/// Refuses a step within which the orientation is lost, found again or not: parts of it that are too long to tell are
/// halved, with the dense output, down to the rounding of times.
pub(super) fn keeps_orientation<const N: usize, P: Phase<N>>(
    model: &dyn Mechanics<N, P>,
    motion: &mut dyn Motion<P>,
    (begin, end): (Moment<N>, Moment<N>),
    reason: &dyn Fn(crate::integrate::Failure) -> Reason,
) -> Result<(), Reason> {
    if begin.reaches(&end) {
        return Ok(());
    }
    let middle = begin.t + 0.5 * (end.t - begin.t);
    if middle == begin.t || middle == end.t {
        let determinant = LogDeterminant::of(&end.phi).to_f64();
        return Err(Reason::Placement { determinant, rate: None, t: end.t });
    }
    let (point, _) = motion.between(middle).map_err(reason)?;
    check(middle, &point)?;
    let between = Moment::of(model, (middle, &point));
    keeps_orientation(model, motion, (begin, between), reason)?;
    keeps_orientation(model, motion, (between, end), reason)
}
