//! Runge-Kutta-Nystrom method of order 12 for equations of second order, with step size control.

mod dormand_el_mikkawy_prince;
mod step;
mod sums;

use core::fmt;

use super::error_norm::{ErrorNorm, norm};
use super::lie::Sum;
use super::step_size::{Controller, first_step, next_time, shortest};
#[cfg(feature = "std")]
use super::tape::Tape;
use super::{Failure, Statistics};
use crate::model::{Group, StateVector};
use step::{Step, halves, joined};

/// Order of the leading term of the error estimate in the step size: that of the local error of the embedded solution.
const ERROR_ORDER: f64 = 11.0;
/// Steps aim at an error so many times below the tolerance beside the margin that any method keeps. A rejected step costs
/// as much as an accepted one, and the margin shortens steps by a tenth only: with it, one step in twelve is
/// rejected where it was one in five, and the same errors cost 3 percent less (eleven motions in two and three dimensions,
/// errors from 1e-3 to 1e-12).
const MARGIN: f64 = 5.0;

/// A motion with `q' = V(p)`, linear in the momenta, and `p' = F(t, q)`, whose equations depend on constants `C`.
///
/// A state holds the positions, then as many momenta, then what is a function of the positions.
pub trait SecondOrder<S, C> {
    /// The positions, or the momenta.
    type Half: StateVector<f64>;

    /// `V(p)`, linear.
    fn drift(&self, constants: &C, momenta: &Self::Half) -> Self::Half;

    /// `F(t, q)`.
    fn force(&self, t: f64, constants: &C, positions: &Self::Half) -> Self::Half;

    /// The state with what is a function of the positions computed anew.
    fn renewed(&self, state: &S) -> S;
}

/// Adaptive integration of `q' = V(p)`, `p' = F(t, q)` from `t0` to `t_end`, in either direction of time, by the method
/// of Dormand, El-Mikkawy and Prince of order 12 with 17 stages (IMA J. Numer. Anal. 7 (1987) 423-430):
///
/// ```text
/// q_i = q + h V(c_i p + h sum_j a_ij F_j),   F_i = F(t + c_i h, q_i)
/// q_1 = q + h V(p + h sum_i b_i F_i),        p_1 = p + h sum_i b'_i F_i
/// ```
///
/// A step is accepted when the difference to the embedded solution of order 10, which is of order `h^11`, relative to the
/// tolerance in the [`ErrorNorm`] is at most 1. States are summed with compensation.
///
/// Cost: 17 evaluations of `F` per accepted step, 16 per rejected one; at the start 2.
#[derive(Clone)]
pub struct RungeKuttaNystrom12<S, C, R: SecondOrder<S, C>> {
    system: R,
    constants: C,
    error_norm: ErrorNorm,
    tolerance: f64,
    controller: Controller,
    step: Step<S, R::Half>,
    t: f64,
    /// Positions and momenta reached. The rest, which no step reads, is that of the start.
    state: Sum<S>,
    length: f64,
    t_end: f64,
    failure: Option<Failure>,
    statistics: Statistics,
}

