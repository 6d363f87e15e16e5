//! Jacobians of straight-line code by elimination in its graph.
//!
//! An operation is a node, its partial derivatives are edges from what it reads. A node between is eliminated by the chain
//! rule: each pair of an edge to it and an edge from it becomes one edge, which adds to one that stands there. What is left
//! are edges from arguments to results, the Jacobian. The node that costs least goes first (Markowitz; A. Griewank, A. Walther,
//! Evaluating Derivatives, 2008, chapter 9). The order is found once; what it computes is a list of products and sums.

use std::collections::BTreeMap;

use super::tape::{Kind, Operand, Operation};
use crate::dual::Dual;
use crate::scalar::Scalar;

/// A partial derivative.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Weight {
    Constant(f64),
    /// What stands in a place, times 1 or -1.
    In(Place, f64),
}

/// What an operation or a step gave.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Place {
    Operation(usize),
    Step(usize),
}

impl Weight {
    fn of(operand: Operand) -> Self {
        match operand {
            Operand::Node(node) => Self::In(Place::Operation(node), 1.0),
            Operand::Constant(value) => Self::Constant(value),
        }
    }

    /// It is 1 or -1, and a product with it is free.
    fn unit(self) -> Option<f64> {
        match self {
            Self::Constant(value) if value.abs() == 1.0 => Some(value),
            _ => None,
        }
    }

    fn signed(self, sign: f64) -> Self {
        match self {
            Self::Constant(value) => Self::Constant(sign * value),
            Self::In(place, own) => Self::In(place, sign * own),
        }
    }

    /// A product that takes no operation.
    fn free_product(self, other: Self) -> Option<Self> {
        match (self, other) {
            (Self::Constant(a), Self::Constant(b)) => Some(Self::Constant(a * b)),
            _ => self.unit().map(|sign| other.signed(sign)).or(other.unit().map(|sign| self.signed(sign))),
        }
    }
}

/// What is computed for the derivatives.
#[derive(Clone, Copy, Debug)]
enum Step {
    /// `a*b + c`.
    ProductSum(Weight, Weight, Weight),
    /// `a*b`.
    Product(Weight, Weight),
    /// `a + b`.
    Sum(Weight, Weight),
    /// The derivative of an operation by the number at a place among those that it reads.
    Partial(Kind, usize, [Weight; 3]),
}

const ONE: Weight = Weight::Constant(1.0);

/// Edges into each node, by where they come from.
struct Graph {
    into: Vec<BTreeMap<usize, Weight>>,
    out_of: Vec<Vec<usize>>,
    steps: Vec<Step>,
}

impl Graph {
    /// The graph of operations, with their partial derivatives.
    fn of(tape: &[Operation]) -> Self {
        let (into, out_of) = (vec![BTreeMap::new(); tape.len()], vec![Vec::new(); tape.len()]);
        let mut graph = Self { into, out_of, steps: Vec::new() };
        for (node, (kind, operands)) in tape.iter().enumerate() {
            let weights = operands.map(Weight::of);
            for (k, operand) in operands.iter().enumerate() {
                if let Operand::Node(from) = operand {
                    let partial = graph.partial(*kind, k, weights);
                    graph.add(*from, node, (partial, ONE));
                }
            }
        }
        graph
    }

    fn step(&mut self, step: Step) -> Weight {
        self.steps.push(step);
        Weight::In(Place::Step(self.steps.len() - 1), 1.0)
    }

    fn partial(&mut self, kind: Kind, k: usize, operands: [Weight; 3]) -> Weight {
        match (kind, k) {
            (Kind::Add, _) | (Kind::Sub, 0) | (Kind::Fma, 2) => ONE,
            (Kind::Sub | Kind::Neg, _) => Weight::Constant(-1.0),
            (Kind::Mul | Kind::Fma, k) => operands[1 - k],
            _ => self.step(Step::Partial(kind, k, operands)),
        }
    }

    /// Adds a product to the edge between two nodes.
    fn add(&mut self, from: usize, to: usize, (a, b): (Weight, Weight)) {
        let sum = match (self.into[to].get(&from).copied(), a.free_product(b)) {
            (None, product) => {
                self.out_of[from].push(to);
                product.unwrap_or_else(|| self.step(Step::Product(a, b)))
            }
            (Some(Weight::Constant(there)), Some(Weight::Constant(more))) => Weight::Constant(there + more),
            (Some(there), Some(more)) => self.step(Step::Sum(there, more)),
            (Some(there), None) => self.step(Step::ProductSum(a, b, there)),
        };
        self.into[to].insert(from, sum);
    }

