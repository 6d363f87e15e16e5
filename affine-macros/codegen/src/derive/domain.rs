//! Where the potential has a value.

use crate::algebra::bind::Constants;
use crate::algebra::{Arena, Expr, Polynomial};
use crate::ir::Program;
use crate::mechanics::charts::Chart;
use crate::mechanics::metric::Definitions;
use crate::mechanics::potential::{Bound, Guard, Potential};
use crate::optimise::Batch;
use crate::symbol::Quantity;

use super::batch::{numbered, program};

/// Where the potential has a value.
pub struct Domain {
    /// Functions of the state that keep their sign.
    pub guards: Vec<Guard>,
    /// Point -> their values.
    pub program: Program,
    /// The same far from the undeformed state, where that differs.
    pub far_away: Option<Program>,
}

impl Domain {
    /// The functions that keep their sign, and not their size.
    pub fn signed(&self) -> impl Iterator<Item = &Guard> {
        self.guards.iter().filter(|guard| guard.bound != Bound::Angle)
    }

    /// The parts with an angle that the time turns.
    pub fn angles(&self) -> impl Iterator<Item = &str> {
        self.guards.iter().filter(|guard| guard.bound == Bound::Angle).map(|guard| guard.part.as_str())
    }
}

/// What has to keep its sign along a motion; `None` where the potential has a value at every state.
pub(super) fn domain(
    arena: &mut Arena,
    chart: &Chart,
    potential: Option<&Potential>,
    coefficients: &mut Constants,
    inputs: &[Expr],
) -> Option<Domain> {
    let potential = potential?;
    let near = potential.domain_at_a_point(arena, chart)?;
    let far_away = potential.domain_far_away(arena, chart);
    let mut program = |(values, shared): (Vec<Polynomial>, Definitions)| {
        let results = numbered(Quantity::Guard, values).collect();
        program(arena, &Batch { shared, results, ..Batch::default() }, coefficients, inputs)
    };
    let (program, far_away) = (program(near), far_away.map(program));
    Some(Domain { guards: potential.domain().to_vec(), program, far_away })
}
