//! Rules on the potential energy as written.

use super::symbols::names;
use crate::algebra::{Arena, Function, Rational};
use crate::diagnostics::{Diagnostics, PotentialMistake};
use crate::lower;
use crate::mechanics::potential::stretches::vanishes;
use crate::spec::{Expression, ExpressionKind, MatrixName, Spec, Symbol};

/// `d` is the difference of the two log-stretches of a pair: elsewhere there is no pair.
pub(super) fn differences(spec: &Spec, found: &mut Diagnostics) {
    let mut pending: Vec<&Expression> = energy(spec).collect();
    while let Some(part) = pending.pop() {
        match &part.kind {
            ExpressionKind::Pairs(_) => {}
            ExpressionKind::Symbol(name)
                if matches!(spec.resolve_in_potential(name), Some(Symbol::Difference)) =>
            {
                found.report(name.span(), PotentialMistake::LooseDifference);
            }
            _ => pending.extend(part.operands().into_iter().rev()),
        }
    }
}

/// The energy is a number: of a matrix it takes a trace or an entry, of the place of the centre its norm or a
/// coordinate.
pub(super) fn scalar(spec: &Spec, found: &mut Diagnostics) {
    for name in energy(spec).flat_map(names) {
        let (meaning, instead) = match spec.resolve_in_potential(name) {
            Some(Symbol::Matrix(MatrixName::Green)) => ("a matrix", "`tr(G)`, `tr(G*G)` or `G[1,2]`"),
            Some(Symbol::Matrix(MatrixName::Finger)) => ("a matrix", "`tr(Ct)`, `tr(Ct*Ct)` or `Ct[1,2]`"),
            Some(Symbol::Matrix(MatrixName::Placement)) => ("a matrix", "`tr(phi)` or `phi[1,2]`"),
            Some(Symbol::Centre) => ("a vector", "`norm(x)` or `x[1]`"),
            _ => continue,
        };
        found.report(name.span(), PotentialMistake::NotScalar { name: name.to_string(), meaning, instead });
    }
}

/// Rows, columns, coordinates, invariants and stretches are counted from 1 to n, as in the paper.
pub(super) fn indices(spec: &Spec, found: &mut Diagnostics) {
    let n = spec.dim.value;
    for part in energy(spec).flat_map(parts) {
        let (written, indices) = match &part.kind {
            ExpressionKind::Entry(_, row, column) => (part.to_string(), vec![*row, *column]),
            ExpressionKind::Component(index) => (part.to_string(), vec![*index]),
            ExpressionKind::Symbol(name) => match spec.resolve_in_potential(name) {
                Some(Symbol::Invariant(index) | Symbol::Stretch(index)) => (name.to_string(), vec![index]),
                _ => continue,
            },
            _ => continue,
        };
        if let Some(index) = indices.into_iter().find(|index| !(1..=n).contains(index)) {
            found.report(part.span, PotentialMistake::IndexRange { written, index, n });
        }
    }
}

/// Without a translational kinetic energy the centre is fixed in space and x is not part of the state.
pub(super) fn centre(spec: &Spec, found: &mut Diagnostics) {
    if spec.translation().is_some() {
        return;
    }
    for part in energy(spec).flat_map(parts) {
        if matches!(part.kind, ExpressionKind::Component(_) | ExpressionKind::Norm) {
            found.report(part.span, PotentialMistake::FixedCentre { form: part.to_string() });
        }
    }
}

/// Real logarithms are of positive numbers, and a square root is smooth only there. Arguments that depend on
/// the state or on fields are left to the run.
pub(super) fn in_domain(spec: &Spec, found: &mut Diagnostics) {
    for part in energy(spec).flat_map(parts) {
        let ExpressionKind::Call(function @ (Function::Ln | Function::Sqrt), argument) = &part.kind else {
            continue;
        };
        if let Some(value) = known(spec, argument).filter(|value| value.is_zero() || value.is_negative()) {
            let (function, argument, value) = (function.name(), argument.to_string(), value.to_string());
            found.report(part.span, PotentialMistake::Domain { function, argument, value });
        }
    }
}

/// The value of a part that is the same in every state: a number, or zero.
fn known(spec: &Spec, part: &Expression) -> Option<Rational> {
    let mut arena = Arena::new();
    let difference = lower::difference_of(&mut arena, 0, 1);
    let value = lower::energy(&mut arena, spec, part, Some(difference)).ok()?;
    let zero = vanishes(&mut arena, spec.dim.value, value, None).then_some(Rational::ZERO);
    arena.as_constant(value).cloned().or(zero)
}

pub(super) fn energy(spec: &Spec) -> impl Iterator<Item = &Expression> {
    spec.potential.iter().map(|potential| &potential.energy)
}

/// The expression and everything in it, from left to right.
pub(super) fn parts(expression: &Expression) -> Vec<&Expression> {
    let mut parts = vec![expression];
    parts.extend(expression.operands().into_iter().flat_map(self::parts));
    parts
}
