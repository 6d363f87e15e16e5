//! Gauss collocation: implicit, symplectic, symmetric, with a fixed step.

mod coefficients;
mod equations;

pub use coefficients::Tableau;
#[cfg(test)]
pub(crate) use coefficients::legendre_roots as exact;

use core::fmt;

use super::equal_steps::{EqualSteps, Times};
use super::finite::is_finite;
use super::lie::{Coordinates, Flat, Sum};
use super::tape::Tape;
use super::{Failure, Statistics};
use affine_core::model::StateVector;
use coefficients::MOST_STAGES;
use equations::{Equations, Field, Increments, Start};

/// Integration of `y' = f(t, y)` from `t0` to `t_end`, in either direction of time, by Gauss collocation of 2, 3, 4 or 6
/// stages (order 4, 6, 8 or 12) in `n = ceil(|t_end - t0|/step)` equal steps.
///
/// The flow of a step is symmetric, symplectic where the components of `y` are canonical variables, and keeps every
/// linear and quadratic first integral of `f` (Hairer, Lubich, Wanner, Geometric Numerical Integration, Theorems
/// IV.2.1, VI.4.2 and section V.2). It is no Poisson map of a Lie-Poisson bracket, and keeps no other invariants but
/// to its order.
///
/// The stage equations are iterated to rounding from the continuation of the collocation polynomial of the step
/// before: by fixed-point iteration, one evaluation for each stage and iteration; from the first step on where that
/// does not contract, by Newton's iteration with a Jacobian by differences (`1 + dim y` evaluations) that is kept as
/// long as corrections shrink by ten. That takes states of at most 32 components; larger ones that are stiff are
/// refused. Solutions are summed with compensation. Nothing allocates; the factors take 48 KiB.
///
/// A solution of the stage equations need not be unique where the step is far too long: the one found is the one
/// the iteration leads to.
#[derive(Clone)]
pub struct Gauss<S, F, C = Flat> {
    f: F,
    coordinates: C,
    equations: Equations<S>,
    steps: EqualSteps<Sum<S>>,
    /// Of the last step; before the first, those that the slope at the start gives.
    increments: Increments<S>,
    residual: f64,
}

impl<S: StateVector<f64>, F: Fn(f64, &S) -> S> Gauss<S, F> {
    /// The integration at its start. One evaluation.
    ///
    /// # Errors
    /// [`Failure::NotFinite`] where `y0` or `f(t0, y0)` is not finite; [`Failure::StepUnderflow`] where `step` is
    /// not positive, or gives more steps than there are floating-point times.
    pub fn new(
        f: F,
        tableau: &'static Tableau,
        start: (f64, S),
        t_end: f64,
        step: f64,
    ) -> Result<Self, Failure> {
        Self::within(Flat, f, tableau, start, t_end, step)
    }
}

impl<S: StateVector<f64>, F: Fn(f64, &S) -> S, C: Coordinates<S>> Gauss<S, F, C> {
    /// The integration at its start, in other coordinates: on a group, in the chart around the middle of each step,
    /// which keeps the method symmetric. What it says of linear and quadratic invariants then holds for those of the
    /// components beside the placement. One evaluation.
    ///
    /// # Errors
    /// As [`new`](Gauss::new).
    pub fn within(
        coordinates: C,
        f: F,
        tableau: &'static Tableau,
        (t0, y0): (f64, S),
        t_end: f64,
        step: f64,
    ) -> Result<Self, Failure> {
        let times = Times::new(t0, t_end, step)?;
        let slope = f(t0, &y0);
        if !is_finite(&y0) || !is_finite(&slope) {
            return Err(Failure::NotFinite);
        }
        let start = Sum::of(y0);
        let slope = coordinates.velocity(&y0, &coordinates.origin(&start).value, &slope);
        let mut increments = [S::zeros(); MOST_STAGES];
        for (increment, weight) in increments.iter_mut().zip(tableau.weights) {
            for (increment, slope) in increment.as_mut().iter_mut().zip(slope.as_ref()) {
                *increment = times.length() * weight * slope;
            }
        }
        let mut equations = Equations::new(tableau);
        equations.evaluations = 1;
        let steps = EqualSteps::at(times, start);
        Ok(Self { f, coordinates, equations, steps, increments, residual: 0.0 })
    }

    /// Takes one step; does nothing at `t_end`, which the last step hits exactly.
    ///
    /// # Errors
    /// [`Failure::NoSolution`] or [`Failure::NotFinite`], now and ever after; the state stays that of the last step.
    pub fn advance(&mut self) -> Result<(), Failure> {
        let Some((t, begin, h)) = self.steps.next()? else { return Ok(()) };
        let scale = h / self.steps.last_length();
        let guess = if self.steps.taken() == 0 { self.increments } else { self.continued(1.0, scale) };
        let solved = self.step(t, begin, h, guess).map(|(end, increments, residual)| {
            self.residual = if residual > self.residual { residual } else { self.residual };
            self.increments = increments;
            end
        });
        self.steps.take(solved)
    }

