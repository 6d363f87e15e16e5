//! The change to orthonormal bases: known, or left to `prepare()`.

use crate::algebra::fault::never_missing;
use crate::algebra::{Arena, Expr, Polynomial};
use crate::ir::Program;
use crate::mechanics::metrics::{Bases, Metrics, Rebased, Source};
use crate::mechanics::term::Frame;

use super::batch::values;

/// Where the bases come from in which the metrics are the identity. The equations do not know of them.
pub enum ChangeOfBases {
    /// The bases of metrics that are numbers.
    Known(Box<Bases>),
    /// From the fields, when the model is prepared.
    Prepared,
}

impl ChangeOfBases {
    /// With what `prepare()` does for it.
    pub(super) fn of(
        arena: &mut Arena,
        metrics: Metrics,
        rebased: &[Rebased],
    ) -> (Self, Option<Preparation>) {
        match metrics {
            Metrics::Known(bases) => (Self::Known(Box::new(bases)), None),
            Metrics::Given(given) => {
                let metrics = given.map(|rows| entries(arena, &rows.concat()));
                let matrices = rebased.iter().map(|matrix| GivenMatrix::of(arena, matrix)).collect();
                (Self::Prepared, Some(Preparation { metrics, matrices }))
            }
        }
    }
}

/// What `prepare()` does for the change.
pub(super) struct Preparation {
    /// Programs of the entries of `g` and `eta`, row after row.
    pub(super) metrics: [Program; 2],
    /// Inertias and tensors that it carries to orthonormal bases, and factors of these that potentials read.
    pub(super) matrices: Vec<GivenMatrix>,
}

/// A matrix that coefficients read.
pub struct GivenMatrix {
    /// Its number, which they bear.
    pub number: usize,
    /// What it is made from.
    pub source: GivenSource,
}

/// What a matrix is made from.
pub enum GivenSource {
    /// An inertia or a tensor.
    Form {
        /// Its entries in the user's bases, row after row.
        entries: Program,
        /// That of `O`, whose bases it goes with.
        frame: Frame,
        /// Is it contracted with both indices of `O`?
        tensor: bool,
    },
    /// `A^-1`.
    SpaceInverse,
    /// `B`.
    Body,
}

impl GivenMatrix {
    fn of(arena: &mut Arena, matrix: &Rebased) -> Self {
        let source = match &matrix.source {
            Source::Form(kind, given) => GivenSource::Form {
                entries: entries(arena, given),
                frame: never_missing(
                    kind.internal_frame(),
                    "no matrix stands at a term without a frame",
                    Frame::Body,
                ),
                tensor: kind.is_tensor(),
            },
            Source::SpaceInverse => GivenSource::SpaceInverse,
            Source::Body => GivenSource::Body,
        };
        Self { number: matrix.number, source }
    }
}

fn entries(arena: &mut Arena, entries: &[Expr]) -> Program {
    let entries: Vec<Polynomial> = entries.iter().map(|e| Polynomial::normal_form(arena, *e)).collect();
    values(arena, entries.into_iter())
}
