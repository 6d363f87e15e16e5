//! What a simulation asks of an integrator.

use super::checkpoint::Bits;
use crate::inner::{AdaptiveMethod, EqualStepMethod};
use crate::integrate::{Adaptive, Equal, Failure, Statistics};

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
    /// Goes on to another end.
    fn aim(&mut self, t_end: f64) -> Result<(), Failure>;
    /// Cost so far.
    fn statistics(&self) -> Statistics;
    /// Largest residual of implicit steps so far.
    fn residual(&self) -> Option<f64> {
        None
    }
    /// Hands over, or takes back, everything that the next steps depend on.
    fn exchange(&mut self, tape: &mut Bits<'_>);
    /// That is all that they depend on.
    fn is_exchanged(&self) -> bool {
        true
    }
}

impl<M: AdaptiveMethod> Stepper<M::State> for Adaptive<M> {
    fn advance(&mut self) -> Result<(), Failure> {
        Adaptive::advance(self)
    }
    fn between(&mut self, t: f64) -> Result<M::State, Failure> {
        self.at(t)
    }
    fn t(&self) -> f64 {
        Adaptive::t(self)
    }
    fn y(&self) -> &M::State {
        Adaptive::y(self)
    }
    fn is_finished(&self) -> bool {
        Adaptive::is_finished(self)
    }
    fn aim(&mut self, t_end: f64) -> Result<(), Failure> {
        Adaptive::aim(self, t_end);
        Ok(())
    }
    fn statistics(&self) -> Statistics {
        Adaptive::statistics(self)
    }
    fn exchange(&mut self, tape: &mut Bits<'_>) {
        Adaptive::exchange(self, tape);
    }
}

impl<M: EqualStepMethod> Stepper<M::State> for Equal<M> {
    fn advance(&mut self) -> Result<(), Failure> {
        Equal::advance(self)
    }
    fn between(&mut self, t: f64) -> Result<M::State, Failure> {
        self.at(t)
    }
    fn t(&self) -> f64 {
        Equal::t(self)
    }
    fn y(&self) -> &M::State {
        Equal::y(self)
    }
    fn is_finished(&self) -> bool {
        Equal::is_finished(self)
    }
    fn aim(&mut self, t_end: f64) -> Result<(), Failure> {
        Equal::aim(self, t_end)
    }
    fn statistics(&self) -> Statistics {
        Equal::statistics(self)
    }
    fn residual(&self) -> Option<f64> {
        Equal::residual(self)
    }
    fn exchange(&mut self, tape: &mut Bits<'_>) {
        Equal::exchange(self, tape);
    }
    fn is_exchanged(&self) -> bool {
        Equal::is_exchanged(self)
    }
}
