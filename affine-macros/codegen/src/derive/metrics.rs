//! The change to orthonormal bases: known, or left to `prepare()`.

use crate::algebra::{Arena, Expr, Polynomial};
use crate::ir::Program;
use crate::mechanics::kinetic::{Frame, TermKind};
use crate::mechanics::metrics::{Bases, Metrics, Rebased};

use super::prepared::unbound;

/// Where the bases come from in which the metrics are the identity. The equations do not know of them.
pub enum ChangeOfBases {
    /// From numbers.
    Known(Bases),
    /// From the fields, when the model is prepared.
    Prepared(Preparation),
}

impl ChangeOfBases {
    pub(super) fn of(arena: &mut Arena, metrics: Metrics, rebased: &[Rebased]) -> Self {
        match metrics {
            Metrics::Known(bases) => Self::Known(bases),
            Metrics::Given(given) => Self::Prepared(Preparation {
                metrics: given.map(|rows| entries(arena, &rows.concat())),
                matrices: rebased.iter().map(|matrix| GivenMatrix::of(arena, matrix)).collect(),
            }),
        }
    }
}

/// What `prepare()` does for the change.
pub struct Preparation {
    /// Programs of the entries of `g` and `eta`, row after row.
    pub metrics: [Program; 2],
    /// Inertias and tensors that it carries to orthonormal bases.
    pub matrices: Vec<GivenMatrix>,
}

/// An inertia or a tensor in the user's bases.
pub struct GivenMatrix {
    /// The name that coefficients have for it in orthonormal bases.
    pub name: String,
    /// Its entries, row after row.
    pub entries: Program,
    /// `O`, whose bases it goes with.
    pub frame: Frame,
    /// Is it contracted with both indices of `O`?
    pub tensor: bool,
}

impl GivenMatrix {
    fn of(arena: &mut Arena, matrix: &Rebased) -> Self {
        let kind: TermKind = matrix.kind;
        Self {
            name: matrix.name.clone(),
            entries: entries(arena, &matrix.entries),
            // No matrix stands at a term without a frame.
            frame: kind.internal_frame().unwrap_or(Frame::Body),
            tensor: kind.is_tensor(),
        }
    }
}

fn entries(arena: &mut Arena, entries: &[Expr]) -> Program {
    let entries: Vec<Polynomial> = entries.iter().map(|e| Polynomial::normal_form(arena, *e)).collect();
    unbound(arena, entries.into_iter())
}
