//! From what the user wrote to symbolic terms: the last place where the specification's syntax is known.

mod metrics;
mod momentum_side;
mod potential;

use crate::algebra::{Arena, Expr, Matrix, Rational};
use crate::check::constant;
use crate::mechanics::constraint::Constraint;
use crate::mechanics::kinetic::{Coefficient, Term, TermKind};
use crate::spec::{self, Expression, ExpressionKind, Spec, Value};

pub use metrics::metrics;
pub use momentum_side::stated;
pub use potential::potential;
pub(crate) use potential::{difference_of, energy};

/// Stem of the symbols of fields: kept apart from the names that the derivation makes.
pub const FIELD: &str = "self.";

/// The terms of the kinetic energy that are not exactly zero, each with its place in `spec.kinetic`.
pub fn terms(arena: &mut Arena, spec: &Spec) -> Vec<(usize, Term)> {
    let n = spec.dim.value;
    spec.kinetic
        .iter()
        .enumerate()
        .filter(|(_, term)| {
            !term.value.expressions().all(|e| constant(e, n).is_some_and(|value| value.is_zero()))
        })
        .filter_map(|(place, term)| {
            let value = coefficient(arena, n, &term.value)?;
            Some((place, Term { kind: kind(term.kind.value), value }))
        })
        .collect()
}

/// The group that the motion is confined to.
#[must_use]
pub fn constraint(constraint: spec::Constraint) -> Constraint {
    match constraint {
        spec::Constraint::Isochoric => Constraint::Isochoric,
        spec::Constraint::Rigid => Constraint::Rigid,
        spec::Constraint::Conformal => Constraint::Conformal,
    }
}

fn kind(kind: spec::TermKind) -> TermKind {
    match kind {
        spec::TermKind::Casimir2 => TermKind::Casimir2,
        spec::TermKind::Casimir1Squared => TermKind::Casimir1Squared,
        spec::TermKind::BodyInertia => TermKind::BodyInertia,
        spec::TermKind::SpaceInertia => TermKind::SpaceInertia,
        spec::TermKind::BodyTranslation => TermKind::BodyTranslation,
        spec::TermKind::SpaceTranslation => TermKind::SpaceTranslation,
        spec::TermKind::Dalembert => TermKind::Dalembert,
        spec::TermKind::BodyTensor => TermKind::BodyTensor,
        spec::TermKind::SpaceTensor => TermKind::SpaceTensor,
        spec::TermKind::FlatTensor => TermKind::FlatTensor,
    }
}

fn coefficient(arena: &mut Arena, n: usize, value: &Value) -> Option<Coefficient> {
    Some(match value {
        Value::Scalar(e) => Coefficient::Scalar(expression(arena, n, e)?),
        Value::Diagonal(entries) => {
            let zero = arena.constant(Rational::ZERO);
            let mut rows = vec![vec![zero; entries.len()]; entries.len()];
            for (k, e) in entries.iter().enumerate() {
                rows[k][k] = expression(arena, n, e)?;
            }
            Coefficient::Matrix(Matrix(rows))
        }
        Value::Matrix(rows) => Coefficient::Matrix(Matrix(
            rows.iter()
                .map(|row| row.iter().map(|e| expression(arena, n, e)).collect())
                .collect::<Option<_>>()?,
        )),
    })
}

/// The symbolic value of a coefficient; `None` only for what the checks refuse (division by zero) and for the
/// forms that only potentials have.
pub(crate) fn expression(arena: &mut Arena, n: usize, e: &Expression) -> Option<Expr> {
    if let Some(value) = constant(e, n) {
        return Some(arena.constant(value));
    }
    let mut of = |operand: &Expression| expression(arena, n, operand);
    match &e.kind {
        ExpressionKind::Number(value) => Some(arena.constant(value.clone())),
        ExpressionKind::Symbol(name) => Some(arena.symbol(&format!("{FIELD}{name}"))),
        ExpressionKind::Negate(a) => {
            let a = of(a)?;
            Some(arena.neg(a))
        }
        ExpressionKind::Add(a, b) => {
            let (a, b) = (of(a)?, of(b)?);
            Some(arena.add(a, b))
        }
        ExpressionKind::Subtract(a, b) => {
            let (a, b) = (of(a)?, of(b)?);
            Some(arena.sub(a, b))
        }
        ExpressionKind::Multiply(a, b) => {
            let (a, b) = (of(a)?, of(b)?);
            Some(arena.mul(a, b))
        }
        ExpressionKind::Divide(a, b) => {
            let (a, b) = (of(a)?, of(b)?);
            arena.div(a, b)
        }
        ExpressionKind::Power(a, exponent) => {
            let a = of(a)?;
            arena.pow(a, i32::try_from(constant(exponent, n)?.to_i64()?).ok()?)
        }
        ExpressionKind::Call(..)
        | ExpressionKind::Trace(_)
        | ExpressionKind::Entry(..)
        | ExpressionKind::Component(_)
        | ExpressionKind::Norm
        | ExpressionKind::Pairs(_) => None,
    }
}
