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

mod cost;
mod layout;
mod pack;
mod schedule;
mod vector;

use super::Program;
use crate::symbol::Symbol;
use cost::{OF_A_SHUFFLE, OF_A_SUM};
use layout::Layout;
use pack::pack;
use schedule::scheduled;

pub use vector::{Four, Index, Lane, Lanes, Packed, Step, Vector};

/// Steps beyond which code that is there a dozen times, once in each stage, is not worth having twice: without optimisation
/// a step of a method keeps all of its values on the stack.
const MOST_STEPS: usize = 384;
/// Where it was not measured whether it pays: states of the plane.
const FEWEST: usize = 12;

impl Packed {
    /// The right-hand side whose results are the rates of the components of `groups`, in their order; `None` where
    /// scalars do as well, where it is long, or where it calls functions of the runtime.
    pub fn of(program: &Program, groups: &[Vec<Symbol>]) -> Option<Self> {
        let components: usize = groups.iter().map(Vec::len).sum();
        if components < FEWEST || program.steps.len() > MOST_STEPS {
            return None;
        }
        let scalar = program.steps.iter().map(cost::of_number).sum::<usize>()
            + OF_A_SHUFFLE * components
            + OF_A_SUM * components.div_ceil(4);
        let (packed, cost) = Self::cheapest(program, groups)?;
        // Four fifths: less is not worth the lines.
        (5 * cost <= 4 * scalar).then_some(packed)
    }

    /// By the best layout of the state, chosen group by group, and about how many instructions a stage takes; `None`
    /// where runtime functions are called.
    pub fn cheapest(program: &Program, groups: &[Vec<Symbol>]) -> Option<(Self, usize)> {
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
}
