//! Tensors `1/2 K[(A,B),(C,D)] O[A,B] O[C,D]` over `Oh`, `Om` or `phi_dot`.

use super::identity::equal;
use crate::diagnostics::{Diagnostics, TermMistake};
use crate::spec::{Expression, Spec, Term, Value};

/// K[(A,B),(C,D)] = K[(C,D),(A,B)]: T sees only the part of K that is symmetric under exchange of the pairs,
/// so a tensor without this symmetry has a slip in it. The row and column of (A,B) are n(A-1)+B.
pub(super) fn symmetric(spec: &Spec, found: &mut Diagnostics) {
    let n = spec.dim.value;
    for term in tensors(spec) {
        let Value::Matrix(rows) = &term.value else { continue };
        for (row, column) in (0..rows.len()).flat_map(|row| (0..row).map(move |column| (row, column))) {
            let (Some(lower), Some(upper)) = (entry(rows, row, column), entry(rows, column, row)) else {
                continue;
            };
            if equal(upper, lower, n) == Some(false) {
                let mistake = TermMistake::TensorNotSymmetric {
                    term: term.kind.value.name(),
                    first: pair(column, n),
                    second: pair(row, n),
                    value: upper.to_string(),
                    transposed: lower.to_string(),
                };
                found.report(lower.span, mistake);
            }
        }
    }
}

fn tensors(spec: &Spec) -> impl Iterator<Item = &Term> {
    spec.forms().filter(|term| term.kind.value.is_tensor())
}

fn entry(rows: &[Vec<Expression>], row: usize, column: usize) -> Option<&Expression> {
    rows.get(row)?.get(column)
}

/// The 1-based pair of a row or column.
fn pair(index: usize, n: usize) -> String {
    format!("({},{})", index / n + 1, index % n + 1)
}
