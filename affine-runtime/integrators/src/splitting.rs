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

use core::marker::PhantomData;

use affine_core::system::Sum;

use super::Failure;
use super::drive::{Equal, EqualStepMethod};
use super::equal_steps::{EqualSteps, Times};
use super::finite::is_finite;
use super::tape::Tape;
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
pub type Splitting<S, C, P> = Equal<SplittingSteps<S, C, P>>;

/// Steps of a composition.
#[derive(Clone)]
pub struct SplittingSteps<S, C, P> {
    pieces: P,
    constants: C,
    sweeps: Sweeps,
    evaluations: u64,
    state: PhantomData<S>,
}

impl<S: StateVector<f64>, C, P: Pieces<S, C>> Equal<SplittingSteps<S, C, P>> {
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
        let method = SplittingSteps { pieces, constants, sweeps, evaluations: 0, state: PhantomData };
        Some(Times::new(t0, t_end, step).and_then(|times| match is_finite(&y0) {
            true => Ok(Self { method, steps: EqualSteps::at(times, Sum::of(y0)) }),
            false => Err(Failure::NotFinite),
        }))
    }
}

impl<S: StateVector<f64>, C, P: Pieces<S, C>> EqualStepMethod for SplittingSteps<S, C, P> {
    type State = S;
    type Point = Sum<S>;
    const NAME: &'static str = "Splitting";

    fn state(point: &Sum<S>) -> &S {
        &point.value
    }

    fn step(&mut self, (t, mut state): (f64, Sum<S>), h: f64, _last: Option<f64>) -> Result<Sum<S>, Failure> {
        self.evaluations += composed(&self.pieces, &self.sweeps, &self.constants, (t, &mut state), h);
        if is_finite(&state.value) { Ok(state) } else { Err(Failure::NotFinite) }
    }

    fn evaluations(&self) -> u64 {
        self.evaluations
    }

    fn exchange(&mut self, tape: &mut impl Tape) {
        tape.bits(&mut self.evaluations);
    }

    fn exchange_point(tape: &mut impl Tape, point: &mut Sum<S>) {
        tape.sum(point);
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

/// Takes a state through one step of a composition; the flows of its last piece. States are large, and stay where they are.
#[inline]
fn composed<S, C, P: Pieces<S, C>>(
    pieces: &P,
    sweeps: &Sweeps,
    constants: &C,
    (t, state): (f64, &mut Sum<S>),
    h: f64,
) -> u64 {
    let last = P::COUNT.saturating_sub(1);
    let (mut elapsed, mut evaluations) = (0.0, 0);
    sweeps.each(last + 1, |piece, part| {
        pieces.flow(piece, t + elapsed * h, part * h, constants, state);
        elapsed += if piece == 0 { part } else { 0.0 };
        evaluations += u64::from(piece == last);
    });
    evaluations
}
