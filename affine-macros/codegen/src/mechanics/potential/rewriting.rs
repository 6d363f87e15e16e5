//! Functions of `q` in the forms that right-hand sides and energies need.

use rustc_hash::FxHashMap;

use crate::algebra::arena::Node;
use crate::algebra::fault::never_missing;
use crate::algebra::rational::exponent;
use crate::algebra::{Arena, Expr, Function, Rational};
use crate::mechanics::potential::base::HIGHEST_MULTIPLE;
use crate::symbol::{Quantity, Symbol};

/// Of a logarithm `q` or `q_a` the exponential and its reciprocal.
fn exponentials(arena: &Arena, symbol: Expr) -> Option<[Symbol; 2]> {
    match arena.as_symbol(symbol)? {
        Symbol::Component(Quantity::MeanLogStretch, _) => {
            Some([Quantity::Dilatation, Quantity::InverseDilatation].map(Symbol::from))
        }
        Symbol::Component(Quantity::LogStretches, axis) => {
            let on_axis = |quantity| Symbol::Component(quantity, axis.clone());
            Some([Quantity::Stretches, Quantity::InverseStretch].map(on_axis))
        }
        _ => None,
    }
}

/// The logarithm and the integer `k` of `k q` or `k q_a`, where `k` is small enough for a power.
pub(super) fn multiple_of_logarithm(arena: &Arena, argument: Expr) -> Option<(Expr, i32)> {
    let is_logarithm = |e: Expr| exponentials(arena, e).is_some();
    if is_logarithm(argument) {
        return Some((argument, 1));
    }
    match arena.node(argument) {
        Node::Sum(constant, terms) if constant.is_zero() && terms.len() == 1 && is_logarithm(terms[0].0) => {
            let k = i32::try_from(terms[0].1.to_i64()?).ok()?;
            (k.unsigned_abs() <= HIGHEST_MULTIPLE).then_some((terms[0].0, k))
        }
        _ => None,
    }
}

/// Functions `exp`, `sinh`, `cosh` of integer multiples of `q` as powers of `D = exp(q)` and `1/D`, which cost one
/// root instead of a logarithm and an exponential each; those of `q_a` as powers of `Q_a` and `1/Q_a`.
pub(super) fn through_dilatation(arena: &mut Arena, expr: Expr) -> Expr {
    let power = |arena: &mut Arena, q: Expr, k: i32| {
        let none = || [Quantity::Dilatation, Quantity::InverseDilatation].map(Symbol::from);
        let [up, down] = never_missing(exponentials(arena, q), "only logarithms have multiples", none());
        let base = arena.symbol(if k > 0 { up } else { down });
        arena.power(base, exponent(k.unsigned_abs() as usize))
    };
    rewritten(arena, expr, &|arena, function, argument, exponent| {
        let (q, k) = multiple_of_logarithm(arena, argument)?;
        let half = Rational::HALF;
        match function {
            Function::Exp => Some(power(arena, q, k.checked_mul(exponent)?)),
            Function::Sinh | Function::Cosh => {
                let sign = if function == Function::Sinh { -&half } else { half.clone() };
                let (up, down) = (power(arena, q, k), power(arena, q, -k));
                let value = arena.linear(&[(up, half), (down, sign)]);
                arena.pow(value, exponent)
            }
            _ => None,
        }
    })
}

/// `exp(k q)` as a power of `D`, negative ones too; functions of `q_a` as they stand.
pub(super) fn exponential_of_dilatation(arena: &mut Arena, expr: Expr) -> Expr {
    let mean = arena.symbol(Quantity::MeanLogStretch);
    let d = arena.symbol(Quantity::Dilatation);
    rewritten(arena, expr, &|arena, function, argument, exponent| {
        let (q, k) = multiple_of_logarithm(arena, argument)?;
        if q != mean || function != Function::Exp {
            return None;
        }
        arena.pow(d, k.checked_mul(exponent)?)
    })
}

/// `exp(u) = 1 + 2 sinh(u/2)^2 + sinh(u)` and `cosh(u) = 1 + 2 sinh(u/2)^2` for `u = k q` and `u = k q_a`.
pub(super) fn about_undeformed(arena: &mut Arena, expr: Expr) -> Expr {
    rewritten(arena, expr, &|arena, function, argument, exponent| {
        let (q, k) = multiple_of_logarithm(arena, argument)?;
        if !matches!(function, Function::Exp | Function::Cosh) || exponent < 1 && function == Function::Cosh {
            return None;
        }
        // A power of an exponential is one exponential.
        let (k, exponent) =
            if function == Function::Exp { (k.checked_mul(exponent)?, 1) } else { (k, exponent) };
        let whole = arena.scale(q, &Rational::from(i64::from(k)));
        let half = arena.scale(q, &Rational::ratio(i64::from(k), 2)?);
        let half = arena.apply(Function::Sinh, half);
        let square = arena.mul(half, half);
        let one = arena.constant(Rational::ONE);
        let mut terms = vec![(one, Rational::ONE), (square, Rational::from(2))];
        if function == Function::Exp {
            terms.push((arena.apply(Function::Sinh, whole), Rational::ONE));
        }
        let value = arena.linear(&terms);
        arena.pow(value, exponent)
    })
}

/// Replaces powers of functions for which `value(function, argument, exponent)` knows better, from the inside out.
fn rewritten(arena: &mut Arena, expr: Expr, value: &Better) -> Expr {
    rewritten_once(arena, expr, value, &mut FxHashMap::default())
}

/// What knows better.
type Better<'a> = dyn Fn(&mut Arena, Function, Expr, i32) -> Option<Expr> + 'a;

/// The same with what became of the parts that were met before.
fn rewritten_once(arena: &mut Arena, expr: Expr, value: &Better, done: &mut FxHashMap<Expr, Expr>) -> Expr {
    if let Some(done) = done.get(&expr) {
        return *done;
    }
    let known = |arena: &mut Arena, base: Expr, exponent: i32| match *arena.node(base) {
        Node::Function(function, argument) => value(arena, function, argument, exponent),
        _ => None,
    };
    let rewritten = match arena.node(expr).clone() {
        Node::Product(factors) => {
            let mut product = Vec::new();
            for (base, exponent) in factors {
                product.push(match known(arena, base, exponent) {
                    Some(power) => (power, 1),
                    None => (rewritten_once(arena, base, value, done), exponent),
                });
            }
            // The bases were not the number zero, and keep their values.
            arena.certain_product(&product)
        }
        _ => known(arena, expr, 1).unwrap_or_else(|| {
            arena.rebuilt(expr, &mut |arena, part| rewritten_once(arena, part, value, done))
        }),
    };
    done.insert(expr, rewritten);
    rewritten
}
