//! An expression of a potential in base functions of the placement, the time and the fields.

use super::components;
use super::traces::{self, entry};
use super::{Lowered, NoValue, arithmetic};
use crate::algebra::arena::Node;
use crate::algebra::ring::above_diagonal;
use crate::algebra::{Arena, Expr, Function, Rational};
use crate::mechanics::potential::Base;
use crate::spec::{Expression, ExpressionKind, Spec, numbered};
use crate::symbol::{Aspect, Quantity, Symbol};

/// The symbolic value of a part of a potential, with `difference` for `d`.
///
/// # Errors
/// [`NoValue`] where it divides by zero, and for other forms than a part of a potential has.
pub(crate) fn energy(arena: &mut Arena, spec: &Spec, e: &Expression, difference: Option<Expr>) -> Lowered {
    let given = spec.metrics.iter().any(Option::is_some);
    value(arena, spec.dim.value, e, Reading { difference, given, ..Reading::default() })
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

pub(super) fn value(arena: &mut Arena, n: usize, e: &Expression, reading: Reading) -> Lowered {
    let of = |arena: &mut Arena, operand: &Expression| value(arena, n, operand, reading);
    let component = |arena: &mut Arena, base: Base| {
        if reading.given { components::symbol(arena, base) } else { base.symbol(arena) }
    };
    let from_zero = |index: usize| index.checked_sub(1).ok_or(NoValue::Malformed);
    match &e.kind {
        ExpressionKind::Symbol(name) if name == "d" => reading.difference.ok_or(NoValue::Malformed),
        ExpressionKind::Symbol(name) if name != "n" => {
            symbol(arena, n, &name.to_string()).ok_or(NoValue::Malformed)
        }
        ExpressionKind::Call(function, a) => {
            let a = of(arena, a)?;
            Ok(applied(arena, *function, a))
        }
        ExpressionKind::Trace(_) | ExpressionKind::PolynomialTrace(_) => trace(arena, n, e, reading),
        ExpressionKind::InverseTrace(_) => {
            let [above, below] = [n.saturating_sub(1), n].map(|k| symbol(arena, n, &format!("I{k}")));
            above.zip(below).and_then(|(above, below)| arena.div(above, below)).ok_or(NoValue::Malformed)
        }
        ExpressionKind::Entry(matrix, row, column) => {
            Ok(component(arena, entry(*matrix, from_zero(*row)?, from_zero(*column)?)))
        }
        ExpressionKind::Component(index) => Ok(component(arena, Base::Position(from_zero(*index)?))),
        ExpressionKind::Norm => {
            let x = arena.components(Quantity::Position, n);
            let squares: Vec<_> = x.into_iter().map(|x| (arena.mul(x, x), Rational::ONE)).collect();
            let square = arena.linear(&squares);
            Ok(arena.apply(Function::Sqrt, square))
        }
        ExpressionKind::Pairs(f) => {
            let mut terms = Vec::new();
            for (a, b) in above_diagonal(n) {
                let difference = Some(difference_of(arena, a, b));
                terms.push((value(arena, n, f, Reading { difference, ..reading })?, Rational::ONE));
            }
            Ok(arena.linear(&terms))
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
fn trace(arena: &mut Arena, n: usize, e: &Expression, reading: Reading) -> Lowered {
    if let (true, ExpressionKind::PolynomialTrace(trace)) = (reading.multiplied_out, &e.kind) {
        return value(arena, n, trace.products.as_ref().ok_or(NoValue::Malformed)?, reading);
    }
    // Traces within traces are numbers among others.
    let inside = Reading { named: &[], ..reading };
    let trace = traces::value(arena, n, e, &|arena, part| value(arena, n, part, inside))?;
    Ok(reading.named.iter().find(|(known, _)| *known == trace).map_or(trace, |(_, symbol)| *symbol))
}
