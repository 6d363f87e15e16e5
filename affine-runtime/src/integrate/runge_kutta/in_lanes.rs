//! The method of order 8 for several bodies at once, with steps that they share.

use super::dormand_prince_853::*;
use super::pair::{DormandPrince853, E3, Pair};
use crate::integrate::error_norm::{NormInLanes, norm_in_lanes, squares_in_lanes};
use crate::integrate::roughly::{exp, ln};
use crate::integrate::step_size::{Controller, FIRST_ERROR, next_time, shortest};
use crate::integrate::taylor::Vectors;
use crate::integrate::widest::{Work, widest};
use crate::lanes::Lanes;
use crate::model::{Group, StateVector};

const STAGES: usize = 13;
/// Place of the slope at the end of a step, which is the first of the next.
const AT_END: usize = 12;

/// `y' = f(t, y)` in lanes. A trait, since a closure cannot be made part of the function that is compiled for the
/// processor's vectors: what is called from there is compiled for the vectors of every processor.
pub(crate) trait Equations<T, S> {
    /// Writes `f(t, y)`; to be `#[inline(always)]`. In place, since states of many lanes are long.
    fn slope(&self, t: T, y: &S, slope: &mut S);
}

/// Bodies in lanes from `t0` to `t_end`: [`RungeKutta8`](super::RungeKutta8) operation by operation, but for the step
/// size, which is that of the lane with the largest error. Where all lanes hold the same body, each has the bits of that
/// body alone.
pub(crate) struct RungeKutta8InLanes<T, S, F> {
    f: F,
    norm: NormInLanes<T>,
    tolerance: f64,
    controller: Controller,
    t: f64,
    y: S,
    trial: S,
    stages: [S; STAGES],
    length: f64,
    t_end: f64,
    steps: u64,
}

/// Lanes that a step cannot be taken with.
pub(crate) type Failing = Vec<usize>;

impl<T: Lanes, S: StateVector<T>, F: Equations<T, S>> RungeKutta8InLanes<T, S, F> {
    /// The integration at its start.
    ///
    /// # Errors
    /// The lanes whose state or slope is not finite.
    pub(crate) fn new(
        f: F,
        groups: &'static [Group],
        (t0, y0): (f64, S),
        t_end: f64,
        tolerance: f64,
    ) -> Result<Self, Failing> {
        let t = T::constant(t0, 0.0);
        let value = |t, y: &S| {
            let mut slope = S::zeros();
            f.slope(t, y, &mut slope);
            slope
        };
        let slope = value(t, &y0);
        none(T::LANES, |lane| !is_finite(&y0, lane) || !is_finite(&slope, lane))?;
        let norm = NormInLanes::probed(groups, &value, (t, &y0, &slope));
        let length = first_step(&value, &norm, (t0, &y0, &slope), t_end - t0, tolerance);
        let mut stages = [S::zeros(); STAGES];
        stages[0] = slope;
        let controller = Controller::of(DormandPrince853::ERROR_ORDER, DormandPrince853::MARGIN);
        Ok(Self { f, norm, tolerance, controller, t: t0, y: y0, trial: y0, stages, length, t_end, steps: 0 })
    }

    /// Takes one accepted step.
    ///
    /// # Errors
    /// The lanes whose errors stay above the tolerance however short the step.
    pub(crate) fn advance(&mut self) -> Result<(), Failing> {
        loop {
            let end = next_time(self.t, self.length, self.t_end);
            let error = widest(Trial { integration: self, end });
            let mut worst = worst(&error);
            if worst <= 1.0 {
                if none(T::LANES, |lane| !is_finite(&self.stages[AT_END], lane)).is_ok() {
                    self.length = (end - self.t).abs() * self.controller.accept(worst);
                    (self.t, self.y, self.stages[0]) = (end, self.trial, self.stages[AT_END]);
                    self.steps += 1;
                    return Ok(());
                }
                worst = f64::NAN;
            }
            self.length = (end - self.t).abs() * self.controller.reject(worst);
            if self.length <= shortest(self.t, self.t_end) {
                none(T::LANES, |lane| error.lane(lane) > 1.0 || error.lane(lane).is_nan())?;
                // Slopes at the end alone are not finite.
                return Err((0..T::LANES).collect());
            }
        }
    }

    /// Time reached.
    pub(crate) fn t(&self) -> f64 {
        self.t
    }

    /// States reached.
    pub(crate) fn y(&self) -> &S {
        &self.y
    }

    /// Accepted steps.
    pub(crate) fn steps(&self) -> u64 {
        self.steps
    }

    #[inline(always)]
    fn attempt(&mut self, end: f64) {
        self.stage::<2, 1>(end, &A2);
        self.stage::<3, 2>(end, &A3);
        self.stage::<4, 2>(end, &A4);
        self.stage::<5, 3>(end, &A5);
        self.stage::<6, 3>(end, &A6);
        self.stage::<7, 4>(end, &A7);
        self.stage::<8, 5>(end, &A8);
        self.stage::<9, 6>(end, &A9);
        self.stage::<10, 7>(end, &A10);
        self.stage::<11, 8>(end, &A11);
        self.stage::<12, 9>(end, &A12);
        self.moved(end, &B);
    }

    #[inline(always)]
    fn stage<const NUMBER: usize, const TERMS: usize>(&mut self, end: f64, row: &[(usize, f64); TERMS]) {
        let (_, node) = NODES[NUMBER - 2];
        let time = if node == 1.0 { end } else { self.t + node * (end - self.t) };
        self.moved(end, row);
        self.f.slope(T::constant(time, 0.0), &self.trial, &mut self.stages[NUMBER - 1]);
    }

