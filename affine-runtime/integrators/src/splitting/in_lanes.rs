//! Splitting of several bodies at once, in equal steps that all of them take together.

use core::marker::PhantomData;

use pulp::{Simd, WithSimd};

use super::coefficients::Sweeps;
use super::of_order;
use crate::Failure;
use crate::equal_steps::{EqualSteps, Times};
use crate::lanes::Lanes;
use crate::lanes::parts::{in_lanes, part, parts, set_part};
use affine_core::model::StateVector;
use affine_core::system::Sum;

/// [`Pieces`](super::Pieces) of several motions. A trait, as [`Equations`](crate::lanes::equations::Equations) are.
pub trait PiecesInLanes<T, S> {
    /// Number of pieces.
    const COUNT: usize;
    /// There are two pieces, `A` and `B`, with `[B, [B, [B, A]]] = 0`.
    const NYSTROM: bool;
    /// The first piece contains a dilatation in closed form.
    const DILATES: bool;

    /// Moves the states along a piece for the time `h`, `t` being the time that a potential reads; to be `#[inline(always)]`.
    fn flow(&self, piece: usize, t: f64, h: f64, state: &mut Sum<S>);

    /// 0 in lanes where a step from a time on, of a length, from one state to another, may count; to be `#[inline(always)]`.
    fn doubts(&self, from: (f64, &S), h: f64, to: &S) -> T;
}

/// Bodies in lanes, [`Splitting`](super::Splitting) of each, operation by operation, all at the same time.
pub struct SplittingInLanes<T, S, P> {
    pieces: P,
    sweeps: Sweeps,
    steps: EqualSteps<Sum<S>>,
    lanes: PhantomData<T>,
}

impl<T: Lanes, S: StateVector<T>, P: PiecesInLanes<T, S>> SplittingInLanes<T, S, P> {
    /// Lanes of zeros at a time; `None` for orders other than 2, 4, 6 and 8.
    ///
    /// # Errors
    /// [`Failure::Time`] where the time is not finite, [`Failure::Step`] where the step is not positive or not finite.
    pub fn new(pieces: P, order: usize, t0: f64, step: f64) -> Option<Result<Self, Failure>> {
        const { assert!(T::LANES.is_multiple_of(8), "lanes fill the vectors of every processor") }
        let sweeps = of_order(order, (P::NYSTROM, P::DILATES))?;
        let start = Sum { value: S::zeros(), carry: S::zeros() };
        let times = Times::new(t0, t0, step);
        Some(times.map(|times| Self {
            pieces,
            sweeps,
            steps: EqualSteps::at(times, start),
            lanes: PhantomData,
        }))
    }

    /// The pieces.
    pub fn pieces(&self) -> &P {
        &self.pieces
    }

    /// The pieces, to be changed between steps.
    pub fn pieces_mut(&mut self) -> &mut P {
        &mut self.pieces
    }

    /// Puts a state into a lane.
    pub fn put(&mut self, lane: usize, state: &impl StateVector<f64>) {
        let Sum { value, carry } = self.steps.end_mut();
        for ((value, carry), own) in value.as_mut().iter_mut().zip(carry.as_mut()).zip(state.as_ref()) {
            value.set_lane(lane, *own);
            carry.set_lane(lane, 0.0);
        }
    }

    /// Takes a step, and does nothing at the end; 0 in lanes where it may count.
    pub fn advance(&mut self) -> T {
        let Self { pieces, sweeps, steps, .. } = self;
        let mut doubts = T::zero();
        // Lanes do not fail together.
        let _ = steps.take(|(t, from), to, h, _| {
            let step = Step { pieces, sweeps, at: (t, h), from, to, doubts: PhantomData };
            doubts = in_lanes::<T, _>(step, false);
            Ok(())
        });
        doubts
    }

    /// The state in a lane at a time within the last step, by a shorter step from its beginning along the flows of the body
    /// in it; `None` at the end of the step, and before one was taken.
    pub fn within<R: StateVector<f64>>(
        &self,
        lane: usize,
        t: f64,
        mut flow: impl FnMut(usize, f64, f64, &mut Sum<R>),
    ) -> Option<R> {
        let (begin, from, h) = self.steps.again_to(t)?;
        let mut state = Sum::of(R::zeros());
        for (own, lanes) in [(&mut state.value, &from.value), (&mut state.carry, &from.carry)] {
            own.as_mut().iter_mut().zip(lanes.as_ref()).for_each(|(own, lanes)| *own = lanes.lane(lane));
        }
        self.sweeps.each_timed(P::COUNT, (begin, h), |piece, t, h| flow(piece, t, h, &mut state));
        Some(state.value)
    }

