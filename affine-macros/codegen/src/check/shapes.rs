//! Scalars, diagonals and matrices where they belong, and of the size that the dimension asks for.

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

/// J is n x n, a tensor n^2 x n^2. The number of rows comes first; if it is right, every row that is too short
/// or too long is reported on its own.
pub(super) fn sizes(spec: &Spec, found: &mut Diagnostics) {
    let n = spec.dim.value;
    for term in &spec.kinetic {
        let kind = term.kind.value;
        let (expected, because) = match kind {
            TermKind::Dalembert => (n, format!("n = {n}")),
            kind if kind.is_tensor() => (n * n, format!("n^2 = {}", n * n)),
            _ => continue,
        };
        for (at, counted, actual) in counts(term, expected) {
            if actual != expected {
                let (term, because) = (kind.name(), because.clone());
                found.report(at, Diagnostic::MatrixSize { term, counted, found: actual, expected, because });
            }
        }
    }
}

/// What is counted in a matrix: its rows, or what is in them where the number of rows is right.
fn counts(term: &Term, expected: usize) -> Vec<(Region, String, usize)> {
    match &term.value {
        Value::Scalar(_) => Vec::new(),
        Value::Diagonal(entries) => vec![(term.span, "diagonal entries".to_owned(), entries.len())],
        Value::Matrix(rows) if rows.len() != expected => vec![(term.span, "rows".to_owned(), rows.len())],
        Value::Matrix(rows) => rows
            .iter()
            .enumerate()
            .map(|(index, row)| {
                let at = extent(row).unwrap_or(term.span);
                (at, format!("entries in row {}", index + 1), row.len())
            })
            .collect(),
    }
}

fn extent(row: &[Expression]) -> Option<Region> {
    Some(row.first()?.span.to(row.last()?.span))
}
