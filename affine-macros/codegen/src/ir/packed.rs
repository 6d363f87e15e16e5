//! Right-hand sides in vectors of four: lanes that go through the same operations go through them together.
//!
//! Superword parallelism (S. Larsen, S. Amarasinghe, Proc. PLDI 2000, 145-156), from the results down: the components of
//! the state stand in vectors of four, rows of a matrix as a rule, and so do their rates. Where the lanes of a vector are
//! made by one operation each, and the same, its operands are vectors again: a vector of the state, one value in all
//! lanes, or numbers gathered from anywhere, whichever costs least. What is read by no vector but through such values
//! stays scalar.
//!
//! Operations are those of the scalar program, lane by lane, and so are the results but for the sign of what is not a
//! number. Lanes that lack an operation get one that changes nothing: `x + -0`, which is `x` for every `x`.

mod layout;
mod pack;
mod run;
mod schedule;

use super::{Op, Program, Value};
use layout::Layout;
use pack::pack;
use schedule::scheduled;

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
    #[must_use]
    pub fn operands(self) -> Vec<Index> {
        match self {
            Self::State(_) | Self::All(_) | Self::Gathered(_) => Vec::new(),
            Self::Neg(a) => vec![a],
            Self::Add(a, b) | Self::Sub(a, b) | Self::Mul(a, b) => vec![a, b],
            Self::MulAdd(a, b, c) => vec![a, b, c],
        }
    }

    /// Are its lanes computed there, or read from the state?
    #[must_use]
    pub fn makes(self) -> bool {
        !matches!(self, Self::All(_) | Self::Gathered(_))
    }

    /// The values that it reads.
    #[must_use]
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
    #[must_use]
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

/// Steps beyond which code that is there a dozen times, once in each stage, is not worth having twice: without optimisation
/// a step of a method keeps all of its values on the stack.
const MOST_STEPS: usize = 384;
/// Instructions for each vector of the state in a stage of the method of order 8, of whose rows the average has five
/// terms.
const OF_A_SUM: usize = 13;
/// Instructions for each component of the state that a compiler adds in shuffles between vectors and numbers; measured:
/// 251 in all for P2 and 198 for P1, of 14 and 12 components with 92 and 66 operations.
const OF_A_SHUFFLE: usize = 7;
/// Where it was not measured whether it pays: states of the plane.
const FEWEST: usize = 12;

impl Packed {
    /// The right-hand side whose results are the rates of the components of `groups`, in their order; `None` where
    /// scalars do as well, where it is long, or where it calls functions of the runtime.
    #[must_use]
    pub fn of(program: &Program, groups: &[(&'static str, Vec<String>)]) -> Option<Self> {
        let components: usize = groups.iter().map(|(_, names)| names.len()).sum();
        if components < FEWEST || program.steps.len() > MOST_STEPS {
            return None;
        }
        let scalar = program.steps.iter().map(weight).sum::<usize>()
            + OF_A_SHUFFLE * components
            + OF_A_SUM * components.div_ceil(4);
        let (packed, cost) = Self::cheapest(program, groups)?;
        // Four fifths: less is not worth the lines.
        (5 * cost <= 4 * scalar).then_some(packed)
    }

    /// By the best layout of the state, chosen group by group, and about how many instructions a stage takes; `None`
    /// where runtime functions are called.
    #[must_use]
    pub fn cheapest(program: &Program, groups: &[(&'static str, Vec<String>)]) -> Option<(Self, usize)> {
        if !program.calls.is_empty() {
            return None;
        }
        let with = |layout: &Layout| pack(program, layout.names(), layout.vectors());
        let mut layout = Layout::in_rows(groups);
        let mut best = with(&layout);
        for alternative in layout.alternatives() {
            let other = layout.with(&alternative);
            let draft = with(&other);
            if draft.cost < best.cost {
                (layout, best) = (other, draft);
            }
        }
        let cost = best.cost;
        Some((scheduled(program, best), cost))
    }

    /// The scalar program of what is computed outside of lanes and gathered into them.
    #[must_use]
    pub fn read(&self) -> Program {
        let mut program = self.program.clone();
        let inputs = self.steps.iter().flat_map(|step| match *step {
            Step::Scalar(value) => self.program.steps[value].operands(),
            Step::Vector(index) => self.vectors[index].made.values(),
        });
        let read = inputs.filter(|value| matches!(self.program.steps[*value], Op::Input(_)));
        program.outputs = read.map(|value| (String::new(), value)).collect();
        program.without_dead_steps()
    }

    /// The steps that a step reads.
    #[must_use]
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
    #[must_use]
    pub fn lane(&self, value: Value) -> Option<(Index, usize)> {
        self.in_lanes.iter().find(|(known, _)| *known == value).map(|(_, place)| *place)
    }
}

/// Instructions of a scalar step, about.
fn weight(step: &Op) -> usize {
    match step {
        Op::Input(_) | Op::Constant(_) | Op::Neg(_) => 0,
        Op::Add(..) | Op::Sub(..) | Op::Mul(..) => 1,
        Op::MulAdd(..) => 2,
        Op::Div(..) => 8,
        Op::Call(..) => 20,
    }
}
