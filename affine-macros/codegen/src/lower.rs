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
use crate::algebra::fault::never_missing;
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

/// Why an expression has no value.
#[derive(Clone, Debug)]
pub enum NoValue {
    /// This part of it is divided by, and is zero.
    ZeroDivisor(Expression),
    /// It is nothing that has a value, which a check refuses by a name of its own.
    Malformed,
}

/// The value of an expression.
pub type Lowered = Result<Expr, NoValue>;

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
        .map(|(place, term)| {
            (place, Term { kind: term.kind.value, value: coefficient(arena, n, &term.value) })
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
        customs.push(Custom::self_gravity(customs.len() + 1, certain(arena, n, &gravity.strength)));
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

fn coefficient(arena: &mut Arena, n: usize, value: &Value) -> Coefficient {
    match value {
        Value::Scalar(e) => Coefficient::Scalar(certain(arena, n, e)),
        Value::Diagonal(entries) => {
            let zero = arena.constant(Rational::ZERO);
            let entries: Vec<Expr> = entries.iter().map(|e| certain(arena, n, e)).collect();
            Coefficient::Matrix(Matrix(table(entries.len(), |i, j| if i == j { entries[i] } else { zero })))
        }
        Value::Matrix(rows) => {
            let row = |row: &Vec<Expression>| row.iter().map(|e| certain(arena, n, e)).collect();
            Coefficient::Matrix(Matrix(rows.iter().map(row).collect()))
        }
    }
}

/// The symbolic value of a coefficient that was checked.
fn certain(arena: &mut Arena, n: usize, e: &Expression) -> Expr {
    let value = expression(arena, n, e).ok();
    never_missing(value, "what the checks let through has a value", arena.constant(Rational::ZERO))
}

/// The symbolic value of a coefficient.
///
/// # Errors
/// [`NoValue`] where it divides by zero, and for the forms that only potentials have.
pub(crate) fn expression(arena: &mut Arena, n: usize, e: &Expression) -> Lowered {
    match &e.kind {
        ExpressionKind::Symbol(name) if name != "n" => Ok(arena.symbol(Symbol::Field(name.to_string()))),
        // One symbol for both triangles: `prepare()` refuses a field that is not symmetric.
        ExpressionKind::FieldEntry(field, row, column) => {
            Ok(arena.symbol(Symbol::Entry(field.to_string(), *row.min(column), *row.max(column))))
        }
        _ => arithmetic(arena, n, e, &|arena, operand| expression(arena, n, operand)),
    }
}

/// The value of an expression without fields, or of what an operator makes of others, by their values.
fn arithmetic(
    arena: &mut Arena,
    n: usize,
    e: &Expression,
    of: &dyn Fn(&mut Arena, &Expression) -> Lowered,
) -> Lowered {
    if let Some(value) = constant(e, n) {
        return Ok(arena.constant(value));
    }
    match &e.kind {
        ExpressionKind::Negate(a) => {
            let a = of(arena, a)?;
            Ok(arena.neg(a))
        }
        ExpressionKind::Binary(Operator::Power, base, exponent) => {
            let a = of(arena, base)?;
            let exponent = constant(exponent, n).ok_or(NoValue::Malformed)?;
            match (exponent.to_i64().and_then(|k| i32::try_from(k).ok()), arena.node(a)) {
                (Some(k), _) => arena.pow(a, k).ok_or_else(|| zero_divisor(base)),
                // exp(u)^k = exp(k u): of det, D, I_n and stretches, which are positive.
                (None, &Node::Function(Function::Exp, logarithm)) => {
                    let logarithm = arena.scale(logarithm, &exponent);
                    Ok(arena.apply(Function::Exp, logarithm))
                }
                (None, _) => Err(NoValue::Malformed),
            }
        }
        ExpressionKind::Binary(operator, left, right) => {
            let (a, b) = (of(arena, left)?, of(arena, right)?);
            match operator {
                Operator::Add => Ok(arena.add(a, b)),
                Operator::Subtract => Ok(arena.sub(a, b)),
                Operator::Multiply => Ok(arena.mul(a, b)),
                Operator::Divide => arena.div(a, b).ok_or_else(|| zero_divisor(right)),
                Operator::Power => Err(NoValue::Malformed),
            }
        }
        _ => Err(NoValue::Malformed),
    }
}

fn zero_divisor(divisor: &Expression) -> NoValue {
    NoValue::ZeroDivisor(divisor.clone())
}
