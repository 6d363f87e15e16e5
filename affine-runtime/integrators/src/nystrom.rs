//! Runge-Kutta-Nystrom methods of orders 12 and 8 for equations of second order, with step size control.

mod dormand_el_mikkawy_prince_1210;
mod dormand_el_mikkawy_prince_86;
mod step;
mod sums;
mod tableau;
#[cfg(test)]
mod trees;

pub use affine_core::system::SecondOrder;
pub use tableau::Tableau;

use core::fmt;

use affine_core::__private::numerics::{Vectors, norm};
use affine_core::system::Sum;

use super::error_norm::ErrorNorm;
use super::finite::is_finite;
use super::step_size::{Controller, first_step, next_time, shortest};
use super::tape::Tape;
use super::widest::{Work, roomiest};
use super::{Failure, Statistics, sound};
use affine_core::model::{Group, StateVector};
use step::{Step, halves, joined};

/// Adaptive integration of `q' = V(p)`, `p' = F(t, q)` from `t0` to `t_end`, in either direction of time, by a method
/// of Dormand, El-Mikkawy and Prince (IMA J. Numer. Anal. 7 (1987) 423-430):
///
/// ```text
/// q_i = q + h V(c_i p + h sum_j a_ij F_j),   F_i = F(t + c_i h, q_i)
/// q_1 = q + h V(p + h sum_i b_i F_i),        p_1 = p + h sum_i b'_i F_i
/// ```
///
/// A step is accepted when the difference to the embedded solution, relative to the tolerance in the [`ErrorNorm`], is
/// at most 1. States are summed with compensation.
///
/// | | embedded | evaluations of `F` per accepted step | per rejected one |
/// |---|---|---|---|
/// | [`Tableau::ORDER_12`] | order 10 | 17 | 16 |
/// | [`Tableau::ORDER_8`] | order 6 | 8 | 8 |
///
/// and 2 at the start, the first of which is that of the first step.
#[derive(Clone)]
pub struct RungeKuttaNystrom<S, C, R: SecondOrder<S, C>> {
    system: R,
    constants: C,
    error_norm: ErrorNorm,
    tolerance: f64,
    controller: Controller,
    step: Step<R::Half>,
    t: f64,
    /// Positions and momenta reached.
    reached: [Sum<R::Half>; 2],
    /// The state that holds them. The rest of it, which no step reads, is that of the start.
    state: S,
    /// The force there, where it is known.
    force: Option<R::Half>,
    length: f64,
    t_end: f64,
    failure: Option<Failure>,
    statistics: Statistics,
}

