//! The derivative of a program along a change of its inputs, as a program: the linear map `dx -> f'(x) dx` beside `f`.
//!
//! Every value has a change that follows from its operation by the chain rule (Griewank and Walther, Evaluating
//! Derivatives, section 3.1); what does not depend on an input that changes has none. Values and changes share what they
//! have in common.

use crate::algebra::{Function, Rational};
use crate::symbol::{Aspect, Symbol};

use super::steps::Steps;
use super::{Op, Program, Value};

/// The results of `program`, then their changes. The input `x`, where `changing(x)`, changes by the input
/// [`Aspect::Change`] of `x`. What runtime functions provide does not change: programs that call some have no derivative here.
pub fn with_tangent(program: &Program, changing: &impl Fn(&Symbol) -> bool) -> Program {
    let mut steps = Steps::of(program.steps.clone());
    let mut changes: Vec<Option<Value>> = Vec::with_capacity(program.steps.len());
    for (value, op) in program.steps.iter().enumerate() {
        let change = steps.change(value, op, &changes, changing);
        changes.push(change);
    }
    let mut outputs = program.outputs.clone();
    for (name, value) in &program.outputs {
        let change = changes[*value].unwrap_or_else(|| steps.step(Op::Constant(Rational::ZERO)));
        outputs.push((name.clone().seen(Aspect::Change), change));
    }
    let program = Program { steps: steps.list, outputs, ..program.clone() };
    program.without_dead_steps()
}

impl Steps {
    /// The change of a value, if it has one.
    fn change(
        &mut self,
        value: Value,
        op: &Op,
        changes: &[Option<Value>],
        changing: &impl Fn(&Symbol) -> bool,
    ) -> Option<Value> {
        match *op {
            Op::Input(ref symbol) => {
                changing(symbol).then(|| self.step(Op::Input(symbol.clone().seen(Aspect::Change))))
            }
            Op::Constant(_) => None,
            Op::Add(a, b) => self.sum(changes[a], changes[b]),
            Op::Sub(a, b) => match (changes[a], changes[b]) {
                (Some(a), Some(b)) => Some(self.step(Op::Sub(a, b))),
                (None, Some(b)) => Some(self.step(Op::Neg(b))),
                (a, None) => a,
            },
            Op::Neg(a) => changes[a].map(|a| self.step(Op::Neg(a))),
            Op::Mul(a, b) => self.product((a, changes[a]), (b, changes[b])),
            Op::MulAdd(a, b, c) => {
                let product = self.product((a, changes[a]), (b, changes[b]));
                self.sum(changes[c], product)
            }
            // v = a/b: v' = (a' - v b')/b.
            Op::Div(a, b) => {
                let through = changes[b].map(|b| self.step(Op::Mul(b, value)));
                let above = match (changes[a], through) {
                    (Some(a), Some(through)) => self.step(Op::Sub(a, through)),
                    (None, Some(through)) => self.step(Op::Neg(through)),
                    (Some(a), None) => a,
                    (None, None) => return None,
                };
                Some(self.step(Op::Div(above, b)))
            }
            Op::Call(function, a) => changes[a].map(|change| self.of_function(function, a, value, change)),
        }
    }

    fn sum(&mut self, a: Option<Value>, b: Option<Value>) -> Option<Value> {
        match (a, b) {
            (Some(a), Some(b)) => Some(self.step(Op::Add(a, b))),
            (one, None) | (None, one) => one,
        }
    }

    /// `a' b + a b'`.
    fn product(
        &mut self,
        (a, a_change): (Value, Option<Value>),
        (b, b_change): (Value, Option<Value>),
    ) -> Option<Value> {
        if a == b {
            let half = a_change.map(|change| self.step(Op::Mul(change, a)))?;
            return Some(self.step(Op::Add(half, half)));
        }
        let left = a_change.map(|change| self.step(Op::Mul(change, b)));
        let right = b_change.map(|change| self.step(Op::Mul(change, a)));
        self.sum(left, right)
    }

    /// `f'(a) a'`, `value` being `f(a)`.
    fn of_function(&mut self, function: Function, a: Value, value: Value, change: Value) -> Value {
        match function {
            Function::Exp => self.step(Op::Mul(change, value)),
            Function::ExpM1 => {
                let one = self.step(Op::Constant(Rational::ONE));
                let slope = self.step(Op::Add(value, one));
                self.step(Op::Mul(change, slope))
            }
            Function::Ln => self.step(Op::Div(change, a)),
            Function::Asinh => {
                let one = self.step(Op::Constant(Rational::ONE));
                let square = self.step(Op::Mul(a, a));
                let sum = self.step(Op::Add(one, square));
                let root = self.step(Op::Call(Function::Sqrt, sum));
                self.step(Op::Div(change, root))
            }
            Function::Sqrt => self.of_root(value, change),
            // v' = v a'/(3 a), v' = -v a'/(3 a)
            Function::Cbrt | Function::InverseCbrt => {
                let three = self.step(Op::Constant(Rational::from(3)));
                let below = self.step(Op::Mul(three, a));
                let above = self.step(Op::Mul(change, value));
                let along = self.step(Op::Div(above, below));
                if function == Function::Cbrt { along } else { self.step(Op::Neg(along)) }
            }
            Function::Abs => self.times(Function::Sign, a, change),
            Function::Sign => self.step(Op::Constant(Rational::ZERO)),
            Function::Sin => self.times(Function::Cos, a, change),
            Function::Cos => {
                let slope = self.times(Function::Sin, a, change);
                self.step(Op::Neg(slope))
            }
            Function::Sinh => self.times(Function::Cosh, a, change),
            Function::Cosh => self.times(Function::Sinh, a, change),
            // tan' = 1 + tan^2, tanh' = 1 - tanh^2
            Function::Tan | Function::Tanh => {
                let square = self.step(Op::Mul(value, value));
                let along = self.step(Op::Mul(change, square));
                self.step(match function {
                    Function::Tan => Op::Add(change, along),
                    _ => Op::Sub(change, along),
                })
            }
        }
    }

    /// `a'/(2 v + 1 + sign(0 - |a'|))`: what does not change has a root that does not, of zero too, and where it changes 0 is added.
    fn of_root(&mut self, root: Value, change: Value) -> Value {
        let [zero, one] = [Rational::ZERO, Rational::ONE].map(|number| self.step(Op::Constant(number)));
        let size = self.step(Op::Call(Function::Abs, change));
        let sign = self.step(Op::Sub(zero, size));
        let sign = self.step(Op::Call(Function::Sign, sign));
        let unless_changed = self.step(Op::Add(one, sign));
        let twice = self.step(Op::Add(root, root));
        let below = self.step(Op::Add(twice, unless_changed));
        self.step(Op::Div(change, below))
    }

    /// `g(a) a'`.
    fn times(&mut self, function: Function, a: Value, change: Value) -> Value {
        let slope = self.step(Op::Call(function, a));
        self.step(Op::Mul(change, slope))
    }
}
