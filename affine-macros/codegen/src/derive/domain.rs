//! Where the potential has a value.

use crate::algebra::bind::Constants;
use crate::algebra::{Arena, Expr};
use crate::ir::Program;
use crate::mechanics::charts::Chart;
use crate::mechanics::potential::{Bound, Guard, Potential};
use crate::optimise::Batch;
use crate::symbol::Quantity;

use super::batch::program;

/// Where the potential has a value.
pub struct Domain {
    /// Functions of the state that keep their sign.
    pub guards: Vec<Guard>,
    /// Point -> their values.
    pub program: Program,
}

/// An argument that keeps its sign.
pub struct SignedArgument<'a> {
    /// The part of the potential that it stands in.
    pub part: &'a str,
    /// The function of the state, as written: `q`, `x[1]`.
    pub argument: &'a str,
    /// The sign that it keeps.
    pub sign: Sign,
}

/// The sign that an argument keeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// Above zero.
    Positive,
    /// Zero or above.
    NotNegative,
    /// That of the start.
    NotZero,
}

impl Domain {
    /// The arguments that keep their signs.
    pub fn arguments(&self) -> impl Iterator<Item = SignedArgument<'_>> {
        self.guards.iter().filter_map(|Guard { part, argument, bound, .. }| {
            let sign = match bound {
                Bound::Positive => Sign::Positive,
                Bound::NotNegative => Sign::NotNegative,
                Bound::NotZero => Sign::NotZero,
                Bound::Angle => return None,
            };
            Some(SignedArgument { part, argument, sign })
        })
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
    let (values, shared) = potential.domain_at_a_point(arena, chart)?;
    let names = (1..).map(|k| Quantity::Guard.at([k]));
    let batch = Batch { shared, results: names.zip(values).collect(), ..Batch::default() };
    let program = program(arena, &batch, coefficients, inputs);
    Some(Domain { guards: potential.domain().to_vec(), program })
}
