//! Components that a potential names in the user's bases, through those in orthonormal ones.
//!
//! With `x' = A x` and `phi' = A phi B^-1`: `x = A^-1 x'`, `phi = A^-1 phi' B`, `G = phi^T g phi = B^T G' B` with lower
//! indices, `Ct = phi eta^-1 phi^T = A^-1 Ct' A^-T` with upper ones.

use crate::algebra::ring::pairs;
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
) -> Option<Vec<Expr>> {
    let pairs = || pairs(n);
    let mut bases: Vec<Base> = (0..n).map(Base::Position).collect();
    bases.extend(pairs().map(|(i, a)| Base::Placement(i, a)));
    bases.extend(pairs().filter(|(a, b)| a <= b).flat_map(|(a, b)| [Base::Green(a, b), Base::Finger(a, b)]));
    let named: Vec<(Expr, Base)> = bases.into_iter().map(|base| (symbol(arena, base), base)).collect();
    let is_named = |e: Expr| named.iter().any(|(symbol, _)| *symbol == e);
    if !expressions.iter().any(|one| arena.any_symbol(*one, &mut |e| is_named(e))) {
        return Some(expressions.to_vec());
    }
    let [space_inverse, body] = metrics.factors(arena, rebased);
    let values: Vec<(Expr, Expr)> =
        named.into_iter().map(|(symbol, base)| (symbol, value(arena, base, &space_inverse, &body))).collect();
    let value = |e: Expr| values.iter().find(|(symbol, _)| *symbol == e).map(|(_, value)| *value);
    expressions.iter().map(|one| arena.substitute(*one, &value)).collect()
}

/// A component as a sum of those in orthonormal bases.
fn value(arena: &mut Arena, base: Base, space_inverse: &Matrix, body: &Matrix) -> Expr {
    let n = body.dim();
    let pairs = || pairs(n);
    let mut terms: Vec<Vec<Expr>> = Vec::new();
    let mut add = |arena: &mut Arena, factors: &[Expr], base: Base| {
        let own = base.symbol(arena);
        terms.push([factors, &[own]].concat());
    };
    match base {
        Base::Position(i) => (0..n).for_each(|j| add(arena, &[space_inverse.0[i][j]], Base::Position(j))),
        Base::Placement(i, a) => pairs().for_each(|(j, b)| {
            add(arena, &[space_inverse.0[i][j], body.0[b][a]], Base::Placement(j, b));
        }),
        Base::Green(a, c) => {
            pairs().for_each(|(b, d)| add(arena, &[body.0[b][a], body.0[d][c]], Base::Green(b, d)));
        }
        Base::Finger(i, k) => pairs().for_each(|(j, l)| {
            add(arena, &[space_inverse.0[i][j], space_inverse.0[k][l]], Base::Finger(j, l));
        }),
        // Invariants are the same in every basis.
        other => add(arena, &[], other),
    }
    let zero = arena.constant(Rational::ZERO);
    terms.into_iter().fold(zero, |sum, factors| {
        let one = arena.constant(Rational::ONE);
        let product = factors.into_iter().fold(one, |product, factor| arena.mul(product, factor));
        arena.add(sum, product)
    })
}
