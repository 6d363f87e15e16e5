//! An expression of a potential in base functions of the placement, the time and the fields.

use super::arithmetic;
use super::components;
use super::traces::{self, entry};
use crate::algebra::arena::Node;
use crate::algebra::ring::above_diagonal;
use crate::algebra::{Arena, Expr, Function, Rational};
use crate::mechanics::potential::Base;
use crate::spec::{Expression, ExpressionKind, numbered};
use crate::symbol::{Aspect, Quantity, Symbol};

/// The symbolic value, with `difference` for `d`; `None` only for what the checks refuse.
pub(crate) fn energy(arena: &mut Arena, n: usize, e: &Expression, difference: Option<Expr>) -> Option<Expr> {
    value(arena, n, e, Reading { difference, ..Reading::default() })
}

/// How an expression is read.
#[derive(Clone, Copy, Default)]
pub(super) struct Reading<'a> {
    /// What `d` stands for.
    pub(super) difference: Option<Expr>,
    /// Are components told from those in orthonormal bases?
    pub(super) given: bool,
    /// Are traces of polynomials sums of traces of products?
    pub(super) multiplied_out: bool,
    /// Values of traces, and what stands for them.
    pub(super) named: &'a [(Expr, Expr)],
}

pub(super) fn value(arena: &mut Arena, n: usize, e: &Expression, reading: Reading) -> Option<Expr> {
    let of = |arena: &mut Arena, operand: &Expression| value(arena, n, operand, reading);
    let component = |arena: &mut Arena, base: Base| {
        if reading.given { components::symbol(arena, base) } else { base.symbol(arena) }
    };
    match &e.kind {
        ExpressionKind::Symbol(name) if name == "d" => reading.difference,
        ExpressionKind::Symbol(name) if name != "n" => symbol(arena, n, &name.to_string()),
        ExpressionKind::Call(function, a) => {
            let a = of(arena, a)?;
            Some(applied(arena, *function, a))
        }
        ExpressionKind::Trace(_) | ExpressionKind::PolynomialTrace(_) => trace(arena, n, e, reading),
        ExpressionKind::InverseTrace(_) => {
            let [above, below] = [n.checked_sub(1)?, n].map(|k| symbol(arena, n, &format!("I{k}")));
            arena.div(above?, below?)
        }
        ExpressionKind::Entry(matrix, row, column) => {
            Some(component(arena, entry(*matrix, row.checked_sub(1)?, column.checked_sub(1)?)))
        }
        ExpressionKind::Component(index) => Some(component(arena, Base::Position(index.checked_sub(1)?))),
        ExpressionKind::Norm => {
            let x = arena.components(Quantity::Position, n);
            let squares: Vec<_> = x.into_iter().map(|x| (arena.mul(x, x), Rational::ONE)).collect();
            let square = arena.linear(&squares);
            Some(arena.apply(Function::Sqrt, square))
        }
        ExpressionKind::Pairs(f) => {
            let mut terms = Vec::new();
            for (a, b) in above_diagonal(n) {
                let difference = Some(difference_of(arena, a, b));
                terms.push((value(arena, n, f, Reading { difference, ..reading })?, Rational::ONE));
            }
            Some(arena.linear(&terms))
        }
        // Matrices stand within traces only, and entries of fields have no notation.
        _ => arithmetic(arena, n, e, &of),
    }
}

/// `q_a - q_b`, counted from 0.
pub(crate) fn difference_of(arena: &mut Arena, a: usize, b: usize) -> Expr {
    let [left, right] = [a, b].map(|k| Base::LogStretch(k).symbol(arena));
    arena.sub(left, right)
}

/// A function of an argument; an absolute value of what keeps its sign is no function.
fn applied(arena: &mut Arena, function: Function, argument: Expr) -> Expr {
    let value = arena.apply(function, argument);
    let Node::Function(Function::Abs, of) = *arena.node(value) else { return value };
    match arena.sign(of, &is_positive) {
        Some(sign) if sign.negative => arena.neg(of),
        Some(_) => of,
        None => value,
    }
}

/// Traces and diagonal entries of `G` and `Ct` are positive.
pub(super) fn is_positive(symbol: &Symbol) -> bool {
    match symbol {
        Symbol::About(Aspect::Given, component) => is_positive(component),
        Symbol::Component(Quantity::Trace, _) => true,
        Symbol::Component(Quantity::Green | Quantity::Finger, entry) => entry.first() == entry.last(),
        _ => false,
    }
}

fn symbol(arena: &mut Arena, n: usize, name: &str) -> Option<Expr> {
    let q = Base::MeanLogStretch.symbol(arena);
    // exp(k q); det phi = exp(n q), so that one logarithm or one root serves all.
    let power = |arena: &mut Arena, k: usize| {
        let argument = arena.scale(q, &Rational::from(i64::try_from(k).ok()?));
        Some(arena.apply(Function::Exp, argument))
    };
    match name {
        "q" => Some(q),
        "t" => Some(arena.symbol(Quantity::Time)),
        "D" => power(arena, 1),
        "det" => power(arena, n),
        "I1" => Some(Base::Trace(1).symbol(arena)),
        // e_2 = ((tr G)^2 - tr G^2)/2
        "I2" if n == 3 => {
            let (first, second) = (Base::Trace(1).symbol(arena), Base::Trace(2).symbol(arena));
            let square = arena.mul(first, first);
            let half = Rational::HALF;
            Some(arena.linear(&[(square, half.clone()), (second, -&half)]))
        }
        // e_n = det G
        "I2" | "I3" => power(arena, 2 * n),
        name => match numbered(name) {
            Some(('q', a)) => Some(Base::LogStretch(a.checked_sub(1)?).symbol(arena)),
            Some(('Q', a)) => {
                let q = Base::LogStretch(a.checked_sub(1)?).symbol(arena);
                Some(arena.apply(Function::Exp, q))
            }
            _ => Some(arena.symbol(Symbol::Field(name.to_owned()))),
        },
    }
}

/// A trace, or what stands for it.
fn trace(arena: &mut Arena, n: usize, e: &Expression, reading: Reading) -> Option<Expr> {
    if let (true, ExpressionKind::PolynomialTrace(trace)) = (reading.multiplied_out, &e.kind) {
        return value(arena, n, trace.products.as_ref()?, reading);
    }
    // Traces within traces are numbers among others.
    let inside = Reading { named: &[], ..reading };
    let trace = traces::value(arena, n, e, &|arena, part| value(arena, n, part, inside))?;
    Some(reading.named.iter().find(|(known, _)| *known == trace).map_or(trace, |(_, symbol)| *symbol))
}
