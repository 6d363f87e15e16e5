//! Operation counts.

use super::{Op, Program};
use crate::algebra::Function;

/// Numbers of operations; a multiply-add counts as both, a change of sign as none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Operations {
    /// Multiplications.
    pub mul: usize,
    /// Additions and subtractions.
    pub add: usize,
    /// Divisions.
    pub div: usize,
    /// Square and cube roots.
    pub sqrt: usize,
    /// Exponentials, hyperbolic and trigonometric functions.
    pub exp: usize,
    /// Logarithms.
    pub ln: usize,
}

impl Operations {
    /// Additions and multiplications, with a division as heavy as eight of them and a function as twenty.
    #[must_use]
    pub fn weight(self) -> usize {
        self.mul + self.add + 8 * self.div + 20 * (self.sqrt + self.exp + self.ln)
    }
}

impl Program {
    /// Counts the operations.
    #[must_use]
    pub fn operations(&self) -> Operations {
        let mut count = Operations::default();
        for step in &self.steps {
            match step {
                Op::Input(_) | Op::Constant(_) | Op::Neg(_) | Op::Call(Function::Abs, _) => {}
                Op::Call(Function::Sqrt | Function::Cbrt, _) => count.sqrt += 1,
                Op::Call(Function::Ln, _) => count.ln += 1,
                Op::Call(..) => count.exp += 1,
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