    /// The state at a time within the last step, by a shorter step of the same method from its beginning: of the
    /// same order as the steps, which the collocation polynomial is not, and without influence on them. Costs about
    /// as many evaluations as a step. The state reached where no step has been taken.
    ///
    /// # Errors
    /// As [`advance`](Self::advance), but the integration can go on.
    pub fn at(&mut self, t: f64) -> Result<S, Failure> {
        let Some((from, begin, h)) = self.steps.again_to(t) else { return Ok(*self.y()) };
        if h == 0.0 {
            return Ok(begin.value);
        }
        let guess = self.continued(0.0, h / self.steps.last_length());
        // The Jacobian that the steps work with, and whether they need one, stay as they are.
        let steps = self.equations.clone();
        let between = self.step(from, begin, h, guess);
        let evaluations = self.equations.evaluations;
        self.equations = steps;
        self.equations.evaluations = evaluations;
        between.map(|(end, ..)| end.value)
    }

    /// Goes on to another end of the interval.
    ///
    /// # Errors
    /// [`Failure::Time`], [`Failure::StepUnderflow`] where there are no steps to it; the end stays what it was.
    #[doc(hidden)]
    pub fn aim(&mut self, t_end: f64) -> Result<(), Failure> {
        self.steps.aim(t_end)
    }

    /// Everything that the next steps depend on, as long as these do not take Newton's iteration, which keeps a
    /// Jacobian with its factors.
    #[doc(hidden)]
    pub fn exchange(&mut self, tape: &mut impl Tape) {
        self.steps.exchange(tape, |tape, end| tape.sum(end));
        self.increments.iter_mut().for_each(|increment| tape.state(increment));
        tape.number(&mut self.residual);
        tape.bits(&mut self.equations.evaluations);
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
        Statistics {
            steps: self.steps.taken(),
            evaluations: self.equations.evaluations,
            ..Statistics::default()
        }
    }

    /// Length of the steps, negative backward in time.
    #[must_use]
    pub fn step_length(&self) -> f64 {
        self.steps.times().length()
    }

    /// Largest defect that the iteration left in the stage equations of a step, relative to the largest component of
    /// state and increments: a few roundings, times the stiffness where there is one.
    #[must_use]
    pub fn residual(&self) -> f64 {
        self.residual
    }

    /// Fixed-point iteration did not contract, and steps take Newton's iteration.
    #[must_use]
    pub fn is_stiff(&self) -> bool {
        self.equations.is_stiff()
    }

    fn step(
        &mut self,
        t: f64,
        begin: Sum<S>,
        h: f64,
        guess: Increments<S>,
    ) -> Result<(Sum<S>, Increments<S>, f64), Failure> {
        let origin = self.coordinates.origin(&begin);
        let start = Start { t, h, y: &origin.value, carry: &origin.carry };
        let field = Field { f: &self.f, coordinates: self.coordinates, base: &begin };
        match self.equations.solve(&field, start, guess) {
            Ok(solution) => {
                let end = self.coordinates.end(&begin, &self.equations.total(&solution.increments));
                if is_finite(&end.value) {
                    Ok((end, solution.increments, solution.residual))
                } else {
                    Err(Failure::NotFinite)
                }
            }
            Err(unsolved) if unsolved.residual.is_finite() => {
                Err(Failure::NoSolution { residual: unsolved.residual })
            }
            Err(_) => Err(Failure::NotFinite),
        }
    }

    /// Increments of a step `scale` times as long as the last one that begins at `offset`, in parts of the last one,
    /// after the beginning of that: by the derivative of the collocation polynomial.
    fn continued(&self, offset: f64, scale: f64) -> Increments<S> {
        let tableau = self.equations.tableau;
        let mut continued = [S::zeros(); MOST_STAGES];
        for (i, (node, weight)) in tableau.nodes.iter().zip(tableau.weights).enumerate() {
            let coefficients = tableau.continuation(offset + scale * node, *weight, scale);
            for (coefficient, increment) in coefficients.iter().zip(&self.increments).take(tableau.stages()) {
                for (value, increment) in continued[i].as_mut().iter_mut().zip(increment.as_ref()) {
                    *value += coefficient * increment;
                }
            }
        }
        continued
    }
}

impl<S: StateVector<f64>, F: Fn(f64, &S) -> S, C: Coordinates<S>> fmt::Debug for Gauss<S, F, C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Gauss")
            .field("stages", &self.equations.tableau.stages())
            .field("t", &self.t())
            .field("y", self.y())
            .field("steps", self.steps.times())
            .field("statistics", &self.statistics())
            .finish_non_exhaustive()
    }
}
