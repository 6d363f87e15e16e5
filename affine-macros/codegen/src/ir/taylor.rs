//! Recurrences of Taylor coefficients: from the program of `y' = f(y)` to rules for the coefficients of every value.
//!
//! With `v_k = v^(k)(t)/k!`, linear operations act coefficient by coefficient, a product is the Cauchy convolution
//! `(a b)_k = sum_(j = 0..k) a_j b_(k-j)`, and a function follows from the differential equation it satisfies (Jorba
//! and Zou, Experimental Mathematics 14 (2005) 99-117, Proposition 2.1; Griewank and Walther, Evaluating Derivatives,
//! section 13.2). At order `k` all convolutions are formed together, as vectors of lanes:
//!
//! * those of *ready* values (states and their linear combinations, known when order `k` begins) in full;
//! * the others from `j = 1` to `k - 1`; the two terms with `a_k` and `b_k` join when these are known.

mod columns;
mod companions;
mod lanes;
mod quotients;
mod rules;

use crate::algebra::Function;

use super::{Program, Value};
use lanes::Packed;

/// What has a history: a value, or `k v_k`, the coefficients of `t v'`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Series {
    /// The value.
    pub value: Value,
    /// `k v_k` in place of `v_k`.
    pub rate: bool,
}

impl Series {
    fn of(value: Value) -> Self {
        Self { value, rate: false }
    }

    fn rate(value: Value) -> Self {
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
    #[must_use]
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
    /// The recurrence of `y' = f(y)`: `states` are the inputs that move, in the order of the outputs, their rates.
    #[must_use]
    pub fn of(program: &Program, states: &[String]) -> Self {
        let program = companions::completed(program);
        let draft = rules::Draft::of(&program, states);
        let Packed { lanes, mut row, vectors, full, inner, places } =
            lanes::pack(&draft.products, draft.kept());
        let rules = draft.rules(&places);
        let columns = columns::find(&program, states, &rules, (&row[..vectors], lanes));
        // Vectors of all rows then begin at multiples of their length, and none lies across two lines of a cache.
        row.resize(row.len().next_multiple_of(lanes), None);
        let start = start(&program, &row);
        Self {
            start,
            columns,
            moving: draft.moving,
            ready: draft.ready,
            rules,
            lanes,
            row,
            vectors,
            full,
            inner,
            program,
        }
    }

    /// The slot that holds a series.
    #[must_use]
    pub fn slot(&self, series: Series) -> Option<usize> {
        self.row.iter().position(|kept| *kept == Some(series))
    }

    /// Multiplications of vectors for each step `j` of the convolutions.
    #[must_use]
    pub fn passes(&self) -> usize {
        self.full.len() + self.inner.len()
    }
}

/// The rates, and what a row holds besides, of the program.
fn start(program: &Program, row: &[Option<Series>]) -> Program {
    let kept = row.iter().flatten().filter(|series| !series.rate).map(|series| series.value);
    let mut start = program.clone();
    start.outputs.extend(kept.map(|value| (program.name(value), value)));
    quotients::divided(&start)
}

/// Number of sums of a list of passes.
#[must_use]
pub fn sums(passes: &[Pass]) -> usize {
    passes.iter().map(|pass| pass.sum + 1).max().unwrap_or(0)
}
