//! Identities between coefficients that hold whatever the fields are.

use crate::algebra::Arena;
use crate::algebra::vanishing::vanishes;
use crate::lower;
use crate::spec::Expression;

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
    let left = lower::expression(&mut arena, n, left).ok()?;
    let right = lower::expression(&mut arena, n, right).ok()?;
    let difference = arena.sub(left, right);
    Some(vanishes(&arena, difference))
}
