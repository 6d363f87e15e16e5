//! A motion between its outputs, kept for times that are asked for afterwards.

use super::interpolant::{Fit, Polynomial};
use crate::error::Reason;
use crate::geodesic::Geodesic;
use crate::inner::larger;
use crate::metrics::Bases;
use crate::numbers::{Numbers, numbers};
use crate::state::Phase;

/// Polynomials may be so much of the tolerance off the motion that they stand for.
const PART_OF_TOLERANCE: f64 = 0.1;
/// What rounding leaves of differences between numbers of order 1.
const ROUNDING: f64 = 32.0 * f64::EPSILON;

/// [`Dense::extend`], which is linked only where a run is asked to be dense.
pub(super) type Keep<const N: usize, P> =
    fn(&mut Dense<N, P>, f64, f64, &mut dyn FnMut(f64) -> Result<P, Reason>) -> Result<(), Reason>;

/// A motion, piece after piece in the direction of time.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Dense<const N: usize, P> {
    pieces: Vec<Piece<N, P>>,
    /// Where the next piece begins.
    reached: (f64, P),
}

#[derive(Clone, Debug, PartialEq)]
enum Piece<const N: usize, P> {
    Polynomial(Polynomial),
    ClosedForm { geodesic: Box<Geodesic<N>>, start: (f64, P), to: f64 },
}

impl<const N: usize, P> Piece<N, P> {
    fn ends(&self) -> (f64, f64) {
        match self {
            Piece::Polynomial(polynomial) => (polynomial.from, polynomial.to),
            Piece::ClosedForm { start: (from, _), to, .. } => (*from, *to),
        }
    }
}

impl<const N: usize, P: Phase<N>> Dense<N, P> {
    pub(super) fn new(start: (f64, P)) -> Self {
        Self { pieces: Vec::new(), reached: start }
    }

    /// The motion goes on from elsewhere.
    pub(super) fn begin(&mut self, start: (f64, P)) {
        self.reached = start;
    }

    /// Time from which the next piece goes.
    pub(super) fn reached(&self) -> f64 {
        self.reached.0
    }

    /// Keeps the motion up to a time, as close as a part of a tolerance.
    ///
    /// # Errors
    /// Those of the motion.
    pub(super) fn extend(
        &mut self,
        to: f64,
        tolerance: f64,
        at: &mut dyn FnMut(f64) -> Result<P, Reason>,
    ) -> Result<(), Reason> {
        let (from, begin) = self.reached;
        let end = at(to)?;
        let mut at = |t: f64| -> Result<Numbers, Reason> { at(t).map(|point| numbers(&point)) };
        let bound = larger(PART_OF_TOLERANCE * tolerance, ROUNDING);
        let pieces = &mut self.pieces;
        let mut each = |polynomial| pieces.push(Piece::Polynomial(polynomial));
        Fit::<N> { at: &mut at, bound }.cover((from, numbers(&begin)), (to, numbers(&end)), &mut each)?;
        self.reached = (to, end);
        Ok(())
    }

    /// Keeps a closed form up to a time.
    pub(super) fn close(&mut self, geodesic: &Geodesic<N>, start: (f64, P), to: f64) {
        let geodesic = Box::new(*geodesic);
        self.pieces.push(Piece::ClosedForm { geodesic, start, to });
    }

    /// The point at a time; `None` where nothing is kept. Before an event that changes it, at its very time.
    pub(super) fn at(&self, t: f64, bases: Option<&Bases<N>>) -> Option<P> {
        let (first, last) = (self.pieces.first()?.ends(), self.pieces.last()?.ends());
        let direction = if last.1 < first.0 { -1.0 } else { 1.0 };
        let is_within = direction * (t - first.0) >= 0.0 && direction * (last.1 - t) >= 0.0;
        let index = self.pieces.partition_point(|piece| direction * (piece.ends().1 - t) < 0.0);
        self.pieces.get(index).filter(|_| is_within).map(|piece| match piece {
            Piece::Polynomial(polynomial) => {
                let mut numbers = polynomial.at(t).into_iter();
                self.reached.1.with_entries(&mut || numbers.next().unwrap_or(f64::NAN))
            }
            Piece::ClosedForm { start: (from, start), .. } if t == *from => *start,
            Piece::ClosedForm { geodesic, start: (_, start), .. } => match bases {
                None => geodesic.point(t, start),
                Some(bases) => {
                    P::from_orthonormal(&geodesic.point(t, &start.in_orthonormal(Some(bases))), bases)
                }
            },
        })
    }

    /// The times between which the motion is kept, if there are any.
    pub(super) fn interval(&self) -> Option<(f64, f64)> {
        Some((self.pieces.first()?.ends().0, self.pieces.last()?.ends().1))
    }
}
