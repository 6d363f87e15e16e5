//! What a simulation asks of an integrator.

use super::checkpoint::Bits;
use crate::inner::Field;
use crate::integrate::lie::Coordinates;
use crate::integrate::nystrom::SecondOrder;
use crate::integrate::radau::{Jacobian, Radau};
use crate::integrate::runge_kutta::{Dense, Pair, RungeKutta};
use crate::integrate::splitting::{AdaptiveSplitting, Pieces, Splitting};
use crate::integrate::taylor::{Series, Taylor};
use crate::integrate::{Failure, Gauss, Rattle, RungeKuttaNystrom, Statistics};
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

/// What the integrators have by the names of [`Stepper`].
macro_rules! by_the_same_names {
    ($integration:ident) => {
        fn advance(&mut self) -> Result<(), Failure> {
            $integration::advance(self)
        }
        fn t(&self) -> f64 {
            $integration::t(self)
        }
        fn y(&self) -> &S {
            $integration::y(self)
        }
        fn is_finished(&self) -> bool {
            $integration::is_finished(self)
        }
        fn statistics(&self) -> Statistics {
            $integration::statistics(self)
        }
        fn exchange(&mut self, tape: &mut Bits<'_>) {
            $integration::exchange(self, tape);
        }
    };
}

/// The explicit method with the dense output of its last step, which is formed once for all times in it.
pub(super) struct Explicit<P, S, F, C, L> {
    integration: RungeKutta<P, S, F, C, L>,
    dense: Option<Dense<S, C>>,
}

impl<P, S, F, C, L> Explicit<P, S, F, C, L> {
    pub(super) fn new(integration: RungeKutta<P, S, F, C, L>) -> Self {
        Self { integration, dense: None }
    }
}

impl<P: Pair, S: StateVector<f64>, F: Field<S, C, L>, C: Coordinates<S>, L: StateVector<f64>> Stepper<S>
    for Explicit<P, S, F, C, L>
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
    fn aim(&mut self, t_end: f64) -> Result<(), Failure> {
        self.integration.aim(t_end);
        Ok(())
    }
    fn statistics(&self) -> Statistics {
        self.integration.statistics()
    }
    fn exchange(&mut self, tape: &mut Bits<'_>) {
        self.dense = None;
        self.integration.exchange(tape);
    }
}

impl<S: StateVector<f64>, F: Fn(f64, &S) -> S, C: Coordinates<S>> Stepper<S> for Gauss<S, F, C> {
    by_the_same_names!(Gauss);
    fn aim(&mut self, t_end: f64) -> Result<(), Failure> {
        Gauss::aim(self, t_end)
    }
    fn between(&mut self, t: f64) -> Result<S, Failure> {
        self.at(t)
    }
    fn residual(&self) -> Option<f64> {
        Some(Gauss::residual(self))
    }
    fn is_exchanged(&self) -> bool {
        !self.is_stiff()
    }
}

impl<S: StateVector<f64>, F: Fn(f64, &S) -> S, J: Jacobian<S>, C: Coordinates<S>> Stepper<S>
    for Radau<S, F, J, C>
{
    by_the_same_names!(Radau);
    fn aim(&mut self, t_end: f64) -> Result<(), Failure> {
        Radau::aim(self, t_end);
        Ok(())
    }
    fn between(&mut self, t: f64) -> Result<S, Failure> {
        Ok(self.at(t))
    }
}

impl<S: StateVector<f64>, C, R: Series<S, C>> Stepper<S> for Taylor<S, C, R> {
    by_the_same_names!(Taylor);
    fn aim(&mut self, t_end: f64) -> Result<(), Failure> {
        Taylor::aim(self, t_end);
        Ok(())
    }
    fn between(&mut self, t: f64) -> Result<S, Failure> {
        Ok(self.at(t))
    }
}

impl<S: StateVector<f64>, C, R: SecondOrder<S, C>> Stepper<S> for RungeKuttaNystrom<S, C, R> {
    by_the_same_names!(RungeKuttaNystrom);
    fn aim(&mut self, t_end: f64) -> Result<(), Failure> {
        RungeKuttaNystrom::aim(self, t_end);
        Ok(())
    }
    fn between(&mut self, t: f64) -> Result<S, Failure> {
        self.at(t)
    }
}

impl<const N: usize, S: StateVector<f64>, F: Fn(f64, &S) -> S> Stepper<S> for Rattle<N, S, F> {
    by_the_same_names!(Rattle);
    fn aim(&mut self, t_end: f64) -> Result<(), Failure> {
        Rattle::aim(self, t_end)
    }
    fn between(&mut self, t: f64) -> Result<S, Failure> {
        self.at(t)
    }
    fn residual(&self) -> Option<f64> {
        Some(Rattle::residual(self))
    }
}

impl<S: StateVector<f64>, C, P: Pieces<S, C>> Stepper<S> for AdaptiveSplitting<S, C, P> {
    by_the_same_names!(AdaptiveSplitting);
    fn aim(&mut self, t_end: f64) -> Result<(), Failure> {
        AdaptiveSplitting::aim(self, t_end);
        Ok(())
    }
    fn between(&mut self, t: f64) -> Result<S, Failure> {
        self.at(t)
    }
}

impl<S: StateVector<f64>, C, P: Pieces<S, C>> Stepper<S> for Splitting<S, C, P> {
    by_the_same_names!(Splitting);
    fn aim(&mut self, t_end: f64) -> Result<(), Failure> {
        Splitting::aim(self, t_end)
    }
    fn between(&mut self, t: f64) -> Result<S, Failure> {
        self.at(t)
    }
}
