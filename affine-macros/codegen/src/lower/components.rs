//! Components that a potential names in the user's bases, through those in orthonormal ones.
//!
//! With `x' = A x` and `phi' = A phi B^-1`: `x = A^-1 x'`, `phi = A^-1 phi' B`, `G = phi^T g phi = B^T G' B` with lower
//! indices, `Ct = phi eta^-1 phi^T = A^-1 Ct' A^-T` with upper ones.

use crate::algebra::ring::{pairs, upper};
use crate::algebra::substitute::listed;
use crate::algebra::{Arena, Expr, Matrix, Rational};
use crate::mechanics::metrics::{Metrics, Rebased};
use crate::mechanics::potential::Base;
use crate::symbol::Aspect;

/// The symbol of a component in the user's bases.
pub(super) fn symbol(arena: &mut Arena, base: Base) -> Expr {
    let own = base.symbol(arena);
    arena.about(Aspect::Given, own)
}

/// Expressions with these symbols replaced.
pub(super) fn carried(
    arena: &mut Arena,
    n: usize,
    expressions: &[Expr],
    metrics: &Metrics,
    rebased: &mut Vec<Rebased>,
) -> Vec<Expr> {
    let mut bases: Vec<Base> = (0..n).map(Base::Position).collect();
    bases.extend(pairs(n).map(|(i, a)| Base::Placement(i, a)));
    bases.extend(upper(n).flat_map(|(a, b)| [Base::Green(a, b), Base::Finger(a, b)]));
    let named: Vec<(Expr, Base)> = bases.into_iter().map(|base| (symbol(arena, base), base)).collect();
    let is_named = |e: Expr| named.iter().any(|(symbol, _)| *symbol == e);
    if !expressions.iter().any(|one| arena.any_symbol(*one, &mut |e| is_named(e))) {
        return expressions.to_vec();
    }
    let [space_inverse, body] = metrics.factors(arena, rebased);
    let values: Vec<(Expr, Expr)> =
        named.into_iter().map(|(symbol, base)| (symbol, value(arena, base, &space_inverse, &body))).collect();
    // Metrics are regular: what is not zero in the bases of the user is not zero in others.
    expressions.iter().map(|one| arena.replaced(*one, &listed(&values))).collect()
}

/// A component as a sum of those in orthonormal bases.
fn value(arena: &mut Arena, base: Base, space_inverse: &Matrix, body: &Matrix) -> Expr {
    let row = |i: usize| space_inverse.0[i].clone();
    let column = |a: usize| body.0.iter().map(|row| row[a]).collect::<Vec<Expr>>();
    let one = arena.constant(Rational::ONE);
    let (left, right, of): (_, _, fn(usize, usize) -> Base) = match base {
        Base::Position(i) => (row(i), vec![one], |j, _| Base::Position(j)),
        Base::Placement(i, a) => (row(i), column(a), Base::Placement),
        Base::Green(a, c) => (column(a), column(c), Base::Green),
        Base::Finger(i, k) => (row(i), row(k), Base::Finger),
        // Invariants are the same in every basis.
        other => return other.symbol(arena),
    };
    let mut sum = arena.constant(Rational::ZERO);
    for (j, left) in left.iter().enumerate() {
        for (b, right) in right.iter().enumerate() {
            let (weight, own) = (arena.mul(*left, *right), of(j, b).symbol(arena));
            let product = arena.mul(weight, own);
            sum = arena.add(sum, product);
        }
    }
    sum
}