    /// The operations that it takes to eliminate a node.
    fn cost(&self, node: usize) -> usize {
        let mut cost = 0;
        for to in &self.out_of[node] {
            let Some(after) = self.into[*to].get(&node) else { continue };
            for (from, before) in &self.into[node] {
                cost += usize::from(before.free_product(*after).is_none());
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
        changed.extend(after.iter().flat_map(|to| self.into[*to].keys().copied()));
        changed.sort_unstable();
        changed.dedup();
        changed
    }

    /// Eliminates nodes, the one that costs least first; what leads to no result costs nothing.
    fn eliminate_all(&mut self, nodes: core::ops::Range<usize>) {
        for node in nodes.clone().rev() {
            if self.out_of[node].is_empty() {
                self.eliminate(node);
            }
        }
        let mut left: BTreeMap<usize, usize> = nodes.map(|node| (node, self.cost(node))).collect();
        while let Some((&node, _)) = left.iter().min_by_key(|(_, cost)| **cost) {
            left.remove(&node);
            for changed in self.eliminate(node) {
                if let Some(cost) = left.get_mut(&changed) {
                    *cost = self.cost(changed);
                }
            }
        }
    }
}

/// Straight-line code that computes a function and its Jacobian.
#[derive(Clone, Debug)]
pub(super) struct Program {
    tape: Vec<Operation>,
    steps: Vec<Step>,
    /// Entries that are not zero: row, column, value.
    entries: Vec<(usize, usize, Weight)>,
}

impl Program {
    /// The derivatives of recorded operations by so many of the first arguments; results get nodes of their own.
    pub(super) fn new(mut tape: Vec<Operation>, results: &[Operand], columns: usize) -> Self {
        let arguments = tape.iter().take_while(|(kind, _)| *kind == Kind::Argument).count();
        let inner = arguments..tape.len();
        let zero = Operand::Constant(0.0);
        tape.extend(results.iter().map(|result| (Kind::Add, [*result, zero, zero])));
        let mut graph = Graph::of(&tape);
        graph.eliminate_all(inner.clone());
        let mut entries = Vec::new();
        for (row, node) in (inner.end..tape.len()).enumerate() {
            let edges = graph.into[node].range(..columns);
            entries.extend(edges.map(|(column, weight)| (row, *column, *weight)));
        }
        Self { tape, steps: graph.steps, entries }
    }

    /// The entries of the Jacobian that are not zero at arguments, each given to `each` with its row and column.
    pub(super) fn evaluate<T: Scalar>(&self, arguments: &[T], mut each: impl FnMut(usize, usize, T)) {
        let mut slots = Slots { operations: Vec::with_capacity(self.tape.len()), steps: Vec::new() };
        for (node, (kind, operands)) in self.tape.iter().enumerate() {
            let operands = operands.map(|operand| slots.value(Weight::of(operand)));
            slots.operations.push(arguments.get(node).copied().unwrap_or_else(|| kind.of(operands)));
        }
        for step in &self.steps {
            slots.steps.push(slots.stepped(*step));
        }
        for (row, column, weight) in &self.entries {
            each(*row, *column, slots.value(*weight));
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
        let (value, sign) = match weight {
            Weight::Constant(value) => return T::constant(value, 0.0),
            Weight::In(Place::Operation(node), sign) => (self.operations[node], sign),
            Weight::In(Place::Step(step), sign) => (self.steps[step], sign),
        };
        if sign > 0.0 { value } else { -value }
    }

    fn stepped(&self, step: Step) -> T {
        let of = |weight: Weight| self.value(weight);
        match step {
            Step::ProductSum(a, b, c) => of(a).fma(of(b), of(c)),
            Step::Product(a, b) => of(a) * of(b),
            Step::Sum(a, b) => of(a) + of(b),
            Step::Partial(kind, k, operands) => {
                let mut varied = operands.map(|operand| Dual::fixed(of(operand)));
                varied[k].slope = T::one();
                kind.of(varied).slope
            }
        }
    }
}
