//! How much a program loses to rounding at a point, to first order.

use crate::algebra::Function;
use crate::algebra::evaluate::Field;
use crate::symbol::Symbol;

use super::{Op, Program, Value};

/// Results at a point with what rounding does to them, in units of the rounding of one operation.
#[derive(Clone, Debug)]
pub struct Rounding {
    /// The results.
    pub results: Vec<f64>,
    /// `sum |df/dv| |v|` over all values `v` that are computed on the way.
    pub own: Vec<f64>,
    /// `sum |df/dz| size(z)` over the inputs `z`, of given sizes.
    pub of_inputs: Vec<f64>,
}

impl Program {
    /// The results at a point with their bounds; `None` where an input has no value.
    ///
    /// A bound depends on no chance, as the error at a point does.
    pub fn rounding(
        &self,
        input: &impl Fn(&Symbol) -> Option<f64>,
        size: &impl Fn(&Symbol) -> f64,
    ) -> Option<Rounding> {
        let mut values: Vec<f64> = Vec::with_capacity(self.steps.len());
        for step in &self.steps {
            let value = match step {
                Op::Input(symbol) => input(symbol)?,
                Op::Constant(number) => f64::from_rational(number),
                Op::Add(a, b) => values[*a] + values[*b],
                Op::Sub(a, b) => values[*a] - values[*b],
                Op::Mul(a, b) => values[*a] * values[*b],
                Op::Div(a, b) => values[*a] / values[*b],
                Op::Neg(a) => -values[*a],
                Op::MulAdd(a, b, c) => values[*a].mul_add(values[*b], values[*c]),
                Op::Call(function, a) => values[*a].apply(*function)?,
            };
            values.push(value);
        }
        let mut rounding = Rounding { results: Vec::new(), own: Vec::new(), of_inputs: Vec::new() };
        for (_, output) in &self.outputs {
            let slopes = self.slopes(*output, &values);
            let (mut own, mut of_inputs) = (0.0, 0.0);
            for ((step, slope), value) in self.steps.iter().zip(&slopes).zip(&values) {
                // What does not act on the result has no part in it, however large it is.
                if *slope == 0.0 {
                    continue;
                }
                match step {
                    Op::Input(symbol) => of_inputs += slope.abs() * size(symbol),
                    Op::Constant(_) | Op::Neg(_) => {}
                    _ => own += (slope * value).abs(),
                }
            }
            rounding.results.push(values[*output]);
            rounding.own.push(own);
            rounding.of_inputs.push(of_inputs);
        }
        Some(rounding)
    }

    /// The derivatives of a result by all values, from the last to the first.
    fn slopes(&self, output: Value, values: &[f64]) -> Vec<f64> {
        let mut slopes = vec![0.0; self.steps.len()];
        slopes[output] = 1.0;
        for (k, step) in self.steps.iter().enumerate().rev() {
            let slope = slopes[k];
            if slope == 0.0 {
                continue;
            }
            match *step {
                Op::Input(_) | Op::Constant(_) => {}
                Op::Add(a, b) => {
                    slopes[a] += slope;
                    slopes[b] += slope;
                }
                Op::Sub(a, b) => {
                    slopes[a] += slope;
                    slopes[b] -= slope;
                }
                Op::Mul(a, b) => {
                    slopes[a] += slope * values[b];
                    slopes[b] += slope * values[a];
                }
                Op::Div(a, b) => {
                    slopes[a] += slope / values[b];
                    slopes[b] -= slope * values[k] / values[b];
                }
                Op::Neg(a) => slopes[a] -= slope,
                Op::MulAdd(a, b, c) => {
                    slopes[a] += slope * values[b];
                    slopes[b] += slope * values[a];
                    slopes[c] += slope;
                }
                Op::Call(function, a) => slopes[a] += slope * derivative(function, values[a], values[k]),
            }
        }
        slopes
    }
}

/// `f'(a)`, `value` being `f(a)`.
fn derivative(function: Function, a: f64, value: f64) -> f64 {
    match function {
        Function::Exp => value,
        Function::ExpM1 => value + 1.0,
        Function::Ln => 1.0 / a,
        Function::Sqrt => 0.5 / value,
        Function::Cbrt => value / (3.0 * a),
        Function::InverseCbrt => -value / (3.0 * a),
        Function::Abs => a.signum(),
        Function::Sign => 0.0,
        Function::Sin => a.cos(),
        Function::Cos => -a.sin(),
        Function::Tan => 1.0 + value * value,
        Function::Sinh => a.cosh(),
        Function::Cosh => a.sinh(),
        Function::Tanh => 1.0 - value * value,
        Function::Asinh => 1.0 / a.hypot(1.0),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::algebra::Rational;
    use crate::symbol::Quantity;

    /// `(x - 1) (x + 1)` keeps its digits at `x = 1 + 1e-6`, `x^2 - 1` loses six of them.
    #[test]
    fn cancellation_is_seen() {
        let one = || Op::Constant(Rational::ONE);
        let start = || vec![Op::Input(Quantity::Position.into()), one()];
        let of = |steps: Vec<Op>| {
            let last = steps.len() - 1;
            let program =
                Program { steps, outputs: vec![(Quantity::Value.into(), last)], ..Program::default() };
            let found = program.rounding(&|_| Some(1.0 + 1e-6), &|_| 1e-6).unwrap();
            (found.own[0] / found.results[0], found.of_inputs[0])
        };
        let factored = of([start(), vec![Op::Sub(0, 1), Op::Add(0, 1), Op::Mul(2, 3)]].concat());
        let expanded = of([start(), vec![Op::Mul(0, 0), Op::Sub(2, 1)]].concat());
        assert!((factored.0 - 3.0).abs() < 1e-5, "{factored:?}");
        assert!(expanded.0 > 4e5, "{expanded:?}");
        assert!((factored.1 - 2e-6).abs() < 1e-11 && (expanded.1 - 2e-6).abs() < 1e-11);
    }
}
