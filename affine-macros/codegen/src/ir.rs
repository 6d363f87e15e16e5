//! Straight-line programs in static single assignment, and their passes; knows neither syntax nor mechanics.

pub mod build;
pub mod call;
pub mod common;
pub mod count;
pub mod fuse;
pub mod inverse_root;
pub mod naming;
pub mod packed;
pub mod quotient;
pub mod rounding;
pub mod run;
mod steps;
pub mod tangent;
pub mod taylor;

use crate::algebra::{Function, Rational};
use crate::symbol::{Quantity, Symbol};

pub use call::Value;

use call::Call;

/// One operation.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Op {
    /// An input.
    Input(Symbol),
    /// An exact number.
    Constant(Rational),
    /// `a + b`
    Add(Value, Value),
    /// `a - b`
    Sub(Value, Value),
    /// `a * b`
    Mul(Value, Value),
    /// `a / b`
    Div(Value, Value),
    /// `-a`
    Neg(Value),
    /// `a * b + c`
    MulAdd(Value, Value, Value),
    /// An elementary function of `a`
    Call(Function, Value),
}

impl Op {
    /// The values it reads.
    pub fn operands(&self) -> Vec<Value> {
        match *self {
            Op::Input(_) | Op::Constant(_) => Vec::new(),
            Op::Neg(a) | Op::Call(_, a) => vec![a],
            Op::Add(a, b) | Op::Sub(a, b) | Op::Mul(a, b) | Op::Div(a, b) => vec![a, b],
            Op::MulAdd(a, b, c) => vec![a, b, c],
        }
    }
}

/// A straight-line program: every step reads earlier ones only.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[must_use]
pub struct Program {
    /// The steps in order.
    pub steps: Vec<Op>,
    /// Calls of runtime functions, which provide some of the inputs.
    pub calls: Vec<Call>,
    /// Names of values that mean something.
    pub names: Vec<(Value, Symbol)>,
    /// The results in order.
    pub outputs: Vec<(Symbol, Value)>,
}

impl Program {
    /// What it reads.
    pub fn symbols(&self) -> impl Iterator<Item = &Symbol> {
        self.steps.iter().filter_map(|step| match step {
            Op::Input(symbol) => Some(symbol),
            _ => None,
        })
    }

    /// What it reads, as a list.
    pub fn inputs(&self) -> Vec<Symbol> {
        self.symbols().cloned().collect()
    }

    /// Does it read the time?
    pub fn reads_time(&self) -> bool {
        self.symbols().any(|symbol| symbol.quantity() == Some(Quantity::Time))
    }

    /// The results, by name.
    pub fn results(&self) -> impl Iterator<Item = &Symbol> {
        self.outputs.iter().map(|(name, _)| name)
    }

    /// Name of a value: what the derivation calls it, or its place.
    pub fn name(&self, value: Value) -> Symbol {
        match &self.steps[value] {
            Op::Input(symbol) => symbol.clone(),
            _ => self.own_name(value).cloned().unwrap_or(Symbol::Step(value)),
        }
    }

    /// What the derivation calls a value that is computed.
    pub fn own_name(&self, value: Value) -> Option<&Symbol> {
        let output = self.outputs.iter().find(|(_, v)| *v == value).map(|(name, _)| name);
        self.names.iter().find(|(v, _)| *v == value).map(|(_, name)| name).or(output)
    }

    /// How often each value is read, by steps, by calls and as a result.
    pub fn uses(&self) -> Vec<usize> {
        let mut uses = vec![0; self.steps.len()];
        for step in &self.steps {
            step.operands().into_iter().for_each(|v| uses[v] += 1);
        }
        self.calls.iter().flat_map(Call::operands).for_each(|v| uses[v] += 1);
        self.outputs.iter().for_each(|(_, v)| uses[*v] += 1);
        uses
    }

    /// Which values depend on the inputs that are asked about?
    pub(crate) fn depending(&self, on: impl Fn(&Symbol) -> bool) -> Vec<bool> {
        let mut depends = Vec::with_capacity(self.steps.len());
        for step in &self.steps {
            depends.push(match step {
                Op::Input(symbol) => on(symbol),
                step => step.operands().into_iter().any(|v| depends[v]),
            });
        }
        depends
    }

    /// The program of one result alone.
    pub fn only(&self, result: &Symbol) -> Self {
        let mut program = self.clone();
        program.outputs.retain(|(name, _)| name == result);
        program.without_dead_steps()
    }

    /// The call that provides the value, if it is an input that a call provides.
    pub fn call_before(&self, value: Value) -> Option<&Call> {
        match &self.steps[value] {
            Op::Input(symbol) => self.calls.iter().find(|call| call.provides(symbol)),
            _ => None,
        }
    }

    /// With the calls, names and results of a program whose values have these places in it, and only what the results need.
    pub(crate) fn ending_as(mut self, other: &Self, place: &[Value]) -> Self {
        self.calls = other.calls.iter().map(|call| call.renumbered(place)).collect();
        self.names = other.names.iter().map(|(v, n)| (place[*v], n.clone())).collect();
        self.outputs = other.outputs.iter().map(|(n, v)| (n.clone(), place[*v])).collect();
        self.without_dead_steps()
    }

    /// Keeps only what the results need, in the same order.
    pub fn without_dead_steps(&self) -> Self {
        let mut needed = vec![false; self.steps.len()];
        self.outputs.iter().for_each(|(_, v)| needed[*v] = true);
        for k in (0..self.steps.len()).rev() {
            if needed[k] {
                self.steps[k].operands().into_iter().for_each(|v| needed[v] = true);
                self.call_before(k).into_iter().flat_map(Call::operands).for_each(|v| needed[v] = true);
            }
        }
        let mut place = vec![0; self.steps.len()];
        let mut result = Self::default();
        for (k, step) in self.steps.iter().enumerate().filter(|(k, _)| needed[*k]) {
            place[k] = result.steps.len();
            result.steps.push(step.renumbered(&place));
        }
        let is_read = |call: &&Call| {
            let read = |(k, step): (usize, &Op)| {
                needed[k] && matches!(step, Op::Input(symbol) if call.provides(symbol))
            };
            self.steps.iter().enumerate().any(read)
        };
        result.calls = self.calls.iter().filter(is_read).map(|call| call.renumbered(&place)).collect();
        result.names =
            self.names.iter().filter(|(v, _)| needed[*v]).map(|(v, n)| (place[*v], n.clone())).collect();
        result.outputs = self.outputs.iter().map(|(n, v)| (n.clone(), place[*v])).collect();
        result
    }
}

impl Op {
    /// The same operation on renumbered values.
    pub fn renumbered(&self, place: &[Value]) -> Self {
        match self {
            Op::Input(_) | Op::Constant(_) => self.clone(),
            Op::Neg(a) => Op::Neg(place[*a]),
            Op::Call(function, a) => Op::Call(*function, place[*a]),
            Op::Add(a, b) => Op::Add(place[*a], place[*b]),
            Op::Sub(a, b) => Op::Sub(place[*a], place[*b]),
            Op::Mul(a, b) => Op::Mul(place[*a], place[*b]),
            Op::Div(a, b) => Op::Div(place[*a], place[*b]),
            Op::MulAdd(a, b, c) => Op::MulAdd(place[*a], place[*b], place[*c]),
        }
    }
}
