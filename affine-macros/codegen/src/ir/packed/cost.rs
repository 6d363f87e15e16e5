//! What vectors and numbers cost, in instructions.

use super::vector::{Four, Lane};
use crate::ir::{Op, Program};

/// Instructions for each vector of the state in a stage of the method of order 8, of whose rows the average has five
/// terms.
pub(super) const OF_A_SUM: usize = 13;
/// Instructions for each component of the state that a compiler adds in shuffles between vectors and numbers; measured:
/// 251 in all for P2 and 198 for P1, of 14 and 12 components with 92 and 66 operations.
pub(super) const OF_A_SHUFFLE: usize = 7;

/// Instructions of a scalar step, about.
pub(super) fn of_number(step: &Op) -> usize {
    match step {
        Op::Input(_) | Op::Constant(_) | Op::Neg(_) => 0,
        Op::Add(..) | Op::Sub(..) | Op::Mul(..) => 1,
        Op::MulAdd(..) => 2,
        Op::Div(..) => 8,
        Op::Call(..) => 20,
    }
}

/// Instructions of a vector, about.
pub(super) fn of_vector(program: &Program, four: Four) -> usize {
    match four {
        Four::State(_) | Four::Neg(_) => 0,
        // A number in memory goes to all lanes as it is read.
        Four::All(value) => usize::from(!matches!(program.steps[value], Op::Constant(_))),
        Four::Gathered(lanes) => lanes
            .into_iter()
            .filter_map(Lane::value)
            .filter(|v| !matches!(program.steps[*v], Op::Constant(_)))
            .count(),
        Four::Add(..) | Four::Sub(..) | Four::Mul(..) => 1,
        Four::MulAdd(..) => 2,
    }
}
