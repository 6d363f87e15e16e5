//! Splitting: exact flows of pieces of the Hamiltonian in turn, explicit and symplectic, with a fixed step or to a
//! tolerance.

pub(crate) mod adaptive;
pub(crate) mod coefficients;
pub(crate) mod dilated;
pub(crate) mod fading;
pub(crate) mod growth;

pub use adaptive::AdaptiveSplitting;
pub use affine_core::system::Pieces;
use coefficients::Sweeps;

use core::fmt;

use affine_core::system::Sum;

use super::equal_steps::{EqualSteps, Times};
use super::finite::is_finite;
use super::tape::Tape;
use super::{Failure, Statistics};
use affine_core::model::StateVector;

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
    steps: EqualSteps<Sum<S>>,
    evaluations: u64,
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
        let sweeps = of_order::<S, C, P>(order)?;
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
        let times = Times::new(t0, t_end, step)?;
        if !is_finite(&y0) {
            return Err(Failure::NotFinite);
        }
        Ok(Self { pieces, constants, sweeps, steps: EqualSteps::at(times, Sum::of(y0)), evaluations: 0 })
    }

    /// Takes one step; does nothing at `t_end`, which the last step hits exactly.
    ///
    /// # Errors
    /// [`Failure::NotFinite`], now and ever after; the state stays that of the last step.
    pub fn advance(&mut self) -> Result<(), Failure> {
        let Some((t, begin, h)) = self.steps.next()? else { return Ok(()) };
        let end = self.composed(t, begin, h);
        self.steps.take(if is_finite(&end.value) { Ok(end) } else { Err(Failure::NotFinite) })
    }

    /// The state at a time within the last step, by a shorter step of the same method from its beginning, which leaves
    /// the steps as they are. The state reached where no step has been taken.
    ///
    /// # Errors
    /// [`Failure::NotFinite`], but the integration can go on.
    pub fn at(&mut self, t: f64) -> Result<S, Failure> {
        let Some((from, begin, h)) = self.steps.again_to(t) else { return Ok(*self.y()) };
        let between = self.composed(from, begin, h).value;
        if is_finite(&between) { Ok(between) } else { Err(Failure::NotFinite) }
    }

    /// Goes on to another end of the interval.
    ///
    /// # Errors
    /// [`Failure::Time`], [`Failure::StepUnderflow`] where there are no steps to it; the end stays what it was.
    #[doc(hidden)]
    pub fn aim(&mut self, t_end: f64) -> Result<(), Failure> {
        self.steps.aim(t_end)
    }

    /// Everything that the next steps depend on.
    #[doc(hidden)]
    pub fn exchange(&mut self, tape: &mut impl Tape) {
        self.steps.exchange(tape, |tape, end| tape.sum(end));
        tape.bits(&mut self.evaluations);
    }

    /// Time reached.
    #[must_use]
    pub fn t(&self) -> f64 {
        self.steps.t()
    }

    /// State reached.
    #[must_use]
    pub fn y(&self) -> &S {
        &self.steps.end().value
    }

    /// `t_end` is reached.
    #[must_use]
    pub fn is_finished(&self) -> bool {
        self.steps.is_finished()
    }

    /// Cost so far, with that of [`at`](Self::at). No step is rejected.
    #[must_use]
    pub fn statistics(&self) -> Statistics {
        Statistics { steps: self.steps.taken(), evaluations: self.evaluations, ..Statistics::default() }
    }

    fn composed(&mut self, t: f64, begin: Sum<S>, h: f64) -> Sum<S> {
        let (end, evaluations) = composed(&self.pieces, &self.sweeps, &self.constants, (t, begin), h);
        self.evaluations += evaluations;
        end
    }
}

/// The composition of an order for pieces.
fn of_order<S, C, P: Pieces<S, C>>(order: usize) -> Option<Sweeps> {
    if P::NYSTROM && P::DILATES {
        Sweeps::near_integrable(order)
    } else {
        Sweeps::of_order(order, P::NYSTROM)
    }
}

/// One step of a composition, and the flows of its last piece.
#[inline]
fn composed<S, C, P: Pieces<S, C>>(
    pieces: &P,
    sweeps: &Sweeps,
    constants: &C,
    (t, begin): (f64, Sum<S>),
    h: f64,
) -> (Sum<S>, u64) {
    let mut state = begin;
    let last = P::COUNT.saturating_sub(1);
    let (mut elapsed, mut evaluations) = (0.0, 0);
    sweeps.each(last + 1, |piece, part| {
        pieces.flow(piece, t + elapsed * h, part * h, constants, &mut state);
        elapsed += if piece == 0 { part } else { 0.0 };
        evaluations += u64::from(piece == last);
    });
    (state, evaluations)
}

impl<S: StateVector<f64>, C, P: Pieces<S, C>> fmt::Debug for Splitting<S, C, P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Splitting")
            .field("order", &self.sweeps.order())
            .field("t", &self.t())
            .field("y", self.y())
            .field("steps", self.steps.times())
            .field("statistics", &self.statistics())
            .finish_non_exhaustive()
    }
}