    /// Goes on to another end.
    ///
    /// # Errors
    /// [`Failure::Time`], [`Failure::Step`] where there are no steps to it; the end stays what it was.
    pub fn aim(&mut self, t_end: f64) -> Result<(), Failure> {
        self.steps.aim(t_end)
    }

    /// Passes over the steps to the end, where the states are what they were.
    pub fn pass_over(&mut self) {
        self.steps.pass_over();
    }

    /// The end is reached.
    pub fn is_finished(&self) -> bool {
        self.steps.is_finished()
    }

    /// Time and states reached.
    pub fn end(&self) -> (f64, &S) {
        (self.steps.t(), &self.steps.end().value)
    }

    /// Time and states where the last step began, if one was taken to this end.
    pub fn begin(&self) -> Option<(f64, &S)> {
        self.steps.begin().map(|(t, begin)| (t, &begin.value))
    }
}

/// A step in every lane.
struct Step<'a, T, S, P> {
    pieces: &'a P,
    sweeps: &'a Sweeps,
    at: (f64, f64),
    from: &'a Sum<S>,
    to: &'a mut Sum<S>,
    doubts: PhantomData<T>,
}

impl<T: Lanes, S: StateVector<T>, P: PiecesInLanes<T, S>> WithSimd for Step<'_, T, S, P> {
    type Output = T;
    #[inline(always)]
    fn with_simd<V: Simd>(self, simd: V) -> T {
        let Self { pieces, sweeps, at: (t, h), from, to, .. } = self;
        // As vectors: states of eight bodies are kilobytes, and a call that copies so many starts slowly.
        for (to, from) in [(&mut to.value, &from.value), (&mut to.carry, &from.carry)] {
            for (to, from) in to.as_mut().iter_mut().zip(from.as_ref()) {
                for k in 0..parts::<V, T>() {
                    set_part(simd, to, k, part(simd, from, k));
                }
            }
        }
        sweeps.each_timed(
            P::COUNT,
            (t, h),
            #[inline(always)]
            |piece, t, h| pieces.flow(piece, t, h, to),
        );
        pieces.doubts((t, &from.value), h, &to.value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Splitting;
    use crate::lanes::F64x8;
    use crate::splitting::Pieces;
    use affine_core::scalar::Scalar;
    use num_traits::Zero;
    use pulp::Arch;

    const STEP: f64 = 0.01;

    /// `x' = v` and `v' = -x^3 + cos(t)/8`, whose time is that of the step.
    struct Driven;

    /// Adds to one of two numbers.
    fn flow<T: Scalar>(piece: usize, (t, h): (f64, f64), value: &mut [T; 2], carry: &mut [T; 2]) {
        let [x, v] = *value;
        let constant = |number: f64| T::constant(number, 0.0);
        let (moved, rate) = match piece {
            0 => (0, v),
            _ => (1, constant(0.125 * libm::cos(t)) - x * x * x),
        };
        let rise = carry[moved] + constant(h) * rate;
        let before = value[moved];
        value[moved] = before + rise;
        carry[moved] = (before - value[moved]) + rise;
    }

    impl Pieces<[f64; 2], ()> for Driven {
        const COUNT: usize = 2;
        const NYSTROM: bool = true;
        const DILATES: bool = false;
        fn flow(&self, piece: usize, t: f64, h: f64, (): &(), state: &mut Sum<[f64; 2]>) {
            flow(piece, (t, h), &mut state.value, &mut state.carry);
        }
    }

    impl<T: Lanes> PiecesInLanes<T, [T; 2]> for Driven {
        const COUNT: usize = 2;
        const NYSTROM: bool = true;
        const DILATES: bool = false;
        #[inline(always)]
        fn flow(&self, piece: usize, t: f64, h: f64, state: &mut Sum<[T; 2]>) {
            flow(piece, (t, h), &mut state.value, &mut state.carry);
        }
        /// Positions may not change by more than a hundredth.
        #[inline(always)]
        fn doubts(&self, (_, from): (f64, &[T; 2]), _h: f64, to: &[T; 2]) -> T {
            T::from_lanes(|lane| f64::from(u8::from((to[0].lane(lane) - from[0].lane(lane)).abs() > 0.01)))
        }
    }

    fn start(lane: usize) -> [f64; 2] {
        [0.3 * lane as f64, 0.1]
    }

    type InLanes = SplittingInLanes<F64x8, [F64x8; 2], Driven>;

    fn begun(order: usize) -> Result<InLanes, Failure> {
        let mut lanes = InLanes::new(Driven, order, 1.0, STEP).ok_or(Failure::NotSeparable)??;
        (0..8).for_each(|lane| lanes.put(lane, &start(lane)));
        Ok(lanes)
    }

    /// Steps to two ends, the second of them before the first.
    #[test]
    fn lanes_are_where_each_is_alone() -> Result<(), Failure> {
        for order in [2, 4, 6, 8] {
            let mut lanes = begun(order)?;
            let alone = |lane| Splitting::new((Driven, ()), order, (1.0, start(lane)), 1.0, STEP);
            let alone: Option<Vec<_>> = (0..8).map(alone).collect();
            let mut alone = alone.unwrap_or_default().into_iter().collect::<Result<Vec<_>, _>>()?;
            assert_eq!(alone.len(), 8);
            for t_end in [1.234, 1.1] {
                lanes.aim(t_end)?;
                alone.iter_mut().try_for_each(|body| body.aim(t_end))?;
                while !lanes.is_finished() {
                    let doubts = lanes.advance();
                    let (t, states) = lanes.end();
                    for (lane, body) in alone.iter_mut().enumerate() {
                        let before = body.y()[0];
                        body.advance()?;
                        assert_eq!((body.t(), *body.y()), (t, states.map(|number| number.lane(lane))));
                        let begin = lanes.begin().map(|(_, states)| states[0].lane(lane));
                        assert_eq!(begin, Some(before), "where the step began");
                        let middle = t - 0.3 * STEP.copysign(t_end - 1.2);
                        let of_one =
                            |piece, t, h, state: &mut Sum<_>| Pieces::flow(&Driven, piece, t, h, &(), state);
                        assert_eq!(lanes.within(lane, middle, of_one), Some(body.at(middle)?));
                        assert_eq!(doubts.lane(lane) != 0.0, (body.y()[0] - before).abs() > 0.01);
                    }
                }
                assert_eq!(lanes.end().0, t_end);
            }
            assert_eq!(lanes.advance(), F64x8::zero(), "nothing is done at the end");
            let states = *lanes.end().1;
            lanes.aim(2.0)?;
            lanes.pass_over();
            assert!(lanes.is_finished() && lanes.end() == (2.0, &states));
            assert!(InLanes::new(Driven, order + 1, 1.0, STEP).is_none());
        }
        Ok(())
    }

    /// Numbers after a step on one kind of vectors, as bits.
    fn stepped(step: impl Fn(Step<'_, F64x8, [F64x8; 2], Driven>) -> F64x8) -> Result<Vec<u64>, Failure> {
        let SplittingInLanes { pieces, sweeps, steps, .. } = begun(6)?;
        let mut to = *steps.end();
        let from = steps.end();
        let work =
            Step { pieces: &pieces, sweeps: &sweeps, at: (1.0, 0.3), from, to: &mut to, doubts: PhantomData };
        let doubts = step(work);
        let numbers = [doubts, to.value[0], to.value[1], to.carry[0], to.carry[1]];
        Ok(numbers.iter().flat_map(|lanes| lanes.as_slice()).map(|number| number.to_bits()).collect())
    }

    #[test]
    fn vectors_of_any_width_round_the_same() -> Result<(), Failure> {
        let widest = stepped(|step| Arch::new().dispatch(step))?;
        assert_eq!(stepped(|step| pulp::Scalar::vectorize(pulp::Scalar, step))?, widest);
        #[cfg(target_arch = "x86_64")]
        if let Some(avx2) = pulp::x86::V3::try_new() {
            assert_eq!(stepped(|step| Simd::vectorize(avx2, step))?, widest);
        }
        Ok(())
    }
}
