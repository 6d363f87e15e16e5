//! Gauss collocation: implicit, symplectic, symmetric, with a fixed step.

mod coefficients;
mod equations;

pub use coefficients::Tableau;
#[cfg(test)]
pub(crate) use coefficients::legendre_roots as exact;

use super::Failure;
use super::drive::{Equal, EqualStepMethod};
use super::equal_steps::{EqualSteps, Times};
use super::finite::is_finite;
use super::lie::{Coordinates, Flat, Sum};
use super::tape::Tape;
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
pub type Gauss<S, F, C = Flat> = Equal<GaussSteps<S, F, C>>;

/// Steps of Gauss collocation.
#[derive(Clone)]
pub struct GaussSteps<S, F, C> {
    f: F,
    coordinates: C,
    equations: Equations<S>,
    /// Of the last step; before the first, those that the slope at the start gives.
    increments: Increments<S>,
    residual: f64,
}

impl<S: StateVector<f64>, F: Fn(f64, &S) -> S> Equal<GaussSteps<S, F, Flat>> {
    /// The integration at its start. One evaluation.
    ///
    /// # Errors
    /// [`Failure::NotFinite`] where `y0` or `f(t0, y0)` is not finite; [`Failure::Step`] where `step` is not
    /// positive, not finite, or gives more steps than there are floating-point times.
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

impl<S: StateVector<f64>, F: Fn(f64, &S) -> S, C: Coordinates<S>> Equal<GaussSteps<S, F, C>> {
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
        let method = GaussSteps { f, coordinates, equations, increments, residual: 0.0 };
        Ok(Self { method, steps: EqualSteps::at(times, start) })
    }

    /// Fixed-point iteration did not contract, and steps take Newton's iteration.
    #[must_use]
    pub fn is_stiff(&self) -> bool {
        self.method.equations.is_stiff()
    }
}

impl<S: StateVector<f64>, F: Fn(f64, &S) -> S, C: Coordinates<S>> EqualStepMethod for GaussSteps<S, F, C> {
    type State = S;
    type Point = Sum<S>;
    const NAME: &'static str = "Gauss";

    fn state(point: &Sum<S>) -> &S {
        &point.value
    }

    fn step(&mut self, (t, point): (f64, &mut Sum<S>), h: f64, last: Option<f64>) -> Result<(), Failure> {
        let guess = last.map_or(self.increments, |last| self.continued(1.0, h / last));
        let (end, increments, residual) = self.solved((t, *point), h, guess)?;
        self.residual = if residual > self.residual { residual } else { self.residual };
        (*point, self.increments) = (end, increments);
        Ok(())
    }

    /// Of the same order as the steps, which the collocation polynomial is not.
    fn within(&mut self, (t, point): (f64, &mut Sum<S>), h: f64, last: f64) -> Result<(), Failure> {
        let guess = self.continued(0.0, h / last);
        // The Jacobian that the steps work with, and whether they need one, stay as they are.
        let steps = self.equations.clone();
        let between = self.solved((t, *point), h, guess);
        let evaluations = self.equations.evaluations;
        self.equations = steps;
        self.equations.evaluations = evaluations;
        *point = between?.0;
        Ok(())
    }

    fn evaluations(&self) -> u64 {
        self.equations.evaluations
    }

    fn exchange(&mut self, tape: &mut impl Tape) {
        self.increments.iter_mut().for_each(|increment| tape.state(increment));
        tape.number(&mut self.residual);
        tape.bits(&mut self.equations.evaluations);
    }

    fn exchange_point(tape: &mut impl Tape, point: &mut Sum<S>) {
        tape.sum(point);
    }

    /// As long as steps do not take Newton's iteration, which keeps a Jacobian with its factors.
    fn is_exchanged(&self) -> bool {
        !self.equations.is_stiff()
    }

    /// The defect that the iteration left in the stage equations of a step, relative to the largest component of state and
    /// increments: a few roundings, times the stiffness where there is one.
    fn residual(&self) -> Option<f64> {
        Some(self.residual)
    }
}

impl<S: StateVector<f64>, F: Fn(f64, &S) -> S, C: Coordinates<S>> GaussSteps<S, F, C> {
    /// The end of a step, its increments, and the defect that they leave.
    fn solved(
        &mut self,
        (t, begin): (f64, Sum<S>),
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
