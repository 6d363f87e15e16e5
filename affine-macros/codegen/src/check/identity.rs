//! Identities between coefficients that hold whatever the fields are.

use crate::algebra::{Arena, Expr, Polynomial};
use crate::lower;
use crate::spec::Expression;

/// Is the expression zero for all values of the fields? `a - a` is, `a - b` is not; a quotient that would have
/// to be reduced first may go unnoticed.
pub(super) fn vanishes(expression: &Expression, n: usize) -> bool {
    let mut arena = Arena::new();
    lower::expression(&mut arena, n, expression).is_some_and(|value| is_zero(&mut arena, value))
}

/// The places below the diagonal whose entries differ from those across it, as far as rows reach.
pub(super) fn asymmetric(rows: &[Vec<Expression>], n: usize) -> impl Iterator<Item = (usize, usize)> {
    let below = (0..rows.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    let entry = |i: usize, j: usize| rows.get(i)?.get(j);
    below.filter(move |(i, j)| match (entry(*j, *i), entry(*i, *j)) {
        (Some(upper), Some(lower)) => equal(upper, lower, n) == Some(false),
        _ => false,
    })
}

/// Are the expressions equal for all values of the fields? `None` where one of them has no value.
fn equal(left: &Expression, right: &Expression, n: usize) -> Option<bool> {
    let mut arena = Arena::new();
    let left = lower::expression(&mut arena, n, left)?;
    let right = lower::expression(&mut arena, n, right)?;
    let difference = arena.sub(left, right);
    Some(is_zero(&mut arena, difference))
}

fn is_zero(arena: &mut Arena, value: Expr) -> bool {
    Polynomial::normal_form(arena, value).is_zero()
}
