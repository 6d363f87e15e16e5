//! From what the user wrote to symbolic terms: the last place where the specification's syntax is known.

mod base_functions;
mod components;
mod constant;
mod domain;
mod metrics;
mod momentum_side;
mod potential;
mod traces;

use crate::algebra::arena::Node;
use crate::algebra::ring::table;
use crate::algebra::{Arena, Expr, Function, Matrix, Rational};
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
            let entries = entries.iter().map(|e| expression(arena, n, e)).collect::<Option<Vec<Expr>>>()?;
            Coefficient::Matrix(Matrix(table(entries.len(), |i, j| if i == j { entries[i] } else { zero })))
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
    match &e.kind {
        ExpressionKind::Symbol(name) if name != "n" => Some(arena.symbol(Symbol::Field(name.to_string()))),
        // One symbol for both triangles: `prepare()` refuses a field that is not symmetric.
        ExpressionKind::FieldEntry(field, row, column) => {
            Some(arena.symbol(Symbol::Entry(field.to_string(), *row.min(column), *row.max(column))))
        }
        _ => arithmetic(arena, n, e, &|arena, operand| expression(arena, n, operand)),
    }
}

/// The value of an expression without fields, or of what an operator makes of others, by their values; `None` of all else.
fn arithmetic(
    arena: &mut Arena,
    n: usize,
    e: &Expression,
    of: &dyn Fn(&mut Arena, &Expression) -> Option<Expr>,
) -> Option<Expr> {
    if let Some(value) = constant(e, n) {
        return Some(arena.constant(value));
    }
    match &e.kind {
        ExpressionKind::Negate(a) => {
            let a = of(arena, a)?;
            Some(arena.neg(a))
        }
        ExpressionKind::Binary(Operator::Power, a, exponent) => {
            let a = of(arena, a)?;
            let exponent = constant(exponent, n)?;
            match (exponent.to_i64().and_then(|k| i32::try_from(k).ok()), arena.node(a)) {
                (Some(k), _) => arena.pow(a, k),
                // exp(u)^k = exp(k u): of det, D, I_n and stretches, which are positive.
                (None, &Node::Function(Function::Exp, logarithm)) => {
                    let logarithm = arena.scale(logarithm, &exponent);
                    Some(arena.apply(Function::Exp, logarithm))
                }
                (None, _) => None,
            }
        }
        ExpressionKind::Binary(operator, a, b) => {
            let (a, b) = (of(arena, a)?, of(arena, b)?);
            match operator {
                Operator::Add => Some(arena.add(a, b)),
                Operator::Subtract => Some(arena.sub(a, b)),
                Operator::Multiply => Some(arena.mul(a, b)),
                Operator::Divide => arena.div(a, b),
                Operator::Power => None,
            }
        }
        _ => None,
    }
}
