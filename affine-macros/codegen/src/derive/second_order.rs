//! The halves of the equations as programs.

use crate::algebra::Arena;
use crate::algebra::bind::Constants;
use crate::ir::Program;
use crate::mechanics::body::Body;
use crate::mechanics::hamiltonian::Hamiltonian;
use crate::mechanics::reduction::Reduction;
use crate::mechanics::second_order::second_order;
use crate::symbol::Symbol;

use super::batch::{batch, program};

/// `q' = V(p)`, `p' = F(t, q)` over the reduced state.
pub struct Halves {
    /// Names of the positions.
    pub positions: Vec<Symbol>,
    /// Names of the momenta.
    pub momenta: Vec<Symbol>,
    /// Momenta -> velocities.
    pub velocity: Program,
    /// Time and positions -> forces.
    pub force: Program,
}

impl Halves {
    /// Those of the chosen reduction; coefficients that a trajectory fixes join `constants`.
    pub(super) fn of(
        arena: &mut Arena,
        (h, body): (&Hamiltonian, &Body),
        reduction: &Reduction,
        constants: &mut Constants,
    ) -> Option<Self> {
        let halves = second_order(arena, (h, body), reduction)?;
        let mut varying = reduction.symbols();
        varying.extend(body.time(arena));
        let [positions, momenta] = [&halves.positions, &halves.momenta].map(|half| half.moved(arena));
        let [velocity, force] = [&halves.positions, &halves.momenta].map(|system| {
            let rates = batch(arena, system);
            program(arena, &rates, constants, &varying)
        });
        Some(Self { positions, momenta, velocity, force })
    }
}
