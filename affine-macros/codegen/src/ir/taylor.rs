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
mod recurrence;
mod rules;

use super::Program;
use crate::symbol::Symbol;
use lanes::Packed;

pub use recurrence::{Column, Factor, Pass, Place, Recurrence, Rule, Series, Term, sums};

impl Recurrence {
    /// The recurrence of `y' = f(y)`: `states` are the inputs that move, in the order of the outputs, their rates.
    pub fn of(program: &Program, states: &[Symbol]) -> Self {
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
}

/// The rates, and what a row holds besides, of the program.
fn start(program: &Program, row: &[Option<Series>]) -> Program {
    let kept = row.iter().flatten().filter(|series| !series.rate).map(|series| series.value);
    let mut start = program.clone();
    start.outputs.extend(kept.map(|value| (program.name(value), value)));
    quotients::divided(&start)
}
