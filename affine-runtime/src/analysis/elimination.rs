//! Jacobians of straight-line code by elimination in its graph.
//!
//! An operation is a node, its partial derivatives are edges from what it reads. A node between is eliminated by the chain
//! rule: each pair of an edge to it and an edge from it becomes one edge, which adds to one that stands there. What is left
//! are edges from arguments to results, the Jacobian. The node that costs least goes first (Markowitz; A. Griewank, A. Walther,
//! Evaluating Derivatives, 2008, chapter 9). The order is found once; what it computes is a list of products and sums.

use std::collections::BTreeMap;

use super::tape::{Operand, Operation, Unary};
use crate::dual::Dual;
use crate::scalar::Scalar;

/// A partial derivative.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Weight {
    Constant(f64),
    /// What stands in a place, or its negative.
    In(Place, Sign),
}

/// What an operation or a step gave.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Place {
    Operation(usize),
    Step(usize),
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Sign {
    Plus,
    Minus,
}

impl Weight {
    fn of(operand: Operand) -> Self {
        match operand {
            Operand::Node(node) => Self::In(Place::Operation(node), Sign::Plus),
            Operand::Constant(value) => Self::Constant(value),
        }
    }

    fn negative(self) -> Self {
        match self {
            Self::Constant(value) => Self::Constant(-value),
            Self::In(place, Sign::Plus) => Self::In(place, Sign::Minus),
            Self::In(place, Sign::Minus) => Self::In(place, Sign::Plus),
        }
    }

    /// It is 1 or -1, and a product with it is free.
    fn is_unit(self) -> bool {
        matches!(self, Self::Constant(value) if value.abs() == 1.0)
    }
}

/// What is computed for the derivatives, one slot each.
#[derive(Clone, Copy, Debug)]
enum Step {
    Product(Weight, Weight),
    Sum(Weight, Weight),
    /// `a*b + c`.
    ProductSum(Weight, Weight, Weight),
    /// `1/a`.
    Reciprocal(Weight),
    /// `df/dx` at `x`.
    Slope(Unary, Weight),
    /// The derivative of `x.copysign(sign)` by `x`.
    SlopeOfSign(Weight, Weight),
    /// The derivative of the larger by the first.
    SlopeOfLarger(Weight, Weight),
}

impl Step {
    fn operands(self) -> [Option<Weight>; 3] {
        match self {
            Self::Product(a, b) | Self::Sum(a, b) | Self::SlopeOfSign(a, b) | Self::SlopeOfLarger(a, b) => {
                [Some(a), Some(b), None]
            }
            Self::ProductSum(a, b, c) => [Some(a), Some(b), Some(c)],
            Self::Reciprocal(a) | Self::Slope(_, a) => [Some(a), None, None],
        }
    }
}

/// Edges into each node, by where they come from.
struct Graph {
    into: Vec<BTreeMap<usize, Weight>>,
    out_of: Vec<Vec<usize>>,
    steps: Vec<Step>,
}

impl Graph {
    /// The graph of operations, with their partial derivatives.
    fn of(tape: &[Operation]) -> Self {
        let mut graph = Self {
            into: vec![BTreeMap::new(); tape.len()],
            out_of: vec![Vec::new(); tape.len()],
            steps: Vec::new(),
        };
        tape.iter().enumerate().for_each(|(node, operation)| graph.differentiate(node, *operation));
        graph
    }

    fn step(&mut self, step: Step) -> Weight {
        self.steps.push(step);
        Weight::In(Place::Step(self.steps.len() - 1), Sign::Plus)
    }

    /// The edges into a node.
    fn differentiate(&mut self, node: usize, operation: Operation) {
        const ONE: Weight = Weight::Constant(1.0);
        let edge = |graph: &mut Self, from: Operand, weight: Weight| {
            if let Operand::Node(from) = from {
                graph.add(from, node, (weight, ONE));
            }
        };
        match operation {
            Operation::Argument => {}
            Operation::Add(a, b) => {
                edge(self, a, ONE);
                edge(self, b, ONE);
            }
            Operation::Sub(a, b) => {
                edge(self, a, ONE);
                edge(self, b, ONE.negative());
            }
            Operation::Mul(a, b) => {
                edge(self, a, Weight::of(b));
                edge(self, b, Weight::of(a));
            }
            Operation::Fma(a, b, c) => {
                edge(self, a, Weight::of(b));
                edge(self, b, Weight::of(a));
                edge(self, c, ONE);
            }
            Operation::Div(a, b) => {
                let reciprocal = match b {
                    Operand::Node(_) => self.step(Step::Reciprocal(Weight::of(b))),
                    Operand::Constant(b) => Weight::Constant(1.0 / b),
                };
                edge(self, a, reciprocal);
                if matches!(b, Operand::Node(_)) {
                    let quotient = Weight::of(Operand::Node(node));
                    let slope = self.step(Step::Product(quotient.negative(), reciprocal));
                    edge(self, b, slope);
                }
            }
            Operation::Neg(a) => edge(self, a, ONE.negative()),
            Operation::CopySign(a, sign) => {
                let slope = self.step(Step::SlopeOfSign(Weight::of(a), Weight::of(sign)));
                edge(self, a, slope);
            }
            Operation::Max(a, b) => {
                for (this, other) in [(a, b), (b, a)] {
                    let slope = self.step(Step::SlopeOfLarger(Weight::of(this), Weight::of(other)));
                    edge(self, this, slope);
                }
            }
            Operation::Of(function, a) => {
                let slope = self.step(Step::Slope(function, Weight::of(a)));
                edge(self, a, slope);
            }
        }
    }

