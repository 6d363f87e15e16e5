//! A potential on the group that a constraint leaves: base functions that are constant there, or functions of `q`.

use crate::algebra::{Arena, Expr, Function, Rational};
use crate::mechanics::constraint::Constraint;

use super::Base;

/// The energy on the group: `q = 0` where `det phi = 1`; `G = Ct = exp(2q) 1` where `phi` is a rotation up to scale.
/// `None` where it has no value there, such as `1/q` of an isochoric motion.
pub(super) fn restricted(arena: &mut Arena, dim: usize, energy: Expr, group: Constraint) -> Option<Expr> {
    let q = match group {
        Constraint::Conformal => Base::MeanLogStretch.symbol(arena),
        Constraint::Isochoric | Constraint::Rigid => arena.constant(Rational::ZERO),
    };
    let n = Rational::from(i64::try_from(dim).ok()?);
    let mut values = Vec::new();
    for base in Base::all(dim) {
        let value = match (base, group) {
            (Base::MeanLogStretch, _) => q,
            (Base::Position(_) | Base::Placement(..), _) | (_, Constraint::Isochoric) => continue,
            (Base::LogStretch(_), _) => q,
            (Base::Trace, _) => multiple(arena, q, 2, &n),
            (Base::TraceOfSquare, _) => multiple(arena, q, 4, &n),
            (Base::TraceOfCube, _) => multiple(arena, q, 6, &n),
            (Base::Green(a, b) | Base::Finger(a, b), _) => {
                multiple(arena, q, 2, &Rational::from(i64::from(a == b)))
            }
        };
        values.push((base.symbol(arena), value));
    }
    let value = |symbol: Expr| values.iter().find(|(s, _)| *s == symbol).map(|(_, value)| *value);
    arena.substitute(energy, &value)
}

/// `weight exp(k q)`.
fn multiple(arena: &mut Arena, q: Expr, k: i64, weight: &Rational) -> Expr {
    let argument = arena.scale(q, &Rational::from(k));
    let power = arena.apply(Function::Exp, argument);
    arena.scale(power, weight)
}
