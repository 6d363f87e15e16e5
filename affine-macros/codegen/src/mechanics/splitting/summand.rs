//! Summands of a Hamiltonian, each with its equations.

use crate::algebra::{Arena, Expr, Polynomial, Rational};
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
    for summand in list.iter().chain([last]) {
        let known = |symbol: Expr, list: &[(Expr, Polynomial)]| list.iter().any(|(s, _)| *s == symbol);
        for (symbol, value) in &summand.system.shared {
            // Two may share a quantity; either definition has its value.
            if !known(*symbol, &sum.shared) {
                sum.shared.push((*symbol, value.clone()));
            }
        }
        sum.kernels.extend(summand.system.kernels.iter().cloned());
        for (z, symbol, rate) in &summand.system.rates {
            match sum.rates.iter_mut().find(|(at, ..)| at == z) {
                Some((.., total)) => total.add_scaled(rate, &Rational::ONE),
                None => sum.rates.push((*z, *symbol, rate.clone())),
            }
        }
        if let Some((symbol, power)) = &summand.system.work {
            let (_, total) = sum.work.get_or_insert_with(|| (*symbol, Polynomial::zero()));
            total.add_scaled(power, &Rational::ONE);
        }
    }
    sum
}