impl<S: StateVector<f64>, C, R: SecondOrder<S, C>> RungeKuttaNystrom12<S, C, R> {
    /// The integration at its start: `groups` lay out the state vector for the [`ErrorNorm`].
    ///
    /// # Errors
    /// [`Failure::NotFinite`] where `y0` or the force there is not finite.
    pub fn new(
        (system, constants): (R, C),
        groups: &'static [Group],
        (t0, y0): (f64, S),
        t_end: f64,
        tolerance: f64,
    ) -> Result<Self, Failure> {
        let slope = |t: f64, y: &S| {
            let [positions, momenta] = halves(y);
            let velocity = system.drift(&constants, &momenta);
            joined::<S, R::Half>(&velocity, &system.force(t, &constants, &positions))
        };
        let first = slope(t0, &y0);
        if !is_finite(&y0) || !is_finite(&first) {
            return Err(Failure::NotFinite);
        }
        let mut statistics = Statistics { evaluations: 1, ..Statistics::default() };
        let (mut error_norm, mut length) = (ErrorNorm::new(groups), 0.0);
        if t_end != t0 {
            // Inertias are those of the velocities alone.
            let drift = |_: f64, y: &S| joined(&system.drift(&constants, &halves(y)[1]), &R::Half::zeros());
            error_norm = ErrorNorm::probed(groups, &drift, (t0, &y0, &first)).0;
            let accuracy = (tolerance, ERROR_ORDER);
            length = first_step(&slope, &error_norm, (t0, &y0, &first), t_end - t0, accuracy);
            statistics.evaluations += 1;
        }
        Ok(Self {
            system,
            constants,
            error_norm,
            tolerance,
            controller: Controller::of(ERROR_ORDER),
            step: Step::at(t0, y0),
            t: t0,
            state: Sum::of(y0),
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
        self.statistics.evaluations += 1;
        self.step.begin((&self.system, &self.constants), self.t, &self.state);
        loop {
            let end = next_time(self.t, self.length, self.t_end);
            self.statistics.evaluations += 16;
            let h = end - self.t;
            let error = self.attempt(h);
            if error <= 1.0 {
                self.length = h.abs() * self.controller.accept(MARGIN * error);
                (self.t, self.state) = (end, *self.step.end());
                self.statistics.steps += 1;
                return Ok(());
            }
            self.statistics.rejected += 1;
            self.length = h.abs() * self.controller.reject(MARGIN * error);
            if self.length <= shortest(self.t, self.t_end) {
                let failure = if error.is_finite() { Failure::StepUnderflow } else { Failure::NotFinite };
                self.failure = Some(failure);
                return Err(failure);
            }
        }
    }

    /// The state at a time within the last step, by a shorter step of the same method from its beginning: 16 evaluations.
    /// The state reached where no step has been taken.
    ///
    /// # Errors
    /// [`Failure::NotFinite`], but the integration can go on.
    pub fn at(&mut self, t: f64) -> Result<S, Failure> {
        if t == self.t {
            return Ok(self.system.renewed(self.y()));
        }
        self.statistics.evaluations += 16;
        let h = t - self.step.time();
        self.step.attempt((&self.system, &self.constants), h);
        let between = self.system.renewed(&self.step.end().value);
        if is_finite(&between) { Ok(between) } else { Err(Failure::NotFinite) }
    }

    /// Everything that the next steps depend on, of an integration between two steps.
    #[cfg(feature = "std")]
    pub(crate) fn exchange(&mut self, tape: &mut impl Tape) {
        tape.number(&mut self.t);
        tape.sum(&mut self.state);
        tape.number(&mut self.length);
        self.controller.exchange(tape);
        tape.statistics(&mut self.statistics);
    }

    /// Time reached.
    #[must_use]
    pub fn t(&self) -> f64 {
        self.t
    }

    /// State reached: its positions and momenta. What is a function of the positions, which no step reads, is that of the
    /// start; [`SecondOrder::renewed`] computes it.
    #[must_use]
    pub fn y(&self) -> &S {
        &self.state.value
    }

    /// `t_end` is reached.
    #[must_use]
    pub fn is_finished(&self) -> bool {
        self.t == self.t_end
    }

    /// Cost so far, with that of [`at`](Self::at).
    #[must_use]
    pub fn statistics(&self) -> Statistics {
        self.statistics
    }

    /// Takes a step of length `h` from where it begins: its error relative to the tolerance; NaN where something is
    /// not finite.
    fn attempt(&mut self, h: f64) -> f64 {
        self.step.attempt((&self.system, &self.constants), h);
        let (before, after) = (self.step.start().value.as_ref(), self.step.end().value.as_ref());
        let slope = self.step.error_slope().as_ref();
        let relative = self.error_norm.largest(h.abs(), before, after, |range| norm(&slope[range]));
        h.abs() * relative / self.tolerance
    }
}

impl<S: StateVector<f64>, C, R: SecondOrder<S, C>> fmt::Debug for RungeKuttaNystrom12<S, C, R> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("RungeKuttaNystrom12")
            .field("t", &self.t)
            .field("y", &self.state.value)
            .field("t_end", &self.t_end)
            .field("tolerance", &self.tolerance)
            .field("statistics", &self.statistics)
            .finish_non_exhaustive()
    }
}

fn is_finite<S: StateVector<f64>>(y: &S) -> bool {
    y.as_ref().iter().all(|v| v.is_finite())
}
