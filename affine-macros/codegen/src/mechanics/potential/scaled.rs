//! Functions of `phi = D Psi`, `det Psi = 1`, through `D` and `Psi`: tensors are powers of `D` times those of `Psi`, and in
//! what is of degree 0 the powers cancel before they leave the range of numbers.

use crate::algebra::arena::Node;
use crate::algebra::rational::exponent;
use crate::algebra::ring::{pairs, table};
use crate::algebra::{Arena, Expr, Function, Matrix, Polynomial, Rational};
use crate::mechanics::charts::Chart;
use crate::mechanics::metric::Definitions;

use super::base::Base;
use super::tensors;

/// Base functions that `D` is in, as its powers times those of `Psi`.
pub(super) fn scaled_bases(arena: &mut Arena, n: usize, d: Expr) -> Vec<(Expr, Expr)> {
    let mut list = Vec::new();
    for base in Base::all(n).into_iter().filter(|base| base.degree() != 0) {
        let (symbol, unit) = (base.symbol(arena), base.unit(arena));
        // A symbol is not the number zero.
        list.push((symbol, arena.certain_product(&[(d, exponent(base.degree())), (unit, 1)])));
    }
    list
}

/// The normal form of an expression in powers of `D`, without products of `D` and `1/D`, which are atoms of their own.
pub(super) fn collected(arena: &mut Arena, expr: Expr, d: Expr) -> Polynomial {
    let expr = without_cancelling_powers(arena, expr, d);
    let form = Polynomial::normal_form(arena, expr);
    cancelled(arena, &form, d)
}

/// The expression with powers of `D` collected, in the arguments of functions too.
fn without_cancelling_powers(arena: &mut Arena, expr: Expr, d: Expr) -> Expr {
    let rebuilt =
        |arena: &mut Arena| arena.rebuilt(expr, &mut |arena, part| without_cancelling_powers(arena, part, d));
    match *arena.node(expr) {
        Node::Function(Function::Ln, argument) => {
            let argument = without_cancelling_powers(arena, argument, d);
            logarithm(arena, argument, d)
        }
        Node::Sum(..) | Node::Product(_) => {
            let rebuilt = rebuilt(arena);
            let form = Polynomial::normal_form(arena, rebuilt);
            cancelled(arena, &form, d).expression(arena)
        }
        _ => rebuilt(arena),
    }
}

/// `ln(D^k u) = k q + ln u`.
fn logarithm(arena: &mut Arena, argument: Expr, d: Expr) -> Expr {
    let power = match arena.node(argument) {
        Node::Product(factors) => factors.iter().find(|(base, _)| *base == d).map_or(0, |(_, k)| *k),
        _ => 0,
    };
    let rest = arena.certain_product(&[(argument, 1), (d, -power)]);
    let (q, rest) = (Base::MeanLogStretch.symbol(arena), arena.apply(Function::Ln, rest));
    arena.linear(&[(q, Rational::from(i64::from(power))), (rest, Rational::ONE)])
}

/// The polynomial without products of `D` and `1/D`, which are atoms of their own.
fn cancelled(arena: &mut Arena, form: &Polynomial, d: Expr) -> Polynomial {
    let inverse = arena.reciprocal(d);
    let mut result = Polynomial::zero();
    for (monomial, c) in form.terms() {
        let count = |atom: Expr| monomial.iter().filter(|a| **a == atom).count();
        let (up, down) = (count(d), count(inverse));
        let left = if up > down { vec![d; up - down] } else { vec![inverse; down - up] };
        let others = monomial.iter().copied().filter(|atom| *atom != d && *atom != inverse);
        result.add_term(others.chain(left).collect(), c);
    }
    result
}

/// `Psi`, its tensors and traces, with `1/D` as an atom; what is not used goes later.
pub(super) fn definitions(arena: &mut Arena, chart: &Chart, inverse: Expr) -> Definitions {
    let psi = Matrix(table(chart.dim, |i, a| Base::Placement(i, a).unit(arena)));
    let scaled = |(i, a): (usize, usize)| (psi.0[i][a], Polynomial::monomial([inverse, chart.phi.0[i][a]]));
    let mut list: Definitions = pairs(chart.dim).map(scaled).collect();
    list.extend(tensors::definitions(arena, &psi.atoms(), 0, true));
    list
}
