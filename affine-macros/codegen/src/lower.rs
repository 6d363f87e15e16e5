//! From what the user wrote to symbolic terms: the last place where the specification's syntax is known.

mod base_functions;
mod components;
mod constant;
mod domain;
mod metrics;
mod momentum_side;
mod potential;
mod traces;

use crate::algebra::{Arena, Expr, Matrix, Rational};
use crate::mechanics::custom::{By, Class, Custom, On, Role};
use crate::mechanics::dissipation::Dissipation;
use crate::mechanics::forces::Forces;
use crate::mechanics::metrics::{Metrics, Rebased};
use crate::mechanics::term::{Coefficient, Frame, Term};
use crate::spec::{self, Expression, ExpressionKind, Operator, Spec, Value};
use crate::symbol::Symbol;

pub(crate) use base_functions::{difference_of, energy};
pub use constant::{LARGEST_POWER, constant, integer};
pub use metrics::metrics;
pub use momentum_side::stated;
pub use potential::{PotentialEnergy, potential};

/// Does the expression depend on more than fields?
pub(crate) fn moves(arena: &Arena, expr: Expr) -> bool {
    arena.any_symbol(expr, &mut |symbol| !arena.is_parameter(symbol))
}

/// The terms of a quadratic form in dimension `n` that are not exactly zero, each with its place in `written`.
pub fn terms(arena: &mut Arena, n: usize, written: &[spec::Term]) -> Vec<(usize, Term)> {
    written
        .iter()
        .enumerate()
        .filter(|(_, term)| {
            !term.value.expressions().all(|e| constant(e, n).is_some_and(|value| value.is_zero()))
        })
        .filter_map(|(place, term)| {
            let value = coefficient(arena, n, &term.value)?;
            Some((place, Term { kind: term.kind.value, value }))
        })
        .collect()
}

/// The forces besides those of the potential, for a kinetic energy that is constant in the frame `own`; matrices that
/// `prepare()` carries to orthonormal bases are added to `rebased`.
pub fn forces(
    arena: &mut Arena,
    spec: &Spec,
    own: Frame,
    metrics: Option<&Metrics>,
    rebased: &mut Vec<Rebased>,
) -> Forces {
    let n = spec.dim.value;
    let stated: Vec<Term> = terms(arena, n, &spec.dissipation).into_iter().map(|(_, term)| term).collect();
    let damping = match metrics {
        Some(metrics) => metrics.orthonormal(arena, &stated, rebased),
        None => stated.clone(),
    };
    let mut dissipation = (!damping.is_empty()).then(|| Dissipation::new(arena, n, own, &damping));
    if let (Some(metrics), Some(dissipation)) = (metrics, &mut dissipation) {
        dissipation.decide_by(arena, metrics, &stated);
    }
    let mut customs: Vec<Custom> =
        spec.customs.iter().enumerate().map(|(k, custom)| custom_field(k + 1, custom)).collect();
    for gravity in &spec.self_gravity {
        if let Some(strength) = expression(arena, n, &gravity.strength) {
            customs.push(Custom::self_gravity(customs.len() + 1, strength));
        }
    }
    Forces { dissipation, customs, driven: false, accounted: false }
}

fn custom_field(place: usize, written: &spec::Custom) -> Custom {
    let is = |mark: spec::Mark| written.mark == Some(mark);
    let force = |on: On| Role::Force {
        on,
        gyroscopic: is(spec::Mark::Gyroscopic),
        at_rest: is(spec::Mark::Position),
    };
    let potential = |class: Class| Role::Potential { class, moves: is(spec::Mark::Position) };
    let role = match written.role.value {
        spec::Role::Spatial => force(On::Space),
        spec::Role::Comoving => force(On::Body),
        spec::Role::Translation => force(On::Centre),
        spec::Role::Isotropic => potential(Class::Isotropic),
        spec::Role::Green => potential(Class::Green),
        spec::Role::Finger => potential(Class::Finger),
        spec::Role::General => potential(Class::General),
    };
    Custom { place, name: written.field.to_string(), role, by: By::Field }
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
        ExpressionKind::Symbol(name) => Some(arena.symbol(Symbol::Field(name.to_string()))),
        // One symbol for both triangles: `prepare()` refuses a field that is not symmetric.
        ExpressionKind::FieldEntry(field, row, column) => {
            Some(arena.symbol(Symbol::Entry(field.to_string(), *row.min(column), *row.max(column))))
        }
        ExpressionKind::Negate(a) => {
            let a = of(a)?;
            Some(arena.neg(a))
        }
        ExpressionKind::Binary(Operator::Power, a, exponent) => {
            let a = of(a)?;
            arena.pow(a, i32::try_from(constant(exponent, n)?.to_i64()?).ok()?)
        }
        ExpressionKind::Binary(operator, a, b) => {
            let (a, b) = (of(a)?, of(b)?);
            combined(arena, *operator, a, b)
        }
        ExpressionKind::Call(..)
        | ExpressionKind::Trace(_)
        | ExpressionKind::PolynomialTrace(_)
        | ExpressionKind::Matrix(_)
        | ExpressionKind::InverseTrace(_)
        | ExpressionKind::Entry(..)
        | ExpressionKind::Component(_)
        | ExpressionKind::Norm
        | ExpressionKind::Pairs(_) => None,
    }
}

/// What an operator makes of two values; nothing of a power, whose exponent is read as a number.
fn combined(arena: &mut Arena, operator: Operator, a: Expr, b: Expr) -> Option<Expr> {
    match operator {
        Operator::Add => Some(arena.add(a, b)),
        Operator::Subtract => Some(arena.sub(a, b)),
        Operator::Multiply => Some(arena.mul(a, b)),
        Operator::Divide => arena.div(a, b),
        Operator::Power => None,
    }
}
