//! Where the potential has a value, as a program.

use super::model::Domain;
use crate::algebra::bind::Constants;
use crate::algebra::{Arena, Expr};
use crate::ir::fuse::fuse;
use crate::mechanics::charts::Chart;
use crate::mechanics::potential::Potential;
use crate::optimise::{Batch, straight_line};

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
    let names = (1..).map(|k| format!("guard_{k}"));
    let batch = Batch { shared, results: names.zip(values).collect(), ..Batch::default() };
    let program = fuse(&straight_line(arena, &batch, coefficients, &|atom| inputs.contains(&atom)));
    Some(Domain { guards: potential.domain().to_vec(), program })
}
