//! Scalars, diagonals and matrices where they belong, and of the size that the dimension asks for.

use proc_macro2::Span;

use crate::diagnostics::{Diagnostic, Diagnostics, Region};
use crate::spec::{Expression, Named, Spec, Term, TermKind, Value};

/// Casimirs and masses are multiples of one invariant form, d'Alembert takes an inertia J of any kind, a tensor
/// has n^4 entries. Anisotropic affine inertias are written as tensors.
pub(super) fn shapes(spec: &Spec, found: &mut Diagnostics) {
    for term in &spec.kinetic {
        let written = match term.value {
            Value::Scalar(_) => "a scalar",
            Value::Diagonal(_) => "a diagonal matrix",
            Value::Matrix(_) => "a matrix",
        };
        let (fits, takes, instead) = accepted(term);
        if !fits {
            let mistake = Diagnostic::TermShape {
                term: term.kind.value.name(),
                found: written,
                takes: takes.to_owned(),
                instead,
            };
            found.report(term.span, mistake);
        }
    }
}

fn accepted(term: &Term) -> (bool, &'static str, &'static str) {
    let scalar = matches!(term.value, Value::Scalar(_));
    match term.kind.value {
        TermKind::BodyInertia => {
            (scalar, "a scalar I in this version", "write the energy 1/2 tr(Oh J Oh^T) as `body_tensor`")
        }
        TermKind::SpaceInertia => {
            (scalar, "a scalar I in this version", "write the energy 1/2 tr(Om J Om^T) as `space_tensor`")
        }
        TermKind::Casimir2 | TermKind::Casimir1Squared => (
            scalar,
            "a scalar: it multiplies one invariant of the affine velocity",
            "write one expression, as in `casimir2 = a + 1/2`",
        ),
        TermKind::BodyTranslation | TermKind::SpaceTranslation => {
            (scalar, "a scalar, the mass", "write one expression, as in `body_translation = m`")
        }
        TermKind::Dalembert => (true, "", ""),
        TermKind::BodyTensor => (
            matches!(term.value, Value::Matrix(_)),
            "an n^2 x n^2 nested matrix K, the form 1/2 K[(A,B),(C,D)] Oh[A,B] Oh[C,D]",
            "write `[[...], ...]`, or `body_inertia` for an isotropic form",
        ),
        TermKind::SpaceTensor => (
            matches!(term.value, Value::Matrix(_)),
            "an n^2 x n^2 nested matrix K, the form 1/2 K[(A,B),(C,D)] Om[A,B] Om[C,D]",
            "write `[[...], ...]`, or `space_inertia` for an isotropic form",
        ),
    }
}

/// J is n x n, a tensor n^2 x n^2. The number of rows comes first; then every row that is too short or too
/// long is reported on its own.
pub(super) fn sizes(spec: &Spec, found: &mut Diagnostics) {
    let n = spec.dim.value;
    for term in &spec.kinetic {
        let kind = term.kind.value;
        let (expected, because) = match kind {
            TermKind::Dalembert => (n, format!("n = {n}")),
            kind if kind.is_tensor() => (n * n, format!("n^2 = {}", n * n)),
            _ => continue,
        };
        let mut sized = |at: Region, counted: String, actual: usize| {
            if actual != expected {
                let (term, because) = (kind.name(), because.clone());
                found.report(at, Diagnostic::MatrixSize { term, counted, found: actual, expected, because });
            }
        };
        match &term.value {
            Value::Scalar(_) => {}
            Value::Diagonal(entries) => sized(term.span, "diagonal entries".to_owned(), entries.len()),
            Value::Matrix(rows) => {
                sized(term.span, "rows".to_owned(), rows.len());
                for (index, row) in rows.iter().enumerate() {
                    sized(extent(row).unwrap_or(term.span), format!("entries in row {}", index + 1), row.len());
                }
            }
        }
    }
}

fn extent(row: &[Expression]) -> Option<Region> {
    let (start, end): (Span, Span) = (row.first()?.span.start, row.last()?.span.end);
    Some(Region { start, end })
}
