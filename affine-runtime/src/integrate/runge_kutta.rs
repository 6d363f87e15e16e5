//! Embedded explicit Runge-Kutta method of order 8 with step size control and dense output.

mod dormand_prince_853;
mod step;

pub use step::{Dense, Step};

use core::fmt;

use super::error_norm::{ErrorNorm, sum_of_squares};
use super::step_size::{Controller, first_step};
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
pub struct RungeKutta8<S, F> {
    f: F,
    error_norm: ErrorNorm,
    tolerance: f64,
    controller: Controller,
    step: Step<S>,
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
        (t0, y0): (f64, S),
        t_end: f64,
        tolerance: f64,
    ) -> Result<Self, Failure> {
        let step = Step::start(&f, t0, y0);
        if !is_finite(&y0) || !is_finite(step.slope()) {
            return Err(Failure::NotFinite);
        }
        let mut statistics = Statistics { evaluations: 1, ..Statistics::default() };
        let (mut error_norm, mut length) = (ErrorNorm::new(groups), 0.0);
        if t_end != t0 {
            let probes;
            (error_norm, probes) = ErrorNorm::probed(groups, &f, (t0, &y0, step.slope()));
            statistics.evaluations += probes;
            length = first_step(&f, &error_norm, (t0, &y0, step.slope()), t_end - t0, tolerance);
            statistics.evaluations += 1;
        }
        let controller = Controller::new();
        Ok(Self { f, error_norm, tolerance, controller, step, length, t_end, failure: None, statistics })
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
        self.step.begin_next();
        loop {
            let end = self.next_time();
            self.step.attempt(&self.f, end);
            self.statistics.evaluations += 11;
            let mut error = self.error();
            if error <= 1.0 {
                self.step.accept(&self.f);
                self.statistics.evaluations += 1;
                if is_finite(self.step.end_slope()) {
                    self.statistics.steps += 1;
                    self.length = self.step.length().abs() * self.controller.accept(error);
                    return Ok(());
                }
                error = f64::NAN;
            }
            self.statistics.rejected += 1;
            self.length = self.step.length().abs() * self.controller.reject(error);
            if self.length <= self.shortest() {
                self.step.withdraw();
                let failure = if error.is_finite() { Failure::StepUnderflow } else { Failure::NotFinite };
                self.failure = Some(failure);
                return Err(failure);
            }
        }
    }

    /// Dense output over the last accepted step: three evaluations.
    pub fn dense(&mut self) -> Dense<S> {
        self.statistics.evaluations += 3;
        self.step.dense(&self.f)
    }

    /// Time reached.
    #[must_use]
    pub fn t(&self) -> f64 {
        self.step.end_time()
    }

    /// State reached.
    #[must_use]
    pub fn y(&self) -> &S {
        self.step.end()
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

    /// End of the step to try: `t_end` itself where the step reaches about there, and half the way where it
    /// reaches further than that, since a step and a short rest cost as much as two equal ones.
    fn next_time(&self) -> f64 {
        let t = self.step.time();
        let rest = self.t_end - t;
        if 1.01 * self.length >= rest.abs() {
            self.t_end
        } else if 2.0 * self.length > rest.abs() {
            t + 0.5 * rest
        } else {
            t + self.length.copysign(rest)
        }
    }

    /// Steps at or below this length are lost in the rounding of times.
    fn shortest(&self) -> f64 {
        let t = self.step.time().abs();
        let span = (self.t_end - self.step.time()).abs();
        16.0 * f64::EPSILON * if t > f64::EPSILON * span { t } else { f64::EPSILON * span }
    }

    /// Estimated error of the attempted step relative to the tolerance; NaN where something is not finite.
    fn error(&self) -> f64 {
        let (fifth, third) = self.step.error_slopes();
        let before = self.step.begin().as_ref();
        let after = self.step.trial_end().as_ref();
        let relative = self.error_norm.largest(self.step.length().abs(), before, after, |range| {
            let fifth = sum_of_squares(&fifth.as_ref()[range.clone()]);
            let third = sum_of_squares(&third.as_ref()[range]);
            if fifth == 0.0 { 0.0 } else { fifth / Scalar::sqrt(fifth + 0.01 * third) }
        });
        self.step.length().abs() * relative / self.tolerance
    }
}

impl<S: StateVector<f64>, F> fmt::Debug for RungeKutta8<S, F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("RungeKutta8")
            .field("t", &self.step.end_time())
            .field("y", self.step.end())
            .field("t_end", &self.t_end)
            .field("tolerance", &self.tolerance)
            .field("statistics", &self.statistics)
            .finish_non_exhaustive()
    }
}

fn is_finite<S: StateVector<f64>>(y: &S) -> bool {
    y.as_ref().iter().all(|v| v.is_finite())
}
