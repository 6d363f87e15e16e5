//! The method of order 8 for several bodies at once, each in a lane with steps of its own.

use num_traits::Zero;

use super::dormand_prince_853::*;
use super::pair::{DormandPrince853, E3, Pair};
use super::start::Start;
use crate::integrate::error_norm::NormInLanes;
use crate::integrate::step_size::in_lanes::{Clocks, fate};
use crate::integrate::taylor::Vectors;
use crate::integrate::widest::{Work, widest_in_lanes};
use crate::lanes::{Lanes, in_lane};
use crate::model::{Group, StateVector};
use crate::scalar::{Real, Scalar};

const STAGES: usize = 13;
/// Place of the slope at the end of a step, which is the first of the next.
const AT_END: usize = 12;

/// `y' = f(t, y)` in lanes. A trait, since a closure cannot be made part of the function that is compiled for the
/// processor's vectors: what is called from there is compiled for the vectors of every processor.
pub(crate) trait Equations<T, S> {
    /// Writes `f(t, y)`; to be `#[inline(always)]`. In place, since states of many lanes are long.
    fn slope(&self, t: T, y: &S, slope: &mut S);

    /// A step may end at the state in a lane; to be `#[inline(always)]`.
    fn is_sound(&self, y: &S, lane: usize) -> bool;
}

/// Bodies in lanes: [`RungeKutta8`](super::RungeKutta8) of each, operation by operation, at its own time and with its own
/// steps. A lane that is done is given the next body, while the others are on their way.
pub(crate) struct RungeKutta8InLanes<T, S, F> {
    f: F,
    norm: NormInLanes<T>,
    tolerance: f64,
    clocks: Clocks<T>,
    y: S,
    trial: S,
    stages: [S; STAGES],
}

/// What happens to the body in a lane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fate {
    /// It has come to the end.
    Arrived,
    /// It cannot go on, or not in lanes.
    Stuck,
}

impl<T: Lanes, S: StateVector<T>, F: Equations<T, S>> RungeKutta8InLanes<T, S, F> {
    /// Lanes without bodies, for motions to `t_end` of at most so many steps. All are to be given one before the first
    /// step: there is no motion from a state of zeros.
    pub(crate) fn new(f: F, groups: &'static [Group], t_end: f64, tolerance: f64, max_steps: u64) -> Self {
        Self {
            f,
            norm: NormInLanes::new(groups),
            tolerance,
            clocks: Clocks::new(DormandPrince853::ERROR_ORDER, t_end, max_steps),
            y: S::zeros(),
            trial: S::zeros(),
            stages: [S::zeros(); STAGES],
        }
    }

    /// The equations.
    pub(crate) fn equations(&mut self) -> &mut F {
        &mut self.f
    }

    /// Puts a body into a lane.
    pub(crate) fn start<R: StateVector<f64>>(&mut self, lane: usize, (t0, y0): (f64, &R), start: &Start<R>) {
        let from = y0.as_ref().iter().zip(start.slope.as_ref());
        for ((y, slope), (y0, slope0)) in self.y.as_mut().iter_mut().zip(self.stages[0].as_mut()).zip(from) {
            y.set_lane(lane, *y0);
            slope.set_lane(lane, *slope0);
        }
        self.norm.set_lane(lane, &start.error_norm);
        self.clocks.start(lane, t0, start.length);
    }

    /// Stops what moves in a lane.
    pub(crate) fn rest(&mut self, lane: usize) {
        self.clocks.rest(lane);
    }

    /// Tries one step in every lane; what becomes of a body, where its way ends.
    pub(crate) fn advance(&mut self) -> impl Iterator<Item = (usize, Fate)> + use<T, S, F> {
        let fates = widest_in_lanes(Trial(self));
        (0..T::LANES).filter_map(move |lane| match fates.lane(lane) {
            fate::UNDER_WAY => None,
            fate::ARRIVED => Some((lane, Fate::Arrived)),
            _ => Some((lane, Fate::Stuck)),
        })
    }

    /// A component of the state reached in a lane.
    pub(crate) fn y(&self) -> &S {
        &self.y
    }

    #[inline(always)]
    fn step(&mut self) -> T {
        self.clocks.aim();
        let h = self.clocks.end - self.clocks.t;
        self.stage::<2, 1>(h, &A2);
        self.stage::<3, 2>(h, &A3);
        self.stage::<4, 2>(h, &A4);
        self.stage::<5, 3>(h, &A5);
        self.stage::<6, 3>(h, &A6);
        self.stage::<7, 4>(h, &A7);
        self.stage::<8, 5>(h, &A8);
        self.stage::<9, 6>(h, &A9);
        self.stage::<10, 7>(h, &A10);
        self.stage::<11, 8>(h, &A11);
        self.stage::<12, 9>(h, &A12);
        self.moved(h, &B);
        self.f.slope(self.clocks.end, &self.trial, &mut self.stages[AT_END]);
        let error = self.error(h.abs());
        self.turn(error)
    }

