//! Functions of `phi = D Psi`, `det Psi = 1`, through `D` and `Psi`: tensors are powers of `D` times those of `Psi`, and in
//! what is of degree 0 the powers cancel before they leave the range of numbers.

use crate::algebra::arena::Node;
use crate::algebra::ring::{Square, pairs, table, upper};
use crate::algebra::{Arena, Expr, Function, Matrix, Polynomial, Rational};
use crate::mechanics::charts::Chart;
use crate::symbol::Quantity;

use super::base::Base;
use super::tensors::{UNIT_SQUARES, definitions_of_square, finger, green, squares, traces};

impl Base {
    /// The power of `D` in it.
    pub(super) fn degree(self) -> i32 {
        match self {
            Self::MeanLogStretch | Self::LogStretch(_) | Self::Position(_) => 0,
            Self::Placement(..) => 1,
            Self::Trace | Self::Green(..) | Self::Finger(..) => 2,
            Self::TraceOfSquare => 4,
            Self::TraceOfCube => 6,
        }
    }

    /// The symbol of the same function of `Psi`.
    pub(super) fn unit(self, arena: &mut Arena) -> Expr {
        let (unit, own) = match self {
            Self::Placement(..) => (Quantity::UnitPlacement, self.quantity()),
            Self::Green(..) => (Quantity::UnitGreen, self.quantity()),
            Self::Finger(..) => (Quantity::UnitFinger, self.quantity()),
            Self::Trace | Self::TraceOfSquare | Self::TraceOfCube => (Quantity::UnitTrace, self.quantity()),
            Self::MeanLogStretch | Self::LogStretch(_) | Self::Position(_) => return self.symbol(arena),
        };
        arena.symbol(own.of(unit))
    }
}

/// Base functions that `D` is in, as its powers times those of `Psi`.
pub(super) fn scaled_bases(arena: &mut Arena, n: usize, d: Expr) -> Vec<(Expr, Expr)> {
    let mut list = Vec::new();
    for base in Base::all(n).into_iter().filter(|base| base.degree() != 0) {
        let (symbol, unit) = (base.symbol(arena), base.unit(arena));
        // A symbol is not the number zero.
        list.push((symbol, arena.certain_product(&[(d, base.degree()), (unit, 1)])));
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
    let mut parts = |arena: &mut Arena, e: Expr| without_cancelling_powers(arena, e, d);
    match *arena.node(expr) {
        Node::Function(Function::Ln, argument) => {
            let argument = parts(arena, argument);
            logarithm(arena, argument, d)
        }
        Node::Sum(..) | Node::Product(_) => {
            let rebuilt = arena.rebuilt(expr, &mut parts);
            let form = Polynomial::normal_form(arena, rebuilt);
            cancelled(arena, &form, d).expression(arena)
        }
        _ => arena.rebuilt(expr, &mut parts),
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
        let power = count(d).min(count(inverse));
        let mut left = [power, power];
        let kept = monomial.iter().copied().filter(|atom| {
            let which = [d, inverse].iter().position(|known| known == atom);
            let Some(left) = which.map(|k| &mut left[k]) else { return true };
            let keep = *left == 0;
            *left = left.saturating_sub(1);
            keep
        });
        result.add_term(kept.collect(), c);
    }
    result
}

/// `Psi`, its tensors and traces, with `1/D` as an atom; what is not used goes later.
pub(super) fn definitions(arena: &mut Arena, chart: &Chart, inverse: Expr) -> Vec<(Expr, Polynomial)> {
    let n = chart.dim;
    let psi = unit_placement(arena, n);
    let mut list = Vec::new();
    for (i, a) in pairs(n) {
        list.push((psi.0[i][a], Polynomial::monomial([inverse, chart.phi.0[i][a]])));
    }
    let psi = psi.atoms();
    let squares = squares(arena, n, UNIT_SQUARES);
    let tensors = [Base::Green, Base::Finger].map(|base: fn(usize, usize) -> Base| -> Square<Polynomial> {
        table(n, |a, b| Polynomial::atom(base(a, b).unit(arena)))
    });
    for (tensor, square) in tensors.iter().zip(&squares) {
        list.extend(definitions_of_square(tensor, square));
    }
    for (a, b) in upper(n) {
        list.push((Base::Green(a, b).unit(arena), green(&psi, a, b)));
        list.push((Base::Finger(a, b).unit(arena), finger(&psi, a, b)));
    }
    let symbols = Base::TRACES.map(|base| base.unit(arena));
    list.extend(symbols.into_iter().zip(traces(&tensors[0], &squares[0])));
    list
}

/// `Psi` as symbols.
pub(super) fn unit_placement(arena: &mut Arena, n: usize) -> Matrix {
    let entry = |i, a| Base::Placement(i, a).unit(arena);
    Matrix(table(n, entry))
}
