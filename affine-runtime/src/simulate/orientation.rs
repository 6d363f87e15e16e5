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
    /// `|phi^-1|` or more, from the moment before; infinite where nothing is known.
    inverse: f64,
}

impl<const N: usize> Moment<N> {
    pub(super) fn of<P: Phase<N>>(model: &dyn Mechanics<N, P>, (t, point): (f64, &P)) -> Self {
        Self { t, phi: *point.phi(), rate: model.velocity(point).phi_dot, inverse: f64::INFINITY }
    }

    /// The other moment, with what is now known of its inverse, if `det phi` keeps its sign up to it.
    ///
    /// With `E(t) = phi(a)^-1 phi(t) - 1` and `|E| < 1` in between, `1 + E` has an inverse. `E` is the cubic polynomial
    /// through both moments, `E(s) = s E(b) + h_10(s) (h E'(a) - E(b)) + h_11(s) (h E'(b) - E(b))`, `|h_10|` and `|h_11|`
    /// at most 4/27, but for an error that half of 1 leaves room for. No norm of a product is larger than the product of the
    /// norms: where that is small enough, no inverse is computed, and `|phi(b)^-1|` is at most `|phi(a)^-1|/(1 - |E(b)|)`.
    fn reaching(&self, mut other: Self) -> Option<Self> {
        let h = other.t - self.t;
        let change = other.phi - self.phi;
        let ways = |change: Matrix<N>, rates: [Matrix<N>; 2]| {
            let [way, from, to] = [change, rates[0] - change, rates[1] - change].map(|m| norm(m.as_slice()));
            (way, way + 4.0 / 27.0 * (from + to))
        };
        let (way, whole) = ways(change, [self.rate * h, other.rate * h]);
        if self.inverse * whole <= LARGEST_CHANGE {
            other.inverse = self.inverse / (1.0 - self.inverse * way);
            return Some(other);
        }
        let size = norm(self.phi.as_slice());
        let inverse = (self.phi / size).try_inverse()?;
        let [change, from, to] =
            [change / size, self.rate * (h / size), other.rate * (h / size)].map(|m| inverse * m);
        let (way, whole) = ways(change, [from, to]);
        other.inverse = norm(inverse.as_slice()) / size / (1.0 - way);
        (whole <= LARGEST_CHANGE).then_some(other)
    }
}

/// The end of a step, unless the orientation is lost within it, found again or not: parts of it that are too long to tell are
/// halved, with the dense output, down to the rounding of times.
pub(super) fn keeps_orientation<const N: usize, P: Phase<N>>(
    model: &dyn Mechanics<N, P>,
    motion: &mut dyn Motion<P>,
    (begin, end): (Moment<N>, Moment<N>),
    reason: &dyn Fn(crate::integrate::Failure) -> Reason,
) -> Result<Moment<N>, Reason> {
    if let Some(end) = begin.reaching(end) {
        return Ok(end);
    }
    let middle = begin.t + 0.5 * (end.t - begin.t);
    if middle == begin.t || middle == end.t {
        let determinant = LogDeterminant::of(&end.phi).to_f64();
        return Err(Reason::Placement { determinant, rate: None, t: end.t });
    }
    let (point, _) = motion.between(middle).map_err(reason)?;
    check(middle, &point)?;
    let between = Moment::of(model, (middle, &point));
    let between = keeps_orientation(model, motion, (begin, between), reason)?;
    keeps_orientation(model, motion, (between, end), reason)
}
