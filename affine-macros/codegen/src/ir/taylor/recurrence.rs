//! A recurrence as data: what is kept of each order, the convolutions, and the rules of the coefficients.

use crate::algebra::fault::never_missing;
use crate::algebra::{Function, Rational};
use crate::ir::{Op, Program, Value};

/// What has a history: a value, or `k v_k`, the coefficients of `t v'`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Series {
    /// The value.
    pub value: Value,
    /// `k v_k` in place of `v_k`.
    pub rate: bool,
}

impl Series {
    pub(super) fn of(value: Value) -> Self {
        Self { value, rate: false }
    }

    pub(super) fn rate(value: Value) -> Self {
        Self { value, rate: true }
    }
}

/// The recurrence of a program.
#[derive(Clone, Debug)]
pub struct Recurrence {
    /// The program, with the companions that functions need (the cosine of a sine).
    pub program: Program,
    /// Rates, and what else a row keeps, at order zero.
    pub start: Program,
    /// Does a value depend on the state?
    pub moving: Vec<bool>,
    /// Values that are known when an order begins: states and linear combinations of them.
    pub ready: Vec<bool>,
    /// Rules in the order in which they apply.
    pub rules: Vec<(Value, Rule)>,
    /// Lanes of a vector.
    pub lanes: usize,
    /// What is kept of each order; `None` fills up the vectors.
    pub row: Vec<Option<Series>>,
    /// So many slots at the beginning stand in vectors.
    pub vectors: usize,
    /// Convolutions `j = 0..=k` of ready values.
    pub full: Vec<Pass>,
    /// Convolutions `j = 1..k` of the others.
    pub inner: Vec<Pass>,
    /// Vectors of states whose rates are the lanes of one sum.
    pub columns: Vec<Column>,
}

/// A vector of states, whose next coefficients are a sum's lanes divided by the order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Column {
    /// First slot of the vector.
    pub slot: usize,
    /// The sum, one of the full ones.
    pub sum: usize,
}

/// One multiplication of vectors in a convolution: `sum += left_j right_(k-j)`. Squares and others have sums apart.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pass {
    /// Index of the sum that it adds to.
    pub sum: usize,
    /// Is the product subtracted?
    pub negative: bool,
    /// First slot of the left vector.
    pub left: usize,
    /// The right factor.
    pub right: Factor,
}

impl Pass {
    /// A vector with itself: the terms `j` and `k - j` are equal.
    pub fn is_square(&self) -> bool {
        self.right == Factor::Vector(self.left)
    }
}

/// The right factor of a [`Pass`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Factor {
    /// The vector that begins at a slot.
    Vector(usize),
    /// One slot in every lane.
    Slot(usize),
}

/// Where a convolution is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// In the full ones, or the inner ones.
    pub full: bool,
    /// Index of the sum among these.
    pub sum: usize,
    /// Index of the lane in that sum.
    pub lane: usize,
}

/// How the coefficient `v_k`, `k > 0`, of a value comes about.
#[derive(Clone, Debug)]
pub enum Rule {
    /// A sum of terms, each with its sign: negative?
    Sum(Vec<(bool, Term)>),
    /// `a/b`: `v_k = (a_k - b_k v_0 - M)/b_0`, `M` the inner convolution of `b` and `v`.
    Quotient {
        /// `a`; `None` where it does not move.
        numerator: Option<Value>,
        /// `b`.
        denominator: Value,
        /// `M`.
        inner: Place,
    },
    /// A function of a value, with the inner convolutions that its differential equation needs.
    Function {
        /// The function.
        function: Function,
        /// Its argument.
        argument: Value,
        /// The companion: cosine of a sine and so on.
        companion: Option<Value>,
        /// The convolutions.
        inner: Vec<Place>,
    },
    /// The time: `t_1 = 1`, and nothing beyond.
    Time,
}

/// A summand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Term {
    /// `v_k`
    Value(Value),
    /// `c v_k` with a value `c` that does not move.
    Scaled(Value, Value),
    /// `v_k / c` with a value `c` that does not move.
    Divided(Value, Value),
    /// `v_k / (1/c)` with a number `c` that is no double.
    Over(Value, Value),
    /// Convolutions of products.
    Lane(Place),
    /// `a_0 b_k + a_k b_0`
    Ends(Value, Value),
}

impl Recurrence {
    /// The slot that holds a series.
    pub fn slot(&self, series: Series) -> Option<usize> {
        self.row.iter().position(|kept| *kept == Some(series))
    }

    /// Does any rule, or what is kept, read the order itself?
    pub fn reads_order(&self) -> bool {
        let weighted = |rule: &Rule| match rule {
            Rule::Function { function, .. } => !matches!(function, Function::Sqrt | Function::Abs),
            Rule::Time => true,
            Rule::Sum(_) | Rule::Quotient { .. } => false,
        };
        self.rules.iter().any(|(_, rule)| weighted(rule))
            || self.row.iter().flatten().any(|series| series.rate)
    }

    /// Is there a square root, or a size, of what moves?
    pub fn has_roots(&self) -> bool {
        let is_root = |rule: &Rule| match rule {
            Rule::Function { function, .. } => matches!(function, Function::Sqrt | Function::Abs),
            Rule::Time | Rule::Sum(_) | Rule::Quotient { .. } => false,
        };
        self.rules.iter().any(|(_, rule)| is_root(rule))
    }

    /// The number that a constant value is.
    pub fn number(&self, value: Value) -> Rational {
        match &self.program.steps[value] {
            Op::Constant(number) => number.clone(),
            _ => never_missing(None, "only constants are asked for their numbers", Rational::ONE),
        }
    }

    /// Multiplications of vectors for each step `j` of the convolutions.
    pub fn passes(&self) -> usize {
        self.full.len() + self.inner.len()
    }
}

/// Number of sums of a list of passes.
pub fn sums(passes: &[Pass]) -> usize {
    passes.iter().map(|pass| pass.sum + 1).max().unwrap_or(0)
}
