//! Products with numbers that are no doubles, as quotients.
//!
//! Which way `v` times the double next to `p/q` is rounded depends on the leading digits of `v`, always alike, for the digits
//! of `p/q` repeat: of the products with `5/6` every sixth lies a hair above the middle between two doubles, and goes up.
//! Taylor coefficients of different orders then err by different factors, each the same in every step, and the energy
//! drifts. `v p / q` is rounded without a preference, and so is `v/(q/p)` by a reciprocal in two parts, which takes a fraction
//! of the time: recurrences have that, order by order, and the start of a step quotients.

use crate::algebra::Rational;

use super::super::{Op, Program, Value};

/// The program with `v p / q` for `v (p/q)`, where `p` and `q` are doubles and `p/q` is none.
pub(super) fn divided(program: &Program) -> Program {
    let mut result = Program::default();
    let mut place: Vec<Value> = Vec::with_capacity(program.steps.len());
    for step in &program.steps {
        let value = match *step {
            Op::Mul(a, b) => match split(program, a, b) {
                Some((factor, parts)) => quotient(&mut result, place[factor], parts),
                None => push(&mut result, step.renumbered(&place)),
            },
            Op::MulAdd(a, b, c) => match split(program, a, b) {
                Some((factor, parts)) => {
                    let product = quotient(&mut result, place[factor], parts);
                    push(&mut result, Op::Add(product, place[c]))
                }
                None => push(&mut result, step.renumbered(&place)),
            },
            _ => push(&mut result, step.renumbered(&place)),
        };
        place.push(value);
    }
    result.ending_as(program, &place)
}

/// Of two factors the one that is no such number, and numerator and denominator of the other.
fn split(program: &Program, a: Value, b: Value) -> Option<(Value, [Rational; 2])> {
    let parts = |value: Value| match &program.steps[value] {
        Op::Constant(number) => parts(number),
        _ => None,
    };
    parts(b).map(|found| (a, found)).or_else(|| parts(a).map(|found| (b, found)))
}

/// Products with the number take a quotient.
pub(super) fn is_quotient(number: &Rational) -> bool {
    parts(number).is_some()
}

/// Numerator and denominator, where both are doubles and the number is none.
fn parts(number: &Rational) -> Option<[Rational; 2]> {
    let (numerator, denominator) = number.parts();
    let parts = [Rational::quotient(numerator, 1.into())?, Rational::quotient(denominator, 1.into())?];
    let is_double = |number: &Rational| number.fits_a_double() && number.to_doubles().1 == 0.0;
    (!is_double(number) && parts.iter().all(is_double)).then_some(parts)
}

fn quotient(program: &mut Program, factor: Value, [numerator, denominator]: [Rational; 2]) -> Value {
    let product = if numerator.is_one() {
        factor
    } else {
        let numerator = push(program, Op::Constant(numerator));
        push(program, Op::Mul(factor, numerator))
    };
    let denominator = push(program, Op::Constant(denominator));
    push(program, Op::Div(product, denominator))
}

/// Appends a step; a number that is there already is found.
fn push(program: &mut Program, op: Op) -> Value {
    let known = match op {
        Op::Constant(_) => program.steps.iter().position(|step| *step == op),
        _ => None,
    };
    known.unwrap_or_else(|| {
        program.steps.push(op);
        program.steps.len() - 1
    })
}