    /// Adds a product to the edge between two nodes.
    fn add(&mut self, from: usize, to: usize, (a, b): (Weight, Weight)) {
        let product = |graph: &mut Self| match (a, b) {
            (Weight::Constant(a), Weight::Constant(b)) => Weight::Constant(a * b),
            (Weight::Constant(unit), other) | (other, Weight::Constant(unit)) if unit == 1.0 => other,
            (Weight::Constant(unit), other) | (other, Weight::Constant(unit)) if unit == -1.0 => {
                other.negative()
            }
            _ => graph.step(Step::Product(a, b)),
        };
        let sum = match self.into[to].get(&from).copied() {
            None => {
                self.out_of[from].push(to);
                product(self)
            }
            Some(Weight::Constant(there)) if matches!((a, b), (Weight::Constant(_), Weight::Constant(_))) => {
                match product(self) {
                    Weight::Constant(more) => Weight::Constant(there + more),
                    more => self.step(Step::Sum(Weight::Constant(there), more)),
                }
            }
            Some(there) if a.is_unit() || b.is_unit() => {
                let more = product(self);
                match there == more {
                    true => self.step(Step::Product(Weight::Constant(2.0), more)),
                    false => self.step(Step::Sum(there, more)),
                }
            }
            Some(there) => self.step(Step::ProductSum(a, b, there)),
        };
        self.into[to].insert(from, sum);
    }

    /// The operations that it takes to eliminate a node.
    fn cost(&self, node: usize) -> usize {
        let mut cost = 0;
        for to in &self.out_of[node] {
            let Some(after) = self.into[*to].get(&node) else { continue };
            for (from, before) in &self.into[node] {
                let is_constant = matches!((before, after), (Weight::Constant(_), Weight::Constant(_)));
                cost += usize::from(!before.is_unit() && !after.is_unit() && !is_constant);
                cost += usize::from(self.into[*to].contains_key(from));
            }
        }
        cost
    }

    /// Takes a node out, and returns those whose cost has changed.
    fn eliminate(&mut self, node: usize) -> Vec<usize> {
        let before = core::mem::take(&mut self.into[node]);
        let after = core::mem::take(&mut self.out_of[node]);
        for to in &after {
            let Some(weight) = self.into[*to].remove(&node) else { continue };
            for (from, earlier) in &before {
                self.add(*from, *to, (*earlier, weight));
            }
        }
        for from in before.keys() {
            self.out_of[*from].retain(|to| *to != node);
        }
        let mut changed: Vec<usize> = before.keys().copied().chain(after.iter().copied()).collect();
        for to in &after {
            changed.extend(self.into[*to].keys().copied());
        }
        changed.sort_unstable();
        changed.dedup();
        changed
    }
}

/// Straight-line code that computes a function and its Jacobian.
#[derive(Clone, Debug)]
pub(super) struct Program {
    tape: Vec<Operation>,
    steps: Vec<Step>,
    /// Entries that are not zero: row, column, value.
    entries: Vec<(usize, usize, Weight)>,
    needed: Needed,
}

impl Program {
    /// The derivatives of recorded operations by so many of the first arguments; results get nodes of their own.
    pub(super) fn new(mut tape: Vec<Operation>, results: &[Operand], columns: usize) -> Self {
        let arguments = tape.iter().take_while(|operation| **operation == Operation::Argument).count();
        let mut nodes = Vec::new();
        for result in results {
            tape.push(Operation::Add(*result, Operand::Constant(0.0)));
            nodes.push(tape.len() - 1);
        }
        let mut graph = Graph::of(&tape);
        let inner = arguments..tape.len() - results.len();
        // What leads to no result goes first, and costs nothing.
        for node in inner.clone().rev() {
            if graph.out_of[node].is_empty() {
                graph.eliminate(node);
            }
        }
        let mut left: BTreeMap<usize, usize> = inner.map(|node| (node, graph.cost(node))).collect();
        while let Some((node, _)) =
            left.iter().map(|(node, cost)| (*node, *cost)).min_by_key(|(_, cost)| *cost)
        {
            left.remove(&node);
            for changed in graph.eliminate(node) {
                if let Some(cost) = left.get_mut(&changed) {
                    *cost = graph.cost(changed);
                }
            }
        }
        let row = |(row, node): (usize, &usize)| {
            let entries = graph.into[*node].range(..columns);
            entries.map(|(column, weight)| (row, *column, *weight)).collect::<Vec<_>>()
        };
        let entries: Vec<_> = nodes.iter().enumerate().flat_map(row).collect();
        let needed = Needed::by(&tape, &graph.steps, &entries);
        Self { tape, steps: graph.steps, entries, needed }
    }