    #[inline(always)]
    fn stage<const NUMBER: usize, const TERMS: usize>(&mut self, h: T, row: &[(usize, f64); TERMS]) {
        let (_, node) = NODES[NUMBER - 2];
        let mut time = self.clocks.end;
        if node != 1.0 {
            for lane in 0..T::LANES {
                time.set_lane(lane, self.clocks.t.lane(lane) + node * h.lane(lane));
            }
        }
        self.moved(h, row);
        self.f.slope(time, &self.trial, &mut self.stages[NUMBER - 1]);
    }

    /// The trial states at the stage of a row.
    #[inline(always)]
    fn moved<const TERMS: usize>(&mut self, h: T, row: &[(usize, f64); TERMS]) {
        for i in 0..S::LEN {
            let (y, mut moved) = (self.y.as_ref()[i], T::zero());
            for lane in 0..T::LANES {
                let sum: T::Lane = combination(&self.stages, (i, lane), row);
                moved.set_lane(lane, sum.fma(in_lane(&h, lane), in_lane(&y, lane)).to_f64());
            }
            self.trial.as_mut()[i] = moved;
        }
    }

    /// Estimated errors relative to the tolerance, of steps of these lengths.
    #[inline(always)]
    fn error(&self, h: T) -> T {
        let (before, after) = (self.y.as_ref(), self.trial.as_ref());
        let (mut largest, mut start) = (T::zero(), 0);
        for (k, group) in self.norm.groups().iter().enumerate() {
            let range = start..start + group.len;
            start = range.end;
            let (mut fifth, mut third) = (T::zero(), T::zero());
            for i in range.clone() {
                for lane in 0..T::LANES {
                    let of_fifth = combination::<T, S, _>(&self.stages, (i, lane), &E5).to_f64();
                    let of_third = combination::<T, S, _>(&self.stages, (i, lane), &E3).to_f64();
                    fifth.set_lane(lane, fifth.lane(lane) + of_fifth * of_fifth);
                    third.set_lane(lane, third.lane(lane) + of_third * of_third);
                }
            }
            let mut value = T::zero();
            for lane in 0..T::LANES {
                value.set_lane(lane, DormandPrince853::error((fifth.lane(lane), third.lane(lane))));
            }
            largest = self.norm.larger(largest, (k, range), value, h, (before, after));
        }
        for lane in 0..T::LANES {
            largest.set_lane(lane, h.lane(lane) * largest.lane(lane) / self.tolerance);
        }
        largest
    }

    /// Accepts the steps with errors of at most 1 whose slopes at the end are finite; what becomes of the lanes.
    #[inline(always)]
    fn turn(&mut self, error: T) -> T {
        let (mut not_finite, mut accepted, mut unsound) = (T::zero(), T::zero(), T::zero());
        for slope in self.stages[AT_END].as_ref() {
            for lane in 0..T::LANES {
                // 0, or NaN once one of them is not finite.
                not_finite.set_lane(lane, not_finite.lane(lane) + 0.0 * slope.lane(lane));
            }
        }
        for lane in 0..T::LANES {
            let is_accepted = error.lane(lane) <= 1.0 && not_finite.lane(lane) == 0.0;
            accepted.set_lane(lane, if is_accepted { 1.0 } else { 0.0 });
            unsound.set_lane(lane, if self.f.is_sound(&self.trial, lane) { 0.0 } else { 1.0 });
        }
        for i in 0..S::LEN {
            let (slope, trial) = (self.stages[AT_END].as_ref()[i], self.trial.as_ref()[i]);
            let (first, y) = (&mut self.stages[0].as_mut()[i], &mut self.y.as_mut()[i]);
            for lane in 0..T::LANES {
                let is_accepted = accepted.lane(lane) != 0.0;
                first.set_lane(lane, if is_accepted { slope.lane(lane) } else { first.lane(lane) });
                y.set_lane(lane, if is_accepted { trial.lane(lane) } else { y.lane(lane) });
            }
        }
        self.clocks.turn(accepted, error, unsound)
    }
}

/// Component `i` of the slopes in a lane, each times the coefficient that a row has for it.
#[inline(always)]
fn combination<T: Lanes, S: StateVector<T>, const TERMS: usize>(
    stages: &[S; STAGES],
    (i, lane): (usize, usize),
    row: &[(usize, f64); TERMS],
) -> T::Lane {
    let [(first, leading), ref rest @ ..] = row[..] else { return T::Lane::zero() };
    let of = |stage: usize| in_lane(&stages[stage - 1].as_ref()[i], lane);
    let mut sum = of(first) * T::Lane::from_f64(leading);
    for (stage, coefficient) in rest {
        sum = of(*stage).fma(T::Lane::from_f64(*coefficient), sum);
    }
    sum
}

/// A step in every lane.
struct Trial<'a, T, S, F>(&'a mut RungeKutta8InLanes<T, S, F>);

impl<T: Lanes, S: StateVector<T>, F: Equations<T, S>> Work for Trial<'_, T, S, F> {
    type Output = T;
    #[inline(always)]
    fn run(self, _vectors: impl Vectors) -> T {
        self.0.step()
    }
}
