//! Scalars, diagonals and matrices where they belong, and of the size that the dimension asks for.

use super::written::velocity_name;
use crate::diagnostics::{Diagnostics, Region, TermMistake};
use crate::spec::{Expression, Spec, Term, Value};
use crate::symbol::{Frame, Pattern, TermKind};

/// Casimirs and masses are multiples of one invariant form, an inertia J is of any kind (4.17), a tensor has n^4
/// entries.
pub(super) fn shapes(spec: &Spec, found: &mut Diagnostics) {
    for term in spec.forms() {
        if let Some((takes, instead)) = refused(term) {
            let (name, shape) = (term.kind.value.name(), term.value.shape());
            let mistake = TermMistake::TermShape { term: name, found: shape, takes, instead };
            found.report(term.span, mistake);
        }
    }
}

/// What the term takes, and what to write, where it is given something else.
fn refused(term: &Term) -> Option<(String, String)> {
    let kind = term.kind.value;
    let scalar = |takes: &str, instead: &str| match term.value {
        Value::Scalar(_) => None,
        _ => Some((takes.to_owned(), instead.to_owned())),
    };
    match (kind.pattern(), &term.value) {
        (Pattern::Centre, _) => {
            scalar("a scalar, the mass", "write one expression, as in `body_translation = m`")
        }
        (Pattern::Rows, _) | (Pattern::Pairs, Value::Matrix(_)) => None,
        (Pattern::Pairs, _) => {
            let o = velocity_name(kind.internal_frame().unwrap_or(Frame::Body));
            let same =
                |other: &TermKind| other.is_inertia() && other.internal_frame() == kind.internal_frame();
            let inertia = TermKind::ALL.into_iter().find(same).map_or("", TermKind::name);
            Some((
                format!("an n^2 x n^2 nested matrix K, the form 1/2 K[(A,B),(C,D)] {o}[A,B] {o}[C,D]"),
                format!("write `[[...], ...]`, or `{inertia}` for 1/2 tr({o} J {o}^T)"),
            ))
        }
        _ => scalar(
            "a scalar: it multiplies one invariant of the affine velocity",
            "write one expression, as in `casimir2 = a + 1/2`",
        ),
    }
}

/// J is n x n, a tensor n^2 x n^2. The number of rows comes first; if it is right, every row that is too short
/// or too long is reported on its own.
pub(super) fn sizes(spec: &Spec, found: &mut Diagnostics) {
    let n = spec.dim.value;
    for term in spec.forms() {
        let kind = term.kind.value;
        let Some(expected) = kind.pattern().rows(n) else { continue };
        let because = if kind.is_tensor() { format!("n^2 = {expected}") } else { format!("n = {n}") };
        has_size((kind.name(), &term.value, term.span), expected, &because, found);
    }
}

/// A matrix of this name has as many rows and columns as are `expected`.
pub(super) fn has_size(
    (term, value, span): (&'static str, &Value, Region),
    expected: usize,
    because: &str,
    found: &mut Diagnostics,
) {
    for (at, counted, actual) in counts(value, span, expected) {
        if actual != expected {
            let because = because.to_owned();
            found.report(at, TermMistake::MatrixSize { term, counted, found: actual, expected, because });
        }
    }
}

/// What is counted in a matrix: its rows, or what is in them where the number of rows is right.
fn counts(value: &Value, span: Region, expected: usize) -> Vec<(Region, String, usize)> {
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
