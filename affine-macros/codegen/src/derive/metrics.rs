//! The change to orthonormal bases: known, or left to `prepare()`.

use crate::algebra::{Arena, Expr, Polynomial};
use crate::ir::Program;
use crate::mechanics::metrics::{Bases, Metrics};

use super::prepared::unbound;

/// Where the bases come from in which the metrics are the identity. The equations do not know of them.
pub enum ChangeOfBases {
    /// From numbers.
    Known(Bases),
    /// From the fields, when the model is prepared: programs of the entries of `g` and `eta`, row after row.
    Prepared([Program; 2]),
}

impl ChangeOfBases {
    pub(super) fn of(arena: &mut Arena, metrics: Metrics) -> Self {
        match metrics {
            Metrics::Known(bases) => Self::Known(bases),
            Metrics::Given(given) => Self::Prepared(given.map(|rows| entries(arena, &rows.concat()))),
        }
    }
}

fn entries(arena: &mut Arena, entries: &[Expr]) -> Program {
    let entries: Vec<Polynomial> = entries.iter().map(|e| Polynomial::normal_form(arena, *e)).collect();
    unbound(arena, entries.into_iter())
}
