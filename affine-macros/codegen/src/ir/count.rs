//! Operation counts.

use super::{Op, Program};

/// Numbers of operations; a multiply-add counts as both, a change of sign as none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Operations {
    /// Multiplications.
    pub mul: usize,
    /// Additions and subtractions.
    pub add: usize,
    /// Divisions.
    pub div: usize,
}

impl Operations {
    /// Additions and multiplications, with a division as heavy as eight of them.
    #[must_use]
    pub fn weight(self) -> usize {
        self.mul + self.add + 8 * self.div
    }
}

impl Program {
    /// Counts the operations.
    #[must_use]
    pub fn operations(&self) -> Operations {
        let mut count = Operations::default();
        for step in &self.steps {
            match step {
                Op::Input(_) | Op::Constant(_) | Op::Neg(_) => {}
                Op::Add(..) | Op::Sub(..) => count.add += 1,
                Op::Mul(..) => count.mul += 1,
                Op::Div(..) => count.div += 1,
                Op::MulAdd(..) => {
                    count.mul += 1;
                    count.add += 1;
                }
            }
        }
        count
    }
}
