//! Operation counts, those of the runtime functions that are called among them.

use super::{Op, Program};
use crate::algebra::Function;
use crate::algebra::kernel::{Callee, Group};

use super::call::Call;

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
    /// The operations of both counts together.
    fn with(self, other: Self) -> Self {
        Self {
            mul: self.mul + other.mul,
            add: self.add + other.add,
            div: self.div + other.div,
            sqrt: self.sqrt + other.sqrt,
            exp: self.exp + other.exp,
            ln: self.ln + other.ln,
        }
    }

    /// Additions and multiplications, with a division as heavy as eight of them and a function as twenty.
    pub fn weight(self) -> usize {
        self.mul + self.add + 8 * self.div + 20 * (self.sqrt + self.exp + self.ln)
    }
}

impl Program {
    /// Counts the operations.
    pub fn operations(&self) -> Operations {
        let mut count = Operations::default();
        for step in &self.steps {
            match step {
                Op::Input(_) | Op::Constant(_) | Op::Neg(_) | Op::Call(Function::Abs | Function::Sign, _) => {
                }
                Op::Call(Function::Sqrt | Function::Cbrt, _) => count.sqrt += 1,
                // A number of any kind computes it so.
                Op::Call(Function::InverseCbrt, _) => {
                    count.sqrt += 1;
                    count.div += 1;
                }
                Op::Call(Function::Ln | Function::Asinh, _) => count.ln += 1,
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
        for call in &self.calls {
            count = count.with(kernel_operations(call));
        }
        count
    }
}

/// What a runtime function executes.
fn kernel_operations(call: &Call) -> Operations {
    let n = match call.arguments.as_slice() {
        [Group::Matrix(rows)] | [_, Group::Matrix(rows), _] => rows.len(),
        _ => 0,
    };
    match call.callee {
        // What a field of the model computes is not known here.
        Callee::Custom(..) => Operations::default(),
        // exp(x) - 1, and exp(-x) - 1 from it.
        Callee::Elongation => Operations { exp: 1, mul: 3, add: 1, div: 2, ..Operations::default() },
        // Of a half of the argument.
        Callee::Turn => Operations { exp: 2, mul: 7, div: 1, sqrt: 1, ..Operations::default() },
        // Eighteen products of a matrix and a vector, where the time is short.
        Callee::Fading => {
            Operations { mul: 18 * (n * n + n), add: 18 * (n * n + n), ..Operations::default() }
        }
        // Duplications, with Newton's iteration in each: scaling, invariants, 40 iterations, and a series.
        Callee::Ellipsoidal => Operations { mul: 397, add: 317, div: 82, sqrt: 66, ..Operations::default() },
        // Backwards through them, with the slopes of the series and of the invariants.
        Callee::EllipsoidalSlopes => {
            Operations { mul: 646, add: 458, div: 114, sqrt: 66, ..Operations::default() }
        }
        // One-sided Jacobi: scaling, so many rotations of two columns of two matrices, lengths.
        Callee::Stretches => {
            let rotations = if n == 2 { 2 } else { 12 };
            Operations {
                mul: 3 * n * n + n * (n + 1) + rotations * (11 * n + 6),
                add: n * n + n * (n - 1) + rotations * (7 * n + 4),
                div: 1 + 2 * rotations,
                sqrt: 1 + 2 * rotations + n,
                ..Operations::default()
            }
        }
        // With the columns of a third matrix, two of their products and a weight to each angle, and `arsinh` as logarithm.
        Callee::LogStretches => {
            let rotations = if n == 2 { 2 } else { 12 };
            let Operations { mul, add, div, sqrt, .. } =
                kernel_operations(&Call { callee: Callee::Stretches, ..call.clone() });
            Operations {
                mul: mul + 2 * n * n + 2 + n * (2 * n + 3) + rotations * (11 * n + 14),
                add: add + 2 * n * n + 1 + n * (2 * n + 1) + rotations * (9 * n + 6),
                div: div + 1 + n + rotations,
                sqrt: sqrt + 1,
                ln: n,
                ..Operations::default()
            }
        }
    }
}
