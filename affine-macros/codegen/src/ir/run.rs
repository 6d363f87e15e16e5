//! Execution of a program in any field: the counterpart of the reference evaluator.

use crate::algebra::Rational;
use crate::algebra::evaluate::Field;
use crate::symbol::Symbol;

use super::{Op, Program};

impl Program {
    /// The results; `None` where an input has no value or a divisor no reciprocal.
    pub fn run<F: Field>(&self, input: &impl Fn(&Symbol) -> Option<F>) -> Option<Vec<F>> {
        let minus = F::from_rational(&Rational::MINUS_ONE);
        let mut values: Vec<F> = Vec::with_capacity(self.steps.len());
        for step in &self.steps {
            let value = match step {
                Op::Input(symbol) => input(symbol)?,
                Op::Constant(number) => F::from_rational(number),
                Op::Add(a, b) => values[*a].add(&values[*b]),
                Op::Sub(a, b) => values[*a].add(&minus.mul(&values[*b])),
                Op::Mul(a, b) => values[*a].mul(&values[*b]),
                Op::Div(a, b) => values[*a].mul(&values[*b].recip()?),
                Op::Call(function, a) => values[*a].apply(*function)?,
                Op::Neg(a) => minus.mul(&values[*a]),
                Op::MulAdd(a, b, c) => values[*a].mul(&values[*b]).add(&values[*c]),
            };
            values.push(value);
        }
        Some(self.outputs.iter().map(|(_, v)| values[*v].clone()).collect())
    }
}
