//! Arithmetic that has an exact value.

use num_bigint::BigInt;

use super::size::{of_potential, summands};
use crate::algebra::fault::{never_missing, record};
use crate::algebra::{Arena, Function, Rational};
use crate::diagnostics::{Diagnostic, Diagnostics, ExpressionMistake, PotentialMistake, Reported};
use crate::lower::{self, LARGEST_POWER, Lowered, NoValue, constant, integer};
use crate::mechanics::potential::stretches::vanishes;
use crate::spec::{Expression, ExpressionKind, Operator, Spec, numbered};

/// The largest degree of a potential. Its functions are not multiplied out, so it may be higher than that of a
/// coefficient; `(sigma/r)^12` has degree 24.
const LARGEST_POTENTIAL_DEGREE: u64 = 64;

/// Where an expression stands.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Place {
    Coefficient,
    Potential,
}

impl Place {
    fn largest_degree(self) -> u64 {
        match self {
            Self::Coefficient => LARGEST_POWER,
            Self::Potential => LARGEST_POTENTIAL_DEGREE,
        }
    }
}

/// Every coefficient is a rational function of the fields with exact coefficients, and a potential is one of
/// its functions, fields and variables.
pub(super) fn computable(spec: &Spec, found: &mut Diagnostics) -> Result<(), Reported> {
    let mut result = Ok(());
    let placed = spec
        .coefficients()
        .map(|expression| (expression, Place::Coefficient))
        .chain(spec.potential.iter().map(|potential| (&potential.energy, Place::Potential)));
    for (expression, place) in placed {
        let size = match place {
            Place::Coefficient => summands(expression, spec.dim.value, found),
            Place::Potential => of_potential(expression, spec.dim.value, found),
        };
        if let Err(reported) = size {
            result = Err(reported);
            continue;
        }
        let computed = degree(expression, place, spec, found).and_then(|_| {
            value(&mut Arena::new(), expression, place, spec)
                .map_or_else(|why| no_value(why, found), |_| Ok(()))
        });
        result = computed.and(result);
    }
    result
}

/// The value of an expression, in a potential with the first pair of stretches for a difference.
fn value(arena: &mut Arena, expression: &Expression, place: Place, spec: &Spec) -> Lowered {
    match place {
        Place::Coefficient => lower::expression(arena, spec.dim.value, expression),
        Place::Potential => {
            let difference = lower::difference_of(arena, 0, 1);
            lower::energy(arena, spec, expression, Some(difference))
        }
    }
}

/// Says what has no value: a divisor that is zero; all else was refused by a name of its own.
pub(super) fn no_value(reason: NoValue, found: &mut Diagnostics) -> Result<(), Reported> {
    match reason {
        NoValue::ZeroDivisor(divisor) => {
            let mistake = ExpressionMistake::DivisionByZero { divisor: divisor.to_string() };
            return Err(found.report(divisor.span, mistake));
        }
        NoValue::Malformed if found.verdict().is_ok() => record("what the checks know has a value"),
        NoValue::Malformed => {}
    }
    Ok(())
}

/// The degree of an expression in its numbers, fields and variables, which bounds the digits of its exact
/// value: products add degrees and powers multiply them, and the value of a function counts as a variable. The
/// rules below are applied from the leaves upwards, so that what they evaluate is bounded already.
fn degree(
    expression: &Expression,
    place: Place,
    spec: &Spec,
    found: &mut Diagnostics,
) -> Result<u64, Reported> {
    // All operands before the first error is looked for, so that all are reported.
    let degrees: Vec<_> =
        expression.operands().into_iter().map(|operand| degree(operand, place, spec, found)).collect();
    let degrees: Vec<u64> = degrees.into_iter().collect::<Result<_, _>>()?;
    let degree = match &expression.kind {
        ExpressionKind::Binary(Operator::Power, base, exponent) => {
            let power = exponent_is_integer(base, exponent, place, spec.dim.value, found)?;
            let base_degree = never_missing(degrees.first().copied(), "a power has a base", 1);
            if power < 0 {
                divisor_is_not_zero(base, place, spec, found)?;
            }
            base_degree * u64::from(power.unsigned_abs())
        }
        ExpressionKind::Binary(Operator::Divide, _, divisor) => {
            divisor_is_not_zero(divisor, place, spec, found)?;
            degrees.iter().sum()
        }
        ExpressionKind::Binary(Operator::Multiply, ..) => degrees.iter().sum(),
        ExpressionKind::Trace(factors) => u64::try_from(factors.len()).unwrap_or(u64::MAX),
        // A quotient of two invariants.
        ExpressionKind::InverseTrace(_) => 2,
        ExpressionKind::Call(..) | ExpressionKind::Pairs(_) => 1,
        _ => degrees.iter().copied().max().unwrap_or(1),
    };
    degree_is_bounded(expression, degree, place, found)
}

