//! A motion between its outputs, kept for times that are asked for afterwards.

use super::interpolant::{Fit, Polynomial};
use crate::error::{Reason, Setting};
use crate::geodesic::Geodesic;
use crate::inner::larger;
use crate::metrics::Bases;
use crate::numbers::{Numbers, numbers};
use crate::state::Phase;

/// Polynomials may be so much of the tolerance off the motion that they stand for.
const PART_OF_TOLERANCE: f64 = 0.1;
/// What rounding leaves of differences between numbers of order 1.
const ROUNDING: f64 = 32.0 * f64::EPSILON;

/// A step takes less than so many polynomials, and all steps together so many more: some 100 MB in three dimensions, and 2e5 radians
/// of a motion that steps leave out.
const OF_A_STEP: usize = 32;
const OF_A_RUN: usize = 1 << 14;

/// [`Dense::extend`], which is linked only where a run is asked to be dense.
pub(super) type Keep<const N: usize, P> =
    fn(&mut Dense<N, P>, f64, f64, &mut dyn FnMut(f64) -> Result<P, Reason>) -> Result<(), Reason>;

/// A motion, piece after piece in the direction of time.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Dense<const N: usize, P> {
    pieces: Vec<Piece<N, P>>,
    /// Where the next piece begins.
    reached: (f64, P),
    /// Polynomials that steps may still make beyond their own.
    left: usize,
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
        Self { pieces: Vec::new(), reached: start, left: OF_A_RUN }
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
        let ends = [(from, numbers(&begin)), (to, numbers(&end))];
        let (before, pieces) = (self.pieces.len(), &mut self.pieces);
        let mut left = OF_A_STEP + self.left;
        let mut each = |polynomial| pieces.push(Piece::Polynomial(polynomial));
        Fit::<N>::new(&mut at, bound, &mut left).cover(ends[0], ends[1], &mut each)?;
        if left == 0 {
            self.pieces.truncate(before);
            self.pieces.push(Piece::Polynomial(Polynomial::of_ends::<N>(ends[0], ends[1])));
            // The next step is hardly another: half as much is tried.
            self.left /= 2;
        } else {
            // What a step has of its own is not for others.
            self.left = self.left.min(left);
        }
        self.reached = (to, end);
        Ok(())
    }

    /// Keeps a closed form up to a time.
    pub(super) fn close(&mut self, geodesic: &Geodesic<N>, start: (f64, P), to: f64) {
        let geodesic = Box::new(*geodesic);
        self.pieces.push(Piece::ClosedForm { geodesic, start, to });
    }

    /// The point at a time. Before an event that changes it, at its very time.
    ///
    /// # Errors
    /// [`Setting::OutsideRun`] and [`Setting::NotKept`].
    pub(super) fn at(&self, t: f64, bases: Option<&Bases<N>>) -> Result<P, Setting> {
        let (from, to) = self.interval();
        let direction = if to < from { -1.0 } else { 1.0 };
        let is_within = direction * (t - from) >= 0.0 && direction * (to - t) >= 0.0;
        let index = self.pieces.partition_point(|piece| direction * (piece.ends().1 - t) < 0.0);
        match self.pieces.get(index).filter(|_| is_within) {
            None => Err(Setting::OutsideRun { t, from, to }),
            Some(Piece::Polynomial(polynomial)) => {
                let mut numbers = polynomial.at(t).ok_or(Setting::NotKept { t })?.into_iter();
                Ok(self.reached.1.with_entries(&mut || numbers.next().unwrap_or(f64::NAN)))
            }
            Some(Piece::ClosedForm { start: (from, start), .. }) if t == *from => Ok(*start),
            Some(Piece::ClosedForm { geodesic, start: (_, start), .. }) => Ok(match bases {
                None => geodesic.point(t, start),
                Some(bases) => {
                    P::from_orthonormal(&geodesic.point(t, &start.in_orthonormal(Some(bases))), bases)
                }
            }),
        }
    }

    /// The times between which the motion is kept.
    pub(super) fn interval(&self) -> (f64, f64) {
        let ends = self.pieces.first().zip(self.pieces.last());
        ends.map_or((self.reached.0, self.reached.0), |(first, last)| (first.ends().0, last.ends().1))
    }
}
