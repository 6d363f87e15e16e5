//! Summands of a Hamiltonian, each with its equations.

use crate::algebra::{Arena, Polynomial};
use crate::mechanics::equations::System;
use crate::mechanics::reduction::Reduction;

/// A summand of `H` with its equations over the reduced state.
pub(super) struct Summand {
    pub(super) name: String,
    /// The summand, where it is a polynomial.
    pub(super) energy: Option<Polynomial>,
    pub(super) system: System,
}

/// The equations that move components of the reduced state; `None` where they move anything else that is kept as a
/// constant.
pub(super) fn over_the_state(arena: &Arena, reduction: &Reduction, system: System) -> Option<System> {
    let mut system = system.substitute(&reduction.gauge());
    system.rates.retain(|(_, _, rate)| !rate.is_zero());
    let states = reduction.symbols();
    let inside = system.rates.iter().all(|(_, symbol, _)| states.contains(symbol));
    inside.then(|| system.tidied(arena))
}

/// The sum of summands.
pub(super) fn joined(list: &[Summand], last: &Summand) -> System {
    let mut sum = System::default();
    list.iter().chain([last]).for_each(|summand| sum.join(&summand.system));
    sum
}