impl<S: StateVector<f64>, C, R: SecondOrder<S, C>> RungeKuttaNystrom<S, C, R> {
    /// The integration at its start: `groups` lay out the state vector for the [`ErrorNorm`].
    ///
    /// # Errors
    /// [`Failure::NotFinite`] where `y0` or the force there is not finite; [`Failure::Time`] for an interval and
    /// [`Failure::Tolerance`] for a tolerance that make no sense.
    pub fn new(
        (system, constants): (R, C),
        tableau: &'static Tableau,
        groups: &'static [Group],
        (t0, y0): (f64, S),
        t_end: f64,
        tolerance: f64,
    ) -> Result<Self, Failure> {
        sound(t0, t_end, tolerance)?;
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
            let accuracy = (tolerance, tableau.error_order);
            length = first_step(&slope, &error_norm, (t0, &y0, &first), t_end - t0, accuracy);
            statistics.evaluations += 1;
        }
        let [_, force] = halves(&first);
        let reached = halves(&y0).map(Sum::of);
        // What steps do not change has no error.
        error_norm = error_norm.of_the_first(2 * R::Half::LEN);
        Ok(Self {
            system,
            constants,
            error_norm,
            tolerance,
            controller: Controller::of(tableau.error_order, tableau.margin),
            step: Step::at(tableau, t0, reached),
            t: t0,
            reached,
            state: y0,
            force: Some(force),
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
    // Not optimised a second time as a part of its only caller.
    #[inline(never)]
    pub fn advance(&mut self) -> Result<(), Failure> {
        if let Some(failure) = self.failure {
            return Err(failure);
        }
        if self.is_finished() {
            return Ok(());
        }
        roomiest(Advance(self))
    }

    /// One accepted step, all of it on the vectors of a processor: what is done between two steps is as long as an
    /// evaluation or two.
    #[inline(always)]
    fn accepted(&mut self, vectors: impl Vectors) -> Result<(), Failure> {
        let force = self.force_reached();
        self.step.begin((&self.system, &self.constants), (self.t, &self.reached), force);
        let tableau = self.step.tableau();
        loop {
            let end = next_time(self.t, self.length, self.t_end);
            if end == self.t {
                self.failure = Some(Failure::StepUnderflow);
                return Err(Failure::StepUnderflow);
            }
            self.statistics.evaluations += tableau.evaluations();
            let length = (end - self.t).abs();
            let (state, error) = self.attempt(vectors, end);
            if error <= 1.0 {
                self.length = length * self.controller.accept(error);
                (self.t, self.state) = (end, state);
                (self.reached, self.force) = (*self.step.end(), self.step.end_force());
                self.statistics.steps += 1;
                return Ok(());
            }
            self.statistics.rejected += 1;
            self.length = length * self.controller.reject(error);
            if self.length <= shortest(self.t, self.t_end) {
                let failure = if error.is_finite() { Failure::StepUnderflow } else { Failure::NotFinite };
                self.failure = Some(failure);
                return Err(failure);
            }
        }
    }

    /// The state at a time within the last step, by a shorter step of the same method from its beginning, at the cost of a
    /// rejected one. The state reached where no step has been taken.
    ///
    /// # Errors
    /// [`Failure::NotFinite`], but the integration can go on.
    pub fn at(&mut self, t: f64) -> Result<S, Failure> {
        if t == self.t {
            return Ok(self.system.renewed(self.y()));
        }
        self.statistics.evaluations += self.step.tableau().evaluations();
        self.step.attempt((&self.system, &self.constants), t);
        let between = self.system.renewed(&self.with_end_of_step());
        if is_finite(&between) { Ok(between) } else { Err(Failure::NotFinite) }
    }

    /// Goes on to another end of the interval.
    #[doc(hidden)]
    pub fn aim(&mut self, t_end: f64) {
        self.t_end = t_end;
    }

    /// Everything that the next steps depend on, of an integration between two steps.
    #[doc(hidden)]
    pub fn exchange(&mut self, tape: &mut impl Tape) {
        tape.number(&mut self.t);
        self.reached.iter_mut().for_each(|half| tape.sum(half));
        tape.state(&mut self.state);
        let (mut is_known, mut force) = (self.force.is_some(), self.force.unwrap_or_else(R::Half::zeros));
        tape.flag(&mut is_known);
        tape.state(&mut force);
        self.force = is_known.then_some(force);
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
        &self.state
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

    /// The force at the state reached, where the last step begins.
    #[inline(always)]
    fn force_reached(&mut self) -> R::Half {
        self.force.unwrap_or_else(|| {
            self.statistics.evaluations += 1;
            self.system.force(self.t, &self.constants, &self.reached[0].value)
        })
    }

    /// Takes a step from where it begins to the time `end`: the state there, and its error relative to the tolerance; NaN
    /// where something is not finite.
    #[inline(always)]
    fn attempt(&mut self, vectors: impl Vectors, end: f64) -> (S, f64) {
        let h = (end - self.t).abs();
        self.step.attempt_in(vectors, (&self.system, &self.constants), end);
        let after = self.with_end_of_step();
        let [positions, momenta] = self.step.error_slopes();
        let largest = self.error_norm.largest(h, self.state.as_ref(), after.as_ref(), |range| {
            match range.start.checked_sub(R::Half::LEN) {
                Some(start) => norm(&momenta.as_ref()[start..start + range.len()]),
                None => norm(&positions.as_ref()[range]),
            }
        });
        (after, h / self.tolerance * largest)
    }

    /// The state with positions and momenta at the end of the step.
    #[inline(always)]
    fn with_end_of_step(&self) -> S {
        let mut state = self.state;
        let components = state.as_mut().chunks_exact_mut(R::Half::LEN);
        for (components, half) in components.zip(self.step.end()) {
            components.copy_from_slice(half.value.as_ref());
        }
        state
    }
}

/// An accepted step of an integration.
struct Advance<'a, S, C, R: SecondOrder<S, C>>(&'a mut RungeKuttaNystrom<S, C, R>);

impl<S: StateVector<f64>, C, R: SecondOrder<S, C>> Work for Advance<'_, S, C, R> {
    type Output = Result<(), Failure>;
    #[inline(always)]
    fn run(self, vectors: impl Vectors) -> Result<(), Failure> {
        self.0.accepted(vectors.rounding_as_numbers())
    }
}

impl<S: StateVector<f64>, C, R: SecondOrder<S, C>> fmt::Debug for RungeKuttaNystrom<S, C, R> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("RungeKuttaNystrom")
            .field("order", &self.step.tableau().order())
            .field("t", &self.t)
            .field("y", &self.state)
            .field("t_end", &self.t_end)
            .field("tolerance", &self.tolerance)
            .field("statistics", &self.statistics)
            .finish_non_exhaustive()
    }
}
