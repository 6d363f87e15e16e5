//! Exact values of expressions without fields.

use crate::algebra::Rational;
use crate::spec::{Expression, ExpressionKind, Operator};

/// The largest exponent that is evaluated. No kinetic energy has more than a few powers, and the polynomials in
/// the fields that the derivation multiplies out grow with this degree.
pub const LARGEST_POWER: u64 = 16;

/// The exact value of an expression in dimension `n`; `None` where it depends on a field or on the
/// state, or has none.
pub fn constant(expression: &Expression, n: usize) -> Option<Rational> {
    let value = |operand: &Expression| constant(operand, n);
    match &expression.kind {
        ExpressionKind::Number(number) => Some(number.clone()),
        ExpressionKind::Symbol(name) if name == "n" => i64::try_from(n).ok().map(Rational::from),
        ExpressionKind::Negate(one) => Some(-&value(one)?),
        ExpressionKind::Binary(operator, left, right) => match operator {
            Operator::Add => Some(&value(left)? + &value(right)?),
            Operator::Subtract => Some(&value(left)? - &value(right)?),
            Operator::Multiply => Some(&value(left)? * &value(right)?),
            Operator::Divide => value(left)?.checked_div(&value(right)?),
            Operator::Power => value(left)?.pow(integer(right, n)?),
        },
        // A function of a number has no exact value in general, and the others depend on fields or on the state.
        _ => None,
    }
}

/// The value of an exponent: an integer of moderate size.
pub fn integer(exponent: &Expression, n: usize) -> Option<i32> {
    let value = constant(exponent, n)?.to_i64()?;
    (value.unsigned_abs() <= LARGEST_POWER).then(|| i32::try_from(value).ok()).flatten()
}