    /// The trial state at the stage of a row.
    #[inline(always)]
    fn moved<const TERMS: usize>(&mut self, end: f64, row: &[(usize, f64); TERMS]) {
        let h = T::constant(end - self.t, 0.0);
        for (i, trial) in self.trial.as_mut().iter_mut().enumerate() {
            *trial = combination(&self.stages, i, row).fma(h, self.y.as_ref()[i]);
        }
    }

    /// Estimated errors relative to the tolerance.
    #[inline(always)]
    fn error(&self, end: f64) -> T {
        let (mut fifth, mut third) = (S::zeros(), S::zeros());
        for i in 0..S::LEN {
            fifth.as_mut()[i] = combination(&self.stages, i, &E5);
            third.as_mut()[i] = combination(&self.stages, i, &E3);
        }
        let h = T::constant((end - self.t).abs(), 0.0);
        let relative = self.norm.largest(h, self.y.as_ref(), self.trial.as_ref(), |range| {
            let fifth = squares_in_lanes(&fifth.as_ref()[range.clone()]);
            let third = squares_in_lanes(&third.as_ref()[range]);
            let value = fifth / (fifth + T::constant(0.01, 0.0) * third).sqrt();
            T::from_lanes(|lane| if fifth.lane(lane) == 0.0 { 0.0 } else { value.lane(lane) })
        });
        h * relative / T::constant(self.tolerance, 0.0)
    }
}

/// Component `i` of the slopes, each times the coefficient that a row has for it.
#[inline(always)]
fn combination<T: Lanes, S: StateVector<T>, const TERMS: usize>(
    stages: &[S; STAGES],
    i: usize,
    row: &[(usize, f64); TERMS],
) -> T {
    let mut sum = T::zero();
    for (stage, coefficient) in row {
        sum = stages[stage - 1].as_ref()[i].fma(T::constant(*coefficient, 0.0), sum);
    }
    sum
}

/// A step of an integration to the time `end`, with the slope behind it, which most steps need; its errors.
struct Trial<'a, T, S, F> {
    integration: &'a mut RungeKutta8InLanes<T, S, F>,
    end: f64,
}

impl<T: Lanes, S: StateVector<T>, F: Equations<T, S>> Work for Trial<'_, T, S, F> {
    type Output = T;
    #[inline(always)]
    fn run(self, _vectors: impl Vectors) -> T {
        let integration = self.integration;
        integration.attempt(self.end);
        let slope = &mut integration.stages[AT_END];
        integration.f.slope(T::constant(self.end, 0.0), &integration.trial, slope);
        integration.error(self.end)
    }
}

/// The first step of the lane that has the shortest one; see the scalar `first_step`.
fn first_step<T: Lanes, S: StateVector<T>>(
    f: &impl Fn(T, &S) -> S,
    error_norm: &NormInLanes<T>,
    (t, y, slope): (f64, &S, &S),
    span: f64,
    tolerance: f64,
) -> f64 {
    let forever = T::constant(f64::INFINITY, 0.0);
    let rate = |end: &S, change: &S| {
        error_norm.largest(forever, y.as_ref(), end.as_ref(), |r| norm_in_lanes(&change.as_ref()[r]))
    };
    let first = rate(y, slope);
    let within = |h: f64| if h < span.abs() { h } else { span.abs() };
    let trial = T::from_lanes(|lane| {
        let first = first.lane(lane);
        if first > 0.0 && first.is_finite() { within(0.01 / first) } else { 1e-6 * span.abs() }
    });
    let signed = T::from_lanes(|lane| trial.lane(lane).copysign(span));
    let (mut end, mut change) = (*y, S::zeros());
    for (y, slope) in end.as_mut().iter_mut().zip(slope.as_ref()) {
        *y += signed * *slope;
    }
    let slope_after = f(T::constant(t, 0.0) + signed, &end);
    for (i, change) in change.as_mut().iter_mut().enumerate() {
        *change = (slope_after.as_ref()[i] - slope.as_ref()[i]) / trial;
    }
    let second = rate(&end, &change).sqrt();
    let of_lane = |lane: usize| {
        let (first, second, trial) = (first.lane(lane), second.lane(lane), trial.lane(lane));
        let fastest = if first.is_finite() && first > second { first } else { second };
        let length = exp(ln(FIRST_ERROR * tolerance) / DormandPrince853::ERROR_ORDER) / fastest;
        within(if length < 100.0 * trial { length } else { 100.0 * trial })
    };
    (0..T::LANES).map(of_lane).fold(span.abs(), f64::min)
}

/// The largest error; NaN where one is.
fn worst<T: Lanes>(error: &T) -> f64 {
    (0..T::LANES)
        .map(|lane| error.lane(lane))
        .fold(0.0, |worst, e| if e <= worst || f64::is_nan(worst) { worst } else { e })
}

/// The lanes that something is wrong with, as an error.
fn none(lanes: usize, is_wrong: impl Fn(usize) -> bool) -> Result<(), Failing> {
    let wrong: Failing = (0..lanes).filter(|lane| is_wrong(*lane)).collect();
    if wrong.is_empty() { Ok(()) } else { Err(wrong) }
}

fn is_finite<T: Lanes, S: StateVector<T>>(y: &S, lane: usize) -> bool {
    y.as_ref().iter().all(|v| v.lane(lane).is_finite())
}
