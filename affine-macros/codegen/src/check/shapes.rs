//! Scalars, diagonals and matrices where they belong, and of the size that the dimension asks for.

use crate::diagnostics::{Diagnostics, Region, TermMistake};
use crate::spec::{Expression, Named, Spec, Term, Value};
use crate::symbol::TermKind;

/// Casimirs and masses are multiples of one invariant form, an inertia J is of any kind (4.17), a tensor has n^4
/// entries.
pub(super) fn shapes(spec: &Spec, found: &mut Diagnostics) {
    for term in spec.forms() {
        let written = match term.value {
            Value::Scalar(_) => "a scalar",
            Value::Diagonal(_) => "a diagonal matrix",
            Value::Matrix(_) => "a matrix",
        };
        let (fits, takes, instead) = accepted(term);
        if !fits {
            let mistake = TermMistake::TermShape {
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
        TermKind::Casimir2 | TermKind::Casimir1Squared => (
            scalar,
            "a scalar: it multiplies one invariant of the affine velocity",
            "write one expression, as in `casimir2 = a + 1/2`",
        ),
        TermKind::BodyTranslation | TermKind::SpaceTranslation => {
            (scalar, "a scalar, the mass", "write one expression, as in `body_translation = m`")
        }
        TermKind::BodyInertia | TermKind::SpaceInertia | TermKind::Dalembert => (true, "", ""),
        TermKind::BodyTensor => (
            matches!(term.value, Value::Matrix(_)),
            "an n^2 x n^2 nested matrix K, the form 1/2 K[(A,B),(C,D)] Oh[A,B] Oh[C,D]",
            "write `[[...], ...]`, or `body_inertia` for 1/2 tr(Oh J Oh^T)",
        ),
        TermKind::SpaceTensor => (
            matches!(term.value, Value::Matrix(_)),
            "an n^2 x n^2 nested matrix K, the form 1/2 K[(A,B),(C,D)] Om[A,B] Om[C,D]",
            "write `[[...], ...]`, or `space_inertia` for 1/2 tr(Om J Om^T)",
        ),
        TermKind::FlatTensor => (
            matches!(term.value, Value::Matrix(_)),
            "an n^2 x n^2 nested matrix K, the form 1/2 K[(A,B),(C,D)] phi_dot[A,B] phi_dot[C,D]",
            "write `[[...], ...]`, or `dalembert` for 1/2 tr(phi_dot J phi_dot^T)",
        ),
    }
}

/// J is n x n, a tensor n^2 x n^2. The number of rows comes first; if it is right, every row that is too short
/// or too long is reported on its own.
pub(super) fn sizes(spec: &Spec, found: &mut Diagnostics) {
    let n = spec.dim.value;
    for term in spec.forms() {
        let kind = term.kind.value;
        let (expected, because) = match kind {
            kind if kind.is_inertia() => (n, format!("n = {n}")),
            kind if kind.is_tensor() => (n * n, format!("n^2 = {}", n * n)),
            _ => continue,
        };
        for (at, counted, actual) in counts(&term.value, term.span, expected) {
            if actual != expected {
                let (term, because) = (kind.name(), because.clone());
                found.report(at, TermMistake::MatrixSize { term, counted, found: actual, expected, because });
            }
        }
    }
}

/// What is counted in a matrix: its rows, or what is in them where the number of rows is right.
pub(super) fn counts(value: &Value, span: Region, expected: usize) -> Vec<(Region, String, usize)> {
    match value {
        Value::Scalar(_) => Vec::new(),
        Value::Diagonal(entries) => vec![(span, "diagonal entries".to_owned(), entries.len())],
        Value::Matrix(rows) if rows.len() != expected => vec![(span, "rows".to_owned(), rows.len())],
        Value::Matrix(rows) => rows
            .iter()
            .enumerate()
            .map(|(index, row)| {
                let at = extent(row).unwrap_or(span);
                (at, format!("entries in row {}", index + 1), row.len())
            })
            .collect(),
    }
}

fn extent(row: &[Expression]) -> Option<Region> {
    Some(row.first()?.span.to(row.last()?.span))
}