/// Is the base positive, and a function of logarithmic stretches: `det`, `D`, `I2` for n = 2, `I3`, `Q1`?
fn is_exponential(base: &Expression, n: usize) -> bool {
    let ExpressionKind::Symbol(name) = &base.kind else { return false };
    let name = name.to_string();
    ["det", "D"].contains(&name.as_str())
        || name == format!("I{n}")
        || matches!(numbered(&name), Some(('Q', _)))
}

/// Integer exponents. The inverse of the kinetic energy is derived in rational functions of the coefficients,
/// and an exponent that is known only at run time would leave its degree open. In a potential a power with any
/// other exponent exists only for a positive base: one that is positive whatever the body does, such as `det`, or a logarithm or
/// a root, to be written as one.
fn exponent_is_integer(
    base: &Expression,
    exponent: &Expression,
    place: Place,
    n: usize,
    found: &mut Diagnostics,
) -> Result<i32, Reported> {
    if let Some(power) = integer(exponent, n) {
        return Ok(power);
    }
    let value = constant(exponent, n);
    if place == Place::Potential && value.as_ref().is_some_and(|k| !k.is_integer()) && is_exponential(base, n)
    {
        return Ok(1);
    }
    let mistake: Diagnostic = match (value.as_ref().filter(|value| value.is_integer()), place) {
        (Some(power), _) => ExpressionMistake::Degree {
            degree: power.to_string().trim_start_matches('-').to_owned(),
            limit: LARGEST_POWER,
        }
        .into(),
        (None, Place::Coefficient) => ExpressionMistake::Exponent { exponent: exponent.to_string() }.into(),
        (None, Place::Potential) => {
            let instead = as_function(base, exponent, n);
            let (base, exponent) = (base.to_string(), exponent.to_string());
            PotentialMistake::PotentialExponent { base, exponent, instead }.into()
        }
    };
    Err(found.report(exponent.span, mistake))
}

/// The same power as a root or an exponential; `None` where its base is a number without such a power. An odd root of a
/// negative number is that of its size, with a sign.
fn as_function(base: &Expression, exponent: &Expression, n: usize) -> Option<String> {
    let value = constant(base, n);
    if value.as_ref().is_some_and(Rational::is_zero) {
        return None;
    }
    let Some(size) = value.filter(Rational::is_negative).map(|value| -&value) else {
        return Some(of_positive(base.clone(), exponent, n));
    };
    let is_odd = |count: BigInt| count.bit(0);
    let (numerator, denominator) = constant(exponent, n)?.parts();
    let sign = if is_odd(numerator) { "-" } else { "" };
    let size = Expression { kind: ExpressionKind::Number(size), span: base.span };
    is_odd(denominator).then(|| format!("{sign}{}", of_positive(size, exponent, n)))
}

/// That of a positive base.
fn of_positive(base: Expression, exponent: &Expression, n: usize) -> String {
    if constant(exponent, n) == Some(Rational::HALF) {
        return format!("sqrt({base})");
    }
    let span = base.span;
    let logarithm = Expression { kind: ExpressionKind::Call(Function::Ln, Box::new(base)), span };
    format!("exp({})", Operator::Multiply.apply(exponent.clone(), logarithm))
}

/// Exact numbers of high degree have more digits than a build has time for.
fn degree_is_bounded(
    expression: &Expression,
    degree: u64,
    place: Place,
    found: &mut Diagnostics,
) -> Result<u64, Reported> {
    let limit = place.largest_degree();
    if degree <= limit {
        return Ok(degree);
    }
    let degree = degree.to_string();
    Err(found.report(expression.span, ExpressionMistake::Degree { degree, limit }))
}

/// A divisor that is zero, as a number or whatever the fields and the state are; one that is zero for some values of the
/// fields is left to `prepare()`, and for some states to the run.
fn divisor_is_not_zero(
    divisor: &Expression,
    place: Place,
    spec: &Spec,
    found: &mut Diagnostics,
) -> Result<(), Reported> {
    let mut arena = Arena::new();
    match value(&mut arena, divisor, place, spec) {
        Ok(value) if vanishes(&mut arena, spec.dim.value, value, None) => {
            no_value(NoValue::ZeroDivisor(divisor.clone()), found)
        }
        _ => Ok(()),
    }
}
