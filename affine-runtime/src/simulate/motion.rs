//! A motion of phase points, step by step, whatever is integrated and how.

use super::checkpoint::Bits;
use super::layout::Layout;
use super::stepper::Stepper;
use crate::integrate::{Failure, Statistics};
use crate::model::StateVector;

/// A phase point with the work done since the integration started.
pub(super) type WithWork<P> = (P, f64);

/// The phase point of a state at a time.
pub(super) type Expansion<'e, S, P> = &'e dyn Fn(f64, &S) -> P;

/// What a run follows. It calls this a few times for each step, which takes many evaluations of the equations: behind
/// `dyn` that costs nothing that can be measured, and a run is not compiled anew for each integrator.
pub(super) trait Motion<P> {
    /// Takes one step.
    fn advance(&mut self) -> Result<(), Failure>;
    /// At a time within the last step.
    fn between(&mut self, t: f64) -> Result<WithWork<P>, Failure>;
    /// At the time reached.
    fn reached(&self) -> WithWork<P>;
    /// Notes that the state reached is good, without expanding it.
    fn keep(&mut self);
    /// The time of the last good state.
    fn kept_at(&self) -> Option<f64>;
    /// The last good state.
    fn kept(&self) -> Option<(f64, WithWork<P>)>;
    /// Time reached.
    fn t(&self) -> f64;
    /// The placement in the state reached, up to a factor of positive determinant; `None` where the state does not hold
    /// it.
    fn placement(&self) -> Option<&[f64]>;
    /// The end is reached.
    fn is_finished(&self) -> bool;
    /// Cost so far.
    fn statistics(&self) -> Statistics;
    /// Largest residual of implicit steps so far.
    fn residual(&self) -> Option<f64>;
    /// Hands over, or takes back, everything that the next steps depend on.
    fn exchange(&mut self, tape: &mut Bits<'_>);
    /// That is all that they depend on.
    fn is_exchanged(&self) -> bool;
}

/// An integration of states whose phase points are those of an expansion.
pub(super) struct Expanded<'e, I, S, P> {
    integration: &'e mut I,
    expand: Expansion<'e, S, P>,
    layout: Layout,
    kept: Option<(f64, S)>,
}

impl<'e, I: Stepper<S>, S: StateVector<f64>, P> Expanded<'e, I, S, P> {
    pub(super) fn new(integration: &'e mut I, expand: Expansion<'e, S, P>, layout: Layout) -> Self {
        Self { integration, expand, layout, kept: None }
    }

    fn expanded(&self, t: f64, state: &S) -> WithWork<P> {
        ((self.expand)(t, state), self.layout.work.map_or(0.0, |work| state.as_ref()[work]))
    }
}

impl<I: Stepper<S>, S: StateVector<f64>, P> Motion<P> for Expanded<'_, I, S, P> {
    fn advance(&mut self) -> Result<(), Failure> {
        self.integration.advance()
    }
    fn between(&mut self, t: f64) -> Result<WithWork<P>, Failure> {
        let state = self.integration.between(t)?;
        Ok(self.expanded(t, &state))
    }
    fn reached(&self) -> WithWork<P> {
        self.expanded(self.integration.t(), self.integration.y())
    }
    fn keep(&mut self) {
        self.kept = Some((self.integration.t(), *self.integration.y()));
    }
    fn kept_at(&self) -> Option<f64> {
        self.kept.as_ref().map(|(t, _)| *t)
    }
    fn kept(&self) -> Option<(f64, WithWork<P>)> {
        self.kept.as_ref().map(|(t, state)| (*t, self.expanded(*t, state)))
    }
    fn t(&self) -> f64 {
        self.integration.t()
    }
    fn placement(&self) -> Option<&[f64]> {
        self.layout.placement.clone().map(|range| &self.integration.y().as_ref()[range])
    }
    fn is_finished(&self) -> bool {
        self.integration.is_finished()
    }
    fn statistics(&self) -> Statistics {
        self.integration.statistics()
    }
    fn residual(&self) -> Option<f64> {
        self.integration.residual()
    }
    fn exchange(&mut self, tape: &mut Bits<'_>) {
        self.integration.exchange(tape);
    }
    fn is_exchanged(&self) -> bool {
        self.integration.is_exchanged()
    }
}
