//! A potential on the group that a constraint leaves: base functions that are constant there, or functions of `q`.

use crate::algebra::substitute::listed;
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
    let mut values = Vec::new();
    for base in Base::all(dim) {
        let weight = match (base, group) {
            (Base::MeanLogStretch, _) => None,
            (Base::Position(_) | Base::Placement(..), _) | (_, Constraint::Isochoric) => continue,
            (Base::LogStretch(_), _) => None,
            (Base::Trace(_), _) => Some(dim),
            (Base::Green(a, b) | Base::Finger(a, b), _) => Some(usize::from(a == b)),
        };
        let value = weight.map_or(q, |weight| {
            let argument = arena.scale(q, &Rational::whole(base.degree()));
            let power = arena.apply(Function::Exp, argument);
            arena.scale(power, &Rational::whole(weight))
        });
        values.push((base.symbol(arena), value));
    }
    arena.substitute(energy, &listed(&values))
}
