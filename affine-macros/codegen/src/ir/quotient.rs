//! Quotients in place of reciprocals that one product alone takes.

use crate::algebra::Rational;

use super::{Op, Program, Value};

/// The program with `a / d` in place of `a (1/d)`, where nothing else reads the reciprocal: one operation less, and one rounding.
pub fn with_quotients(program: &Program) -> Program {
    let uses = program.uses();
    let divisor = |v: Value| match program.steps[v] {
        Op::Div(one, d) if uses[v] == 1 && program.steps[one] == Op::Constant(Rational::ONE) => Some(d),
        _ => None,
    };
    let quotient = |step: &Op| match *step {
        Op::Mul(a, b) => divisor(b).map(|d| Op::Div(a, d)).or_else(|| divisor(a).map(|d| Op::Div(b, d))),
        _ => None,
    };
    let steps = program.steps.iter().map(|step| quotient(step).unwrap_or_else(|| step.clone())).collect();
    let result = Program { steps, ..program.clone() };
    result.without_dead_steps()
}
