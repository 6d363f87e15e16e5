//! The lattice in ratios of stretches as a program.

use crate::algebra::bind::Constants;
use crate::algebra::{Arena, Expr};
use crate::derive::batch::program;
use crate::ir::Program;
use crate::mechanics::two_polar::Ratios;
use crate::optimise::Batch;
use crate::symbol::{Aspect, Quantity, Symbol};

/// The equations in ratios.
pub struct RatioProgram {
    /// Components of the state.
    pub state: Vec<Symbol>,
    /// `U_ab`, `W_ab` where they are constants.
    pub couplings: Vec<Symbol>,
    /// State -> its rate.
    pub program: Program,
}

impl RatioProgram {
    pub(super) fn of(arena: &mut Arena, form: &Ratios) -> Self {
        let state: Vec<Expr> = form.rates.iter().map(|(z, _)| *z).collect();
        let couplings: Vec<Expr> =
            form.couplings.iter().flatten().copied().filter(|z| !state.contains(z)).collect();
        let results =
            form.rates.iter().map(|(z, rate)| (arena.symbol_of(*z).seen(Aspect::Rate), rate.clone()));
        let batch = Batch { shared: form.shared.clone(), results: results.collect(), ..Batch::default() };
        let varying: Vec<Expr> = state.iter().chain(&couplings).copied().collect();
        // Nothing depends on the coefficients of the model.
        let program = program(arena, &batch, &mut Constants::new(Quantity::Coefficient), &varying);
        Self { state: arena.symbols_of(&state), couplings: arena.symbols_of(&couplings), program }
    }
}
