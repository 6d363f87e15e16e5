//! What a simulation asks of an integrator.

use crate::integrate::lie::Coordinates;
use crate::integrate::nystrom::SecondOrder;
use crate::integrate::runge_kutta::{Dense, Pair, RungeKutta};
use crate::integrate::splitting::{Pieces, Splitting};
use crate::integrate::tape::Tape;
use crate::integrate::taylor::{Series, Taylor};
use crate::integrate::{Failure, Gauss, Rattle, RungeKuttaNystrom12, Statistics};
use crate::model::StateVector;

/// An integration that goes step by step.
pub(super) trait Stepper<S> {
    /// Takes one step.
    fn advance(&mut self) -> Result<(), Failure>;
    /// The state at a time within the last step.
    fn between(&mut self, t: f64) -> Result<S, Failure>;
    /// Time reached.
    fn t(&self) -> f64;
    /// State reached.
    fn y(&self) -> &S;
    /// The end is reached.
    fn is_finished(&self) -> bool;
    /// Cost so far.
    fn statistics(&self) -> Statistics;
    /// Hands over, or takes back, everything that the next steps depend on.
    fn exchange(&mut self, tape: &mut impl Tape);
    /// That is all that they depend on.
    fn is_exchanged(&self) -> bool {
        true
    }
}

/// The explicit method with the dense output of its last step, which is formed once for all times in it.
pub(super) struct Explicit<P, S, F, C> {
    integration: RungeKutta<P, S, F, C>,
    dense: Option<Dense<S, C>>,
}

impl<P, S, F, C> Explicit<P, S, F, C> {
    pub(super) fn new(integration: RungeKutta<P, S, F, C>) -> Self {
        Self { integration, dense: None }
    }
}

impl<P: Pair, S: StateVector<f64>, F: Fn(f64, &S) -> S, C: Coordinates<S>> Stepper<S>
    for Explicit<P, S, F, C>
{
    fn advance(&mut self) -> Result<(), Failure> {
        self.dense = None;
        self.integration.advance()
    }
    fn between(&mut self, t: f64) -> Result<S, Failure> {
        Ok(self.dense.get_or_insert_with(|| self.integration.dense()).at(t))
    }
    fn t(&self) -> f64 {
        self.integration.t()
    }
    fn y(&self) -> &S {
        self.integration.y()
    }
    fn is_finished(&self) -> bool {
        self.integration.is_finished()
    }
    fn statistics(&self) -> Statistics {
        self.integration.statistics()
    }
    fn exchange(&mut self, tape: &mut impl Tape) {
        self.dense = None;
        self.integration.exchange(tape);
    }
}

impl<S: StateVector<f64>, F: Fn(f64, &S) -> S, C: Coordinates<S>> Stepper<S> for Gauss<S, F, C> {
    fn advance(&mut self) -> Result<(), Failure> {
        Gauss::advance(self)
    }
    fn between(&mut self, t: f64) -> Result<S, Failure> {
        self.at(t)
    }
    fn t(&self) -> f64 {
        Gauss::t(self)
    }
    fn y(&self) -> &S {
        Gauss::y(self)
    }
    fn is_finished(&self) -> bool {
        Gauss::is_finished(self)
    }
    fn statistics(&self) -> Statistics {
        Gauss::statistics(self)
    }
    fn exchange(&mut self, tape: &mut impl Tape) {
        Gauss::exchange(self, tape);
    }
    fn is_exchanged(&self) -> bool {
        !self.is_stiff()
    }
}

impl<S: StateVector<f64>, C, R: Series<S, C>> Stepper<S> for Taylor<S, C, R> {
    fn advance(&mut self) -> Result<(), Failure> {
        Taylor::advance(self)
    }
    fn between(&mut self, t: f64) -> Result<S, Failure> {
        Ok(self.at(t))
    }
    fn t(&self) -> f64 {
        Taylor::t(self)
    }
    fn y(&self) -> &S {
        Taylor::y(self)
    }
    fn is_finished(&self) -> bool {
        Taylor::is_finished(self)
    }
    fn statistics(&self) -> Statistics {
        Taylor::statistics(self)
    }
    fn exchange(&mut self, tape: &mut impl Tape) {
        Taylor::exchange(self, tape);
    }
}

impl<S: StateVector<f64>, C, R: SecondOrder<S, C>> Stepper<S> for RungeKuttaNystrom12<S, C, R> {
    fn advance(&mut self) -> Result<(), Failure> {
        RungeKuttaNystrom12::advance(self)
    }
    fn between(&mut self, t: f64) -> Result<S, Failure> {
        self.at(t)
    }
    fn t(&self) -> f64 {
        RungeKuttaNystrom12::t(self)
    }
    fn y(&self) -> &S {
        RungeKuttaNystrom12::y(self)
    }
    fn is_finished(&self) -> bool {
        RungeKuttaNystrom12::is_finished(self)
    }
    fn statistics(&self) -> Statistics {
        RungeKuttaNystrom12::statistics(self)
    }
    fn exchange(&mut self, tape: &mut impl Tape) {
        RungeKuttaNystrom12::exchange(self, tape);
    }
}

impl<const N: usize, S: StateVector<f64>, F: Fn(f64, &S) -> S> Stepper<S> for Rattle<N, S, F> {
    fn advance(&mut self) -> Result<(), Failure> {
        Rattle::advance(self)
    }
    fn between(&mut self, t: f64) -> Result<S, Failure> {
        self.at(t)
    }
    fn t(&self) -> f64 {
        Rattle::t(self)
    }
    fn y(&self) -> &S {
        Rattle::y(self)
    }
    fn is_finished(&self) -> bool {
        Rattle::is_finished(self)
    }
    fn statistics(&self) -> Statistics {
        Rattle::statistics(self)
    }
    fn exchange(&mut self, tape: &mut impl Tape) {
        Rattle::exchange(self, tape);
    }
}

impl<S: StateVector<f64>, C, P: Pieces<S, C>> Stepper<S> for Splitting<S, C, P> {
    fn advance(&mut self) -> Result<(), Failure> {
        Splitting::advance(self)
    }
    fn between(&mut self, t: f64) -> Result<S, Failure> {
        self.at(t)
    }
    fn t(&self) -> f64 {
        Splitting::t(self)
    }
    fn y(&self) -> &S {
        Splitting::y(self)
    }
    fn is_finished(&self) -> bool {
        Splitting::is_finished(self)
    }
    fn statistics(&self) -> Statistics {
        Splitting::statistics(self)
    }
    fn exchange(&mut self, tape: &mut impl Tape) {
        Splitting::exchange(self, tape);
    }
}
