//! Embedded explicit Runge-Kutta method of order 8 with step size control and dense output.

mod dormand_prince_853;
#[cfg(feature = "std")]
pub(crate) mod in_lanes;
mod step;

pub use step::{Dense, Step};

use core::fmt;

use super::error_norm::{ErrorNorm, sum_of_squares};
use super::lie::{Coordinates, Flat, Sum};
use super::step_size::{Controller, ERROR_ORDER, first_step, next_time, shortest};
#[cfg(feature = "std")]
use super::tape::Tape;
use super::taylor::Vectors;
use super::widest::{Work, widest};
use super::{Failure, Statistics};
use crate::model::{Group, StateVector};
use crate::scalar::Scalar;

/// Adaptive integration of `y' = f(t, y)` from `t0` to `t_end`, in either direction of time, by the method of
/// Dormand and Prince of order 8.
///
/// A step is accepted when its estimated error, relative to the tolerance in the [`ErrorNorm`], is at most 1: with
/// `e_5`, `e_3` the differences to the embedded solutions of orders 5 and 3,
/// `error = h |e_5|^2 / sqrt(|e_5|^2 + 0.01 |e_3|^2)`, which is of order `h^8` (Hairer, Norsett, Wanner, Solving
/// Ordinary Differential Equations I, (10.17)). The tolerance bounds the error of each step; what accumulates
/// depends on the problem.
///
/// Cost: 12 evaluations per accepted step, 11 (or 12, where only the slope at its end is not finite) per rejected
/// one, 3 for the dense output of a step; at the start 2, and one for each component of a momentum.
#[derive(Clone)]
pub struct RungeKutta8<S, F, C = Flat> {
    f: F,
    coordinates: C,
    error_norm: ErrorNorm,
    tolerance: f64,
    controller: Controller,
    /// In the coordinates around `begin`.
    step: Step<S>,
    begin: Sum<S>,
    /// The state reached.
    end: Sum<S>,
    /// Its time derivative.
    rate: S,
    length: f64,
    t_end: f64,
    failure: Option<Failure>,
    statistics: Statistics,
}

impl<S: StateVector<f64>, F: Fn(f64, &S) -> S> RungeKutta8<S, F> {
    /// The integration at its start: `groups` lay out the state vector for the [`ErrorNorm`].
    ///
    /// # Errors
    /// [`Failure::NotFinite`] where `y0` or `f(t0, y0)` is not finite.
    pub fn new(
        f: F,
        groups: &'static [Group],
        start: (f64, S),
        t_end: f64,
        tolerance: f64,
    ) -> Result<Self, Failure> {
        Self::within(Flat, f, groups, start, t_end, tolerance)
    }
}

impl<S: StateVector<f64>, F: Fn(f64, &S) -> S, C: Coordinates<S>> RungeKutta8<S, F, C> {
    /// The integration at its start, in other coordinates: on a group, in the chart around the beginning of each step.
    /// Errors are those of the state itself, in the norm of `groups`.
    ///
    /// # Errors
    /// As [`new`](RungeKutta8::new).
    pub fn within(
        coordinates: C,
        f: F,
        groups: &'static [Group],
        (t0, y0): (f64, S),
        t_end: f64,
        tolerance: f64,
    ) -> Result<Self, Failure> {
        let slope = f(t0, &y0);
        if !is_finite(&y0) || !is_finite(&slope) {
            return Err(Failure::NotFinite);
        }
        let mut statistics = Statistics { evaluations: 1, ..Statistics::default() };
        let (mut error_norm, mut length) = (ErrorNorm::new(groups), 0.0);
        if t_end != t0 {
            let probes;
            (error_norm, probes) = ErrorNorm::probed(groups, &f, (t0, &y0, &slope));
            statistics.evaluations += probes;
            length = first_step(&f, &error_norm, (t0, &y0, &slope), t_end - t0, (tolerance, ERROR_ORDER));
            statistics.evaluations += 1;
        }
        let controller = Controller::of(ERROR_ORDER);
        let begin = Sum::of(y0);
        let origin = coordinates.origin(&begin).value;
        let step = Step::at(t0, origin, coordinates.velocity(&y0, &origin, &slope));
        Ok(Self {
            f,
            coordinates,
            error_norm,
            tolerance,
            controller,
            step,
            begin,
            end: begin,
            rate: slope,
            length,
            t_end,
            failure: None,
            statistics,
        })
    }

    /// Takes one accepted step; does nothing at `t_end`, which the last step hits exactly.
    ///
    /// # Errors
    /// [`Failure`], now and ever after; the state stays that of the last accepted step.
    pub fn advance(&mut self) -> Result<(), Failure> {
        if let Some(failure) = self.failure {
            return Err(failure);
        }
        if self.is_finished() {
            return Ok(());
        }
        self.begin_next();
        loop {
            let end = next_time(self.step.time(), self.length, self.t_end);
            self.statistics.evaluations += 11;
            let (reached, mut error) = widest(Trial { integration: self, end });
            if error <= 1.0 {
                self.rate = (self.f)(end, &reached.value);
                let slope = self.coordinates.velocity(&reached.value, self.step.trial_end(), &self.rate);
                self.step.accept_with(slope);
                self.statistics.evaluations += 1;
                if is_finite(&slope) {
                    self.end = reached;
                    self.statistics.steps += 1;
                    self.length = self.step.length().abs() * self.controller.accept(error);
                    return Ok(());
                }
                error = f64::NAN;
            }
            self.statistics.rejected += 1;
            self.length = self.step.length().abs() * self.controller.reject(error);
            if self.length <= shortest(self.step.time(), self.t_end) {
                self.step.withdraw();
                let failure = if error.is_finite() { Failure::StepUnderflow } else { Failure::NotFinite };
                self.failure = Some(failure);
                return Err(failure);
            }
        }
    }

