//! Tensors `1/2 K[(A,B),(C,D)] O[A,B] O[C,D]` over `Oh`, `Om` or `phi_dot`.

use super::identity::asymmetric;
use crate::diagnostics::{Diagnostics, TermMistake};
use crate::spec::{Spec, Value};

/// K[(A,B),(C,D)] = K[(C,D),(A,B)]: T sees only the part of K that is symmetric under exchange of the pairs,
/// so a tensor without this symmetry has a slip in it. The row and column of (A,B) are n(A-1)+B.
pub(super) fn symmetric(spec: &Spec, found: &mut Diagnostics) {
    let n = spec.dim.value;
    for term in spec.forms().filter(|term| term.kind.value.is_tensor()) {
        let Value::Matrix(rows) = &term.value else { continue };
        for (row, column) in asymmetric(rows, n) {
            let mistake = TermMistake::TensorNotSymmetric {
                term: term.kind.value.name(),
                first: pair(column, n),
                second: pair(row, n),
                value: rows[column][row].to_string(),
                transposed: rows[row][column].to_string(),
            };
            found.report(rows[row][column].span, mistake);
        }
    }
}

/// The 1-based pair of a row or column.
fn pair(index: usize, n: usize) -> String {
    format!("({},{})", index / n + 1, index % n + 1)
}