    /// The entries of the Jacobian that are not zero at arguments, each given to `each` with its row and column.
    pub(super) fn evaluate<T: Scalar>(&self, arguments: &[T], mut each: impl FnMut(usize, usize, T)) {
        let mut slots = Slots { operations: Vec::with_capacity(self.tape.len()), steps: Vec::new() };
        for (node, (operation, is_needed)) in self.tape.iter().zip(&self.needed.operations).enumerate() {
            let value = match operation {
                Operation::Argument => arguments[node],
                operation if *is_needed => slots.computed(*operation),
                _ => T::zero(),
            };
            slots.operations.push(value);
        }
        for (step, is_needed) in self.steps.iter().zip(&self.needed.steps) {
            let value = if *is_needed { slots.stepped(*step) } else { T::zero() };
            slots.steps.push(value);
        }
        for (row, column, weight) in &self.entries {
            each(*row, *column, slots.value(*weight));
        }
    }
}

/// What the entries of a Jacobian depend on.
#[derive(Clone, Debug)]
struct Needed {
    operations: Vec<bool>,
    steps: Vec<bool>,
}

impl Needed {
    fn by(tape: &[Operation], steps: &[Step], entries: &[(usize, usize, Weight)]) -> Self {
        let mut needed = Self { operations: vec![false; tape.len()], steps: vec![false; steps.len()] };
        entries.iter().for_each(|(_, _, weight)| needed.mark(*weight));
        for (k, step) in steps.iter().enumerate().rev() {
            if needed.steps[k] {
                step.operands().into_iter().flatten().for_each(|weight| needed.mark(weight));
            }
        }
        for (node, operation) in tape.iter().enumerate().rev() {
            if needed.operations[node] {
                operation
                    .operands()
                    .into_iter()
                    .flatten()
                    .for_each(|operand| needed.mark(Weight::of(operand)));
            }
        }
        needed
    }

    fn mark(&mut self, weight: Weight) {
        match weight {
            Weight::In(Place::Operation(node), _) => self.operations[node] = true,
            Weight::In(Place::Step(step), _) => self.steps[step] = true,
            Weight::Constant(_) => {}
        }
    }
}

/// What operations and steps gave.
struct Slots<T> {
    operations: Vec<T>,
    steps: Vec<T>,
}

impl<T: Scalar> Slots<T> {
    fn value(&self, weight: Weight) -> T {
        let (place, sign) = match weight {
            Weight::Constant(value) => return T::constant(value, 0.0),
            Weight::In(place, sign) => (place, sign),
        };
        let value = match place {
            Place::Operation(node) => self.operations[node],
            Place::Step(step) => self.steps[step],
        };
        if sign == Sign::Plus { value } else { -value }
    }

    fn computed(&self, operation: Operation) -> T {
        let of = |operand: Operand| self.value(Weight::of(operand));
        match operation {
            Operation::Argument => T::zero(),
            Operation::Add(a, b) => of(a) + of(b),
            Operation::Sub(a, b) => of(a) - of(b),
            Operation::Mul(a, b) => of(a) * of(b),
            Operation::Div(a, b) => of(a) / of(b),
            Operation::Neg(a) => -of(a),
            Operation::Fma(a, b, c) => of(a).fma(of(b), of(c)),
            Operation::CopySign(a, sign) => of(a).copysign(of(sign)),
            Operation::Max(a, b) => of(a).max(of(b)),
            Operation::Of(function, a) => function.of(of(a)),
        }
    }

    fn stepped(&self, step: Step) -> T {
        let of = |weight: Weight| self.value(weight);
        let varied = |weight: Weight| Dual { value: of(weight), slope: T::one() };
        match step {
            Step::Product(a, b) => of(a) * of(b),
            Step::Sum(a, b) => of(a) + of(b),
            Step::ProductSum(a, b, c) => of(a).fma(of(b), of(c)),
            Step::Reciprocal(a) => T::one() / of(a),
            Step::Slope(function, a) => function.of(varied(a)).slope,
            Step::SlopeOfSign(a, sign) => varied(a).copysign(Dual::fixed(of(sign))).slope,
            Step::SlopeOfLarger(a, b) => varied(a).max(Dual::fixed(of(b))).slope,
        }
    }
}
