//! Jacobians of straight-line code, forward along its operations: of each result the derivatives by those arguments alone that it
//! depends on, the values shared by all of them.

use super::tape::{Kind, Operand, Operation};
use crate::dual::Dual;
use crate::scalar::Scalar;

/// The derivative of an operation by one of the numbers that it reads.
enum Partial<T> {
    One,
    MinusOne,
    Number(T),
}

impl<T: Scalar> Partial<T> {
    fn of(kind: Kind, k: usize, operands: [T; 3]) -> Self {
        match (kind, k) {
            (Kind::Add, _) | (Kind::Sub, 0) | (Kind::Fma, 2) => Self::One,
            (Kind::Sub | Kind::Neg, _) => Self::MinusOne,
            (Kind::Mul | Kind::Fma, k) => Self::Number(operands[1 - k]),
            _ => {
                let mut varied = operands.map(Dual::fixed);
                varied[k].slope = T::one();
                Self::Number(kind.of(varied).slope)
            }
        }
    }

    /// Its product with a slope, which is 1 where the number that is read is an argument.
    fn times(&self, slope: T, is_argument: bool) -> T {
        match self {
            Self::One => slope,
            Self::MinusOne => -slope,
            Self::Number(partial) if is_argument => *partial,
            Self::Number(partial) => *partial * slope,
        }
    }
}

/// The derivatives of results by so many of the first arguments that are not zero, each given to `each` with its row and column.
pub(super) fn differentiated<T: Scalar>(
    (tape, results): (&[Operation], &[Operand]),
    (arguments, columns): (&[T], usize),
    mut each: impl FnMut(usize, usize, T),
) {
    let mut values: Vec<T> = arguments.to_vec();
    // Sorted by columns.
    let mut slopes: Vec<Vec<(usize, T)>> = (0..arguments.len())
        .map(|node| (node < columns).then(|| (node, T::one())).into_iter().collect())
        .collect();
    for (kind, operands) in &tape[arguments.len()..] {
        let numbers = operands.map(|operand| match operand {
            Operand::Node(node) => values[node],
            Operand::Constant(value) => T::constant(value, 0.0),
        });
        let mut sums: Vec<(usize, T)> = Vec::new();
        for (k, operand) in operands.iter().enumerate() {
            let Operand::Node(from) = *operand else { continue };
            let partial = Partial::of(*kind, k, numbers);
            for (column, slope) in &slopes[from] {
                let term = partial.times(*slope, from < arguments.len());
                match sums.binary_search_by_key(column, |(own, _)| *own) {
                    Ok(place) => sums[place].1 += term,
                    Err(place) => sums.insert(place, (*column, term)),
                }
            }
        }
        values.push(kind.of(numbers));
        slopes.push(sums);
    }
    for (row, result) in results.iter().enumerate() {
        if let Operand::Node(node) = *result {
            slopes[node].iter().for_each(|(column, slope)| each(row, *column, *slope));
        }
    }
}
