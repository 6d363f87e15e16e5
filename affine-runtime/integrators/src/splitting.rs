//! Splitting: exact flows of pieces of the Hamiltonian in turn, explicit and symplectic, with a fixed step or to a
//! tolerance.

pub(crate) mod adaptive;
pub(crate) mod coefficients;
pub(crate) mod dilated;
pub(crate) mod fading;
pub(crate) mod growth;
#[cfg(feature = "std")]
pub(crate) mod in_lanes;

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
    /// [`Failure::NotFinite`] where `y0` is not finite; [`Failure::Step`] where `step` is not positive, not finite, or
    /// gives more steps than there are floating-point times.
    pub fn new(
        (pieces, constants): (P, C),
        order: usize,
        (t0, y0): (f64, S),
        t_end: f64,
        step: f64,
    ) -> Option<Result<Self, Failure>> {
        let sweeps = of_order(order, (P::NYSTROM, P::DILATES))?;
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

    fn step(&mut self, from: (f64, &mut Sum<S>), h: f64, _last: Option<f64>) -> Result<(), Failure> {
        let (t, point) = from;
        self.evaluations += composed(&self.pieces, &self.sweeps, &self.constants, (t, point), h);
        if is_finite(&point.value) { Ok(()) } else { Err(Failure::NotFinite) }
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

/// The composition of an order for pieces, as [`Pieces`] tells of them.
fn of_order(order: usize, (nystrom, dilates): (bool, bool)) -> Option<Sweeps> {
    if nystrom && dilates { Sweeps::near_integrable(order) } else { Sweeps::of_order(order, nystrom) }
}

/// Moves a sum by one step of a composition; how often its last piece flowed.
#[inline]
fn composed<S, C, P: Pieces<S, C>>(
    pieces: &P,
    sweeps: &Sweeps,
    constants: &C,
    (t, state): (f64, &mut Sum<S>),
    h: f64,
) -> u64 {
    let mut evaluations = 0;
    sweeps.each_timed(
        P::COUNT,
        (t, h),
        // Called: as a part of the loop its numbers would not find as many registers.
        #[inline(never)]
        |piece, t, h| {
            pieces.flow(piece, t, h, constants, state);
            evaluations += u64::from(piece + 1 == P::COUNT);
        },
    );
    evaluations
}
