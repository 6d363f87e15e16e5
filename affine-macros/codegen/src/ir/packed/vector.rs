//! A right-hand side in vectors of four: what stands in their lanes, how they are made, in which order.

use crate::ir::{Op, Program, Value};
use crate::symbol::Symbol;

/// What stands in a lane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lane {
    /// Nothing that is read.
    Free,
    /// `-0`, which adds nothing.
    MinusZero,
    /// A value with its own sign.
    Of(Value),
    /// A value with the other sign.
    Minus(Value),
}

/// What stands in the lanes of a vector.
pub type Lanes = [Lane; 4];

/// Index of a vector.
pub type Index = usize;

/// How a vector is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Four {
    /// A vector of the state.
    State(usize),
    /// One value in all lanes.
    All(Value),
    /// Lane by lane.
    Gathered(Lanes),
    /// `-a`
    Neg(Index),
    /// `a + b`
    Add(Index, Index),
    /// `a - b`
    Sub(Index, Index),
    /// `a * b`
    Mul(Index, Index),
    /// `a * b + c`
    MulAdd(Index, Index, Index),
}

impl Four {
    /// The vectors that it reads.
    pub fn operands(self) -> Vec<Index> {
        match self {
            Self::State(_) | Self::All(_) | Self::Gathered(_) => Vec::new(),
            Self::Neg(a) => vec![a],
            Self::Add(a, b) | Self::Sub(a, b) | Self::Mul(a, b) => vec![a, b],
            Self::MulAdd(a, b, c) => vec![a, b, c],
        }
    }

    /// Are its lanes computed there, or read from the state?
    pub fn makes(self) -> bool {
        !matches!(self, Self::All(_) | Self::Gathered(_))
    }

    /// The values that it reads.
    pub fn values(self) -> Vec<Value> {
        match self {
            Self::All(value) => vec![value],
            Self::Gathered(lanes) => lanes.into_iter().filter_map(Lane::value).collect(),
            _ => Vec::new(),
        }
    }
}

impl Lane {
    /// The value, whatever its sign.
    pub fn value(self) -> Option<Value> {
        match self {
            Self::Of(value) | Self::Minus(value) => Some(value),
            Self::Free | Self::MinusZero => None,
        }
    }
}

/// A vector with what stands in its lanes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Vector {
    /// Its lanes.
    pub lanes: Lanes,
    /// How it is made.
    pub made: Four,
}

/// What is computed next.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Step {
    /// A step of the scalar program.
    Scalar(Value),
    /// A vector.
    Vector(Index),
}

/// A right-hand side in vectors.
#[derive(Clone, Debug)]
pub struct Packed {
    /// The scalar program.
    pub program: Program,
    /// The component in each lane of each vector of the state.
    pub state: Vec<[Option<usize>; 4]>,
    /// All vectors.
    pub vectors: Vec<Vector>,
    /// What is computed, in order; what is an input is not.
    pub steps: Vec<Step>,
    /// Values that are lanes of vectors.
    pub in_lanes: Vec<(Value, (Index, usize))>,
    /// The rates of the vectors of the state.
    pub rates: Vec<Index>,
}

impl Packed {
    /// The scalar program of what is computed outside of lanes and gathered into them.
    pub fn read(&self) -> Program {
        let mut program = self.program.clone();
        let inputs = self.steps.iter().flat_map(|step| match *step {
            Step::Scalar(value) => self.program.steps[value].operands(),
            Step::Vector(index) => self.vectors[index].made.values(),
        });
        let read = inputs.filter(|value| matches!(self.program.steps[*value], Op::Input(_)));
        program.outputs = read.map(|value| (Symbol::Step(value), value)).collect();
        program.without_dead_steps()
    }

    /// The steps that a step reads.
    pub fn operands(&self, step: Step) -> Vec<Step> {
        let of = |value: Value| match self.lane(value) {
            Some((index, _)) => Step::Vector(index),
            None => Step::Scalar(value),
        };
        match step {
            Step::Scalar(value) => self.program.steps[value].operands().into_iter().map(of).collect(),
            Step::Vector(index) => {
                let made = self.vectors[index].made;
                made.operands()
                    .into_iter()
                    .map(Step::Vector)
                    .chain(made.values().into_iter().map(of))
                    .collect()
            }
        }
    }

    /// Where a value is found, if it is a lane.
    pub fn lane(&self, value: Value) -> Option<(Index, usize)> {
        self.in_lanes.iter().find(|(known, _)| *known == value).map(|(_, place)| *place)
    }
}