    /// Dense output over the last accepted step: three evaluations.
    pub fn dense(&mut self) -> Dense<S, C> {
        self.statistics.evaluations += 3;
        let dense = self.step.dense(&in_coordinates(&self.f, self.coordinates, &self.begin));
        dense.around(self.coordinates, self.begin, self.end.value)
    }

    /// Everything that the next steps depend on, of an integration between two steps.
    #[cfg(feature = "std")]
    pub(crate) fn exchange(&mut self, tape: &mut impl Tape) {
        let mut t = self.t();
        tape.number(&mut t);
        tape.sum(&mut self.end);
        tape.state(&mut self.rate);
        tape.number(&mut self.length);
        self.controller.exchange(tape);
        tape.statistics(&mut self.statistics);
        let origin = self.coordinates.origin(&self.end).value;
        self.step = Step::at(t, origin, self.coordinates.velocity(&self.end.value, &origin, &self.rate));
        self.begin = self.end;
    }

    /// Time reached.
    #[must_use]
    pub fn t(&self) -> f64 {
        self.step.end_time()
    }

    /// State reached.
    #[must_use]
    pub fn y(&self) -> &S {
        &self.end.value
    }

    /// `t_end` is reached.
    #[must_use]
    pub fn is_finished(&self) -> bool {
        self.t() == self.t_end
    }

    /// Cost so far.
    #[must_use]
    pub fn statistics(&self) -> Statistics {
        self.statistics
    }

    /// Computes a step to the time `end`: the state there, and its error.
    #[inline(always)]
    fn attempt(&mut self, end: f64) -> (Sum<S>, f64) {
        self.step.attempt(&in_coordinates(&self.f, self.coordinates, &self.begin), end);
        let reached = self.coordinates.state(&self.begin, self.step.trial_end());
        let error = self.error(&reached.value);
        (reached, error)
    }

    /// Turns to the next step, in coordinates around the state reached.
    fn begin_next(&mut self) {
        let origin = self.coordinates.origin(&self.end).value;
        let slope = self.coordinates.velocity(&self.end.value, &origin, &self.rate);
        self.begin = self.end;
        self.step.begin_next_at(origin, slope);
    }

    /// Estimated error of the attempted step relative to the tolerance; NaN where something is not finite.
    #[inline(always)]
    fn error(&self, reached: &S) -> f64 {
        let (fifth, third) = self.step.error_slopes();
        let fifth = self.coordinates.change(&self.begin, &fifth);
        let third = self.coordinates.change(&self.begin, &third);
        let before = self.begin.value.as_ref();
        let after = reached.as_ref();
        let relative = self.error_norm.largest(self.step.length().abs(), before, after, |range| {
            let fifth = sum_of_squares(&fifth.as_ref()[range.clone()]);
            let third = sum_of_squares(&third.as_ref()[range]);
            if fifth == 0.0 { 0.0 } else { fifth / Scalar::sqrt(fifth + 0.01 * third) }
        });
        self.step.length().abs() * relative / self.tolerance
    }
}

impl<S: StateVector<f64>, F, C> fmt::Debug for RungeKutta8<S, F, C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("RungeKutta8")
            .field("t", &self.step.end_time())
            .field("y", &self.end.value)
            .field("t_end", &self.t_end)
            .field("tolerance", &self.tolerance)
            .field("statistics", &self.statistics)
            .finish_non_exhaustive()
    }
}

/// A step of an integration to the time `end`.
struct Trial<'a, S, F, C> {
    integration: &'a mut RungeKutta8<S, F, C>,
    end: f64,
}

impl<S: StateVector<f64>, F: Fn(f64, &S) -> S, C: Coordinates<S>> Work for Trial<'_, S, F, C> {
    type Output = (Sum<S>, f64);
    #[inline(always)]
    fn run(self, _vectors: impl Vectors) -> (Sum<S>, f64) {
        self.integration.attempt(self.end)
    }
}

/// `z'` as a function of `t` and of the coordinates `z` around `base`.
#[inline(always)]
fn in_coordinates<S: StateVector<f64>, C: Coordinates<S>>(
    f: &impl Fn(f64, &S) -> S,
    coordinates: C,
    base: &Sum<S>,
) -> impl Fn(f64, &S) -> S {
    move |t, z| {
        let state = coordinates.state(base, z).value;
        coordinates.velocity(&state, z, &f(t, &state))
    }
}

fn is_finite<S: StateVector<f64>>(y: &S) -> bool {
    y.as_ref().iter().all(|v| v.is_finite())
}
