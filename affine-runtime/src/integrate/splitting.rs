//! Splitting: exact flows of pieces of the Hamiltonian in turn, explicit and symplectic, with a fixed step.

mod coefficients;
mod growth;

pub use coefficients::Sweeps;
pub use growth::{accumulate, conjugated, growth, left_product, right_product};

use core::fmt;

use super::gauss::step_count;
use super::lie::Sum;
#[cfg(feature = "std")]
use super::tape::Tape;
use super::{Failure, Statistics};
use crate::model::StateVector;

/// Exact flows of the pieces of a motion whose equations depend on constants `C`.
pub trait Pieces<S, C> {
    /// Number of pieces.
    fn count(&self) -> usize;

    /// Are there two pieces `A` and `B` with `[B, [B, [B, A]]] = 0`?
    fn is_nystrom(&self) -> bool;

    /// Moves the state along a piece for the time `h`; `t` is the time that a potential reads.
    fn flow(&self, piece: usize, t: f64, h: f64, constants: &C, state: &mut Sum<S>);
}

/// Integration from `t0` to `t_end`, in either direction of time, in `n = ceil(|t_end - t0|/step)` equal steps, each a
/// composition of the exact flows of the pieces: [`Sweeps`].
///
/// Every flow is a symplectic (Poisson) map, and so is a step; it is symmetric. A quantity that each piece conserves is
/// conserved up to rounding: momentum maps of symmetries that all pieces share, and Casimirs. The energy error neither
/// grows nor shrinks in the mean as long as steps resolve the motion (Hairer, Lubich, Wanner, Geometric Numerical
/// Integration, chapter IX). Time is a coordinate that moves with the first piece. All increments are summed with
/// compensation. Nothing allocates.
///
/// Evaluations count the flows of the last piece, which is that of the potential where there is one.
#[derive(Clone)]
pub struct Splitting<S, C, P> {
    pieces: P,
    constants: C,
    sweeps: Sweeps,
    t0: f64,
    t_end: f64,
    h: f64,
    count: u64,
    taken: u64,
    begin: Sum<S>,
    end: Sum<S>,
    evaluations: u64,
    failure: Option<Failure>,
}

impl<S: StateVector<f64>, C, P: Pieces<S, C>> Splitting<S, C, P> {
    /// The integration at its start, of order 2, 4, 6 or 8; `None` for other orders.
    ///
    /// # Errors
    /// [`Failure::NotFinite`] where `y0` is not finite; [`Failure::StepUnderflow`] where `step` is not positive, or
    /// gives more steps than there are floating-point times.
    pub fn new(
        (pieces, constants): (P, C),
        order: usize,
        (t0, y0): (f64, S),
        t_end: f64,
        step: f64,
    ) -> Option<Result<Self, Failure>> {
        let sweeps = Sweeps::of_order(order, pieces.is_nystrom())?;
        Some(Self::with(pieces, constants, sweeps, (t0, y0), t_end, step))
    }

    fn with(
        pieces: P,
        constants: C,
        sweeps: Sweeps,
        (t0, y0): (f64, S),
        t_end: f64,
        step: f64,
    ) -> Result<Self, Failure> {
        let count = step_count(t0, t_end, step).ok_or(Failure::StepUnderflow)?;
        let h = if count == 0 { 0.0 } else { (t_end - t0) / count as f64 };
        if !is_finite(&y0) {
            return Err(Failure::NotFinite);
        }
        let start = Sum::of(y0);
        Ok(Self {
            pieces,
            constants,
            sweeps,
            t0,
            t_end,
            h,
            count,
            taken: 0,
            begin: start,
            end: start,
            evaluations: 0,
            failure: None,
        })
    }

    /// Takes one step; does nothing at `t_end`, which the last step hits exactly.
    ///
    /// # Errors
    /// [`Failure::NotFinite`], now and ever after; the state stays that of the last step.
    pub fn advance(&mut self) -> Result<(), Failure> {
        if let Some(failure) = self.failure {
            return Err(failure);
        }
        if self.is_finished() {
            return Ok(());
        }
        let end = self.composed(self.t(), self.end, self.h);
        if !is_finite(&end.value) {
            self.failure = Some(Failure::NotFinite);
            return Err(Failure::NotFinite);
        }
        (self.begin, self.end) = (self.end, end);
        self.taken += 1;
        Ok(())
    }

    /// The state at a time within the last step, by a shorter step of the same method from its beginning, which leaves
    /// the steps as they are. The state reached where no step has been taken.
    ///
    /// # Errors
    /// [`Failure::NotFinite`], but the integration can go on.
    pub fn at(&mut self, t: f64) -> Result<S, Failure> {
        if self.taken == 0 || t == self.t() {
            return Ok(self.end.value);
        }
        let begin = self.time(self.taken - 1);
        let between = self.composed(begin, self.begin, t - begin).value;
        if is_finite(&between) { Ok(between) } else { Err(Failure::NotFinite) }
    }

    /// Everything that the next steps depend on.
    #[cfg(feature = "std")]
    pub(crate) fn exchange(&mut self, tape: &mut impl Tape) {
        tape.bits(&mut self.taken);
        tape.sum(&mut self.end);
        tape.bits(&mut self.evaluations);
    }

    /// Time reached.
    #[must_use]
    pub fn t(&self) -> f64 {
        self.time(self.taken)
    }

    /// State reached.
    #[must_use]
    pub fn y(&self) -> &S {
        &self.end.value
    }

    /// `t_end` is reached.
    #[must_use]
    pub fn is_finished(&self) -> bool {
        self.taken == self.count
    }

    /// Cost so far, with that of [`at`](Self::at). No step is rejected.
    #[must_use]
    pub fn statistics(&self) -> Statistics {
        Statistics { steps: self.taken, rejected: 0, evaluations: self.evaluations }
    }

    /// One step of the composition.
    #[inline]
    fn composed(&mut self, t: f64, begin: Sum<S>, h: f64) -> Sum<S> {
        let mut state = begin;
        let (pieces, last) = (&self.pieces, self.pieces.count().saturating_sub(1));
        let (mut elapsed, mut evaluations) = (0.0, 0);
        self.sweeps.each(last + 1, |piece, part| {
            pieces.flow(piece, t + elapsed * h, part * h, &self.constants, &mut state);
            elapsed += if piece == 0 { part } else { 0.0 };
            evaluations += u64::from(piece == last);
        });
        self.evaluations += evaluations;
        state
    }

    fn time(&self, taken: u64) -> f64 {
        if taken == self.count { self.t_end } else { self.t0 + taken as f64 * self.h }
    }
}

impl<S: StateVector<f64>, C, P: Pieces<S, C>> fmt::Debug for Splitting<S, C, P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Splitting")
            .field("order", &self.sweeps.order())
            .field("t", &self.t())
            .field("y", self.y())
            .field("t_end", &self.t_end)
            .field("step_length", &self.h)
            .field("statistics", &self.statistics())
            .finish_non_exhaustive()
    }
}

fn is_finite<S: StateVector<f64>>(y: &S) -> bool {
    y.as_ref().iter().all(|v| v.is_finite())
}
