//! Arithmetic that has an exact value.

use super::constant::{LARGEST_POWER, constant, integer};
use super::identity::vanishes;
use crate::algebra::Rational;
use crate::diagnostics::{Diagnostic, Diagnostics, Reported};
use crate::spec::{Expression, ExpressionKind, Spec};

/// Every coefficient is a rational function of the fields with exact coefficients.
pub(super) fn computable(spec: &Spec, found: &mut Diagnostics) -> Result<(), Reported> {
    let mut result = Ok(());
    for expression in spec.kinetic.iter().flat_map(|term| term.value.expressions()) {
        result = degree(expression, spec.dim.value, found).map(|_| ()).and(result);
    }
    result
}

/// The degree of an expression in its numbers and fields, which bounds the digits of its exact value: products
/// add degrees and powers multiply them. The rules below are applied from the leaves upwards, so that what they
/// evaluate is bounded already.
fn degree(expression: &Expression, n: usize, found: &mut Diagnostics) -> Result<u64, Reported> {
    // All operands before the first error is looked for, so that all are reported.
    let degrees: Vec<_> =
        expression.operands().into_iter().map(|operand| degree(operand, n, found)).collect();
    let degrees: Vec<u64> = degrees.into_iter().collect::<Result<_, _>>()?;
    let degree = match &expression.kind {
        ExpressionKind::Power(base, exponent) => {
            let power = exponent_is_integer(exponent, n, found)?;
            if power < 0 {
                divisor_is_not_zero(base, n, found)?;
            }
            degrees.iter().take(1).sum::<u64>() * u64::from(power.unsigned_abs())
        }
        ExpressionKind::Divide(_, divisor) => {
            divisor_is_not_zero(divisor, n, found)?;
            degrees.iter().sum()
        }
        ExpressionKind::Multiply(..) => degrees.iter().sum(),
        _ => degrees.iter().copied().max().unwrap_or(1),
    };
    degree_is_bounded(expression, degree, found)
}

/// Integer exponents: the inverse of the kinetic energy is derived in rational functions of the coefficients,
/// and an exponent that is known only at run time would leave its degree open.
fn exponent_is_integer(exponent: &Expression, n: usize, found: &mut Diagnostics) -> Result<i32, Reported> {
    if let Some(power) = integer(exponent, n) {
        return Ok(power);
    }
    let whole = constant(exponent, n).filter(Rational::is_integer);
    let mistake = match whole {
        Some(power) => Diagnostic::Degree {
            degree: power.to_i64().map_or(u64::MAX, i64::unsigned_abs),
            limit: LARGEST_POWER,
        },
        None => Diagnostic::Exponent { exponent: exponent.to_string() },
    };
    Err(found.report(exponent.span, mistake))
}

/// Exact numbers of high degree have more digits than a build has time for.
fn degree_is_bounded(expression: &Expression, degree: u64, found: &mut Diagnostics) -> Result<u64, Reported> {
    if degree <= LARGEST_POWER {
        return Ok(degree);
    }
    Err(found.report(expression.span, Diagnostic::Degree { degree, limit: LARGEST_POWER }))
}

/// A divisor that is zero, as a number or whatever the fields are; one that is zero for some values of the
/// fields is left to `prepare()`.
fn divisor_is_not_zero(divisor: &Expression, n: usize, found: &mut Diagnostics) -> Result<(), Reported> {
    if vanishes(divisor, n) {
        return Err(found.report(divisor.span, Diagnostic::DivisionByZero { divisor: divisor.to_string() }));
    }
    Ok(())
}
