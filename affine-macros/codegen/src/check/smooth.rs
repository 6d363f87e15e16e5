//! A potential is a smooth function of the placement: Hamilton's equations contain its derivative, their solutions are
//! unique and methods keep their order only then.
//!
//! The stretches are that only up to their order. A function of them is one of the placement if exchanging two changes
//! nothing, and then it is as smooth as it is as a function of the `q_a` (Ball, Duke Math. J. 51 (1984) 699).

use super::potential::{energy, parts};
use crate::algebra::arena::Node;
use crate::algebra::ring::above_diagonal;
use crate::algebra::{Arena, Expr, Function};
use crate::diagnostics::{Diagnostics, PotentialMistake};
use crate::lower;
use crate::mechanics::potential::stretches::{
    canonical, exchanged, is_stretched, singular_at_coincidence, vanishes,
};
use crate::spec::{Expression, ExpressionKind, Operator, Spec};
use crate::symbol::Quantity;

/// Every rule; a potential that breaks one of symmetry is not asked for more.
pub(super) fn potential(arena: &mut Arena, spec: &Spec, found: &mut Diagnostics) {
    let n = spec.dim.value;
    for written in energy(spec) {
        // The checks before have let it through.
        let Ok(value) = lower::energy(arena, spec, written, None) else { continue };
        // Without single stretches there is nothing to exchange, and traces stay as they are written.
        let stretched = is_stretched(arena, n, value);
        let value = if stretched { canonical(arena, n, value) } else { value };
        if stretched
            && !(even_in_differences(arena, spec, found) && symmetric(arena, n, written, value, found))
        {
            continue;
        }
        let absolute = has_absolute_value(arena, value);
        let singular = singular_at_coincidence(arena, n, value);
        if !absolute && singular.is_none() {
            continue;
        }
        let kinks = kinks(arena, spec, written, None);
        let innermost = kinks.into_iter().find(|kink| match kink {
            Kink::Absolute(_) => absolute,
            Kink::Coincidence(..) => singular.is_some(),
        });
        let (part, coincidence) = match (innermost, singular) {
            (Some(Kink::Absolute(part)), _) => (part, None),
            (Some(Kink::Coincidence(part, argument, stretches)), _) => {
                (part, Some((argument.to_string(), stretches)))
            }
            (None, Some((argument, (a, b)))) => (written, Some((arena.text(argument), (a + 1, b + 1)))),
            (None, None) => (written, None),
        };
        let written = part.to_string();
        let mistake = match coincidence {
            Some((argument, stretches)) => PotentialMistake::Coincidence { written, argument, stretches },
            None => PotentialMistake::NotSmooth { written },
        };
        found.report(part.span, mistake);
    }
}

/// `pairs(f(d))` sums over pairs whose order means nothing: `f(d) = f(-d)`.
fn even_in_differences(arena: &mut Arena, spec: &Spec, found: &mut Diagnostics) -> bool {
    let n = spec.dim.value;
    let mut holds = true;
    for part in energy(spec).flat_map(parts) {
        let ExpressionKind::Pairs(f) = &part.kind else { continue };
        let d = lower::difference_of(arena, 0, 1);
        let opposite = arena.neg(d);
        let values = [d, opposite].map(|d| lower::energy(arena, spec, f, Some(d)));
        let [Ok(one), Ok(other)] = values.map(|value| value.map(|value| canonical(arena, n, value))) else {
            continue;
        };
        if one != other {
            holds = false;
            found.report(part.span, PotentialMistake::OddDifference { function: f.to_string() });
        }
    }
    holds
}

/// Unchanged under every exchange of two stretches.
fn symmetric(
    arena: &mut Arena,
    n: usize,
    written: &Expression,
    value: Expr,
    found: &mut Diagnostics,
) -> bool {
    for (a, b) in above_diagonal(n) {
        let other = exchanged(arena, n, value, a, b).map(|other| canonical(arena, n, other));
        if other != Some(value) {
            let energy = written.to_string();
            found.report(written.span, PotentialMistake::NotSymmetric { energy, stretches: (a + 1, b + 1) });
            return false;
        }
    }
    true
}

/// Is there an absolute value in `value` that depends on the state? Those of known sign are gone by now.
fn has_absolute_value(arena: &Arena, value: Expr) -> bool {
    let mut pending = vec![value];
    while let Some(expr) = pending.pop() {
        match arena.node(expr) {
            Node::Function(Function::Abs, argument) if moves(arena, *argument) => return true,
            _ => pending.extend(arena.parts(expr)),
        }
    }
    false
}

/// Does the expression change with the state? What changes with fields and the time alone is a factor of forces, and may
/// have kinks.
fn moves(arena: &Arena, expr: Expr) -> bool {
    let is_state = |symbol| arena.quantity(symbol) != Some(Quantity::Time) && !arena.is_parameter(symbol);
    arena.any_symbol(expr, &mut { is_state })
}

/// A place where smoothness ends, as written.
enum Kink<'a> {
    /// `abs(...)`.
    Absolute(&'a Expression),
    /// A root, a logarithm or a quotient, what vanishes in it, and the stretches, from 1, where they coincide.
    Coincidence(&'a Expression, &'a Expression, (usize, usize)),
}

/// Is the part an absolute value of what changes with the state, and its sign?
fn is_absolute(arena: &mut Arena, spec: &Spec, part: &Expression, difference: Option<Expr>) -> bool {
    let value = lower::energy(arena, spec, part, difference).ok().map(|value| arena.node(value));
    matches!(value, Some(Node::Function(Function::Abs, argument)) if moves(arena, *argument))
}

/// All such places, the inner ones first; `d` stands for `difference`.
fn kinks<'a>(
    arena: &mut Arena,
    spec: &Spec,
    part: &'a Expression,
    difference: Option<Expr>,
) -> Vec<Kink<'a>> {
    let n = spec.dim.value;
    let inner = match part.kind {
        ExpressionKind::Pairs(_) => Some(lower::difference_of(arena, 0, 1)),
        _ => difference,
    };
    let mut list: Vec<Kink> =
        part.operands().into_iter().flat_map(|operand| kinks(arena, spec, operand, inner)).collect();
    let vanishing = match &part.kind {
        // The root of a square is an absolute value too.
        ExpressionKind::Call(Function::Abs | Function::Sqrt, _)
            if is_absolute(arena, spec, part, difference) =>
        {
            list.push(Kink::Absolute(part));
            return list;
        }
        ExpressionKind::Call(Function::Abs, _) => return list,
        ExpressionKind::Call(Function::Sqrt | Function::Ln, argument)
        | ExpressionKind::Binary(Operator::Divide, _, argument)
        | ExpressionKind::Binary(Operator::Power, argument, _) => argument,
        _ => return list,
    };
    let singular_power = match &part.kind {
        ExpressionKind::Binary(Operator::Power, _, exponent) => {
            lower::constant(exponent, n).is_some_and(|k| k.is_negative())
        }
        _ => true,
    };
    if let Some(value) = lower::energy(arena, spec, vanishing, difference).ok().filter(|_| singular_power) {
        let pairs = above_diagonal(n);
        let found = pairs.into_iter().find(|pair| vanishes(arena, n, value, Some(*pair)));
        if let Some((a, b)) = found {
            list.push(Kink::Coincidence(part, vanishing, (a + 1, b + 1)));
        }
    }
    list
}
