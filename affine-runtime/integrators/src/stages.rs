//! Linear combinations of the stages of a step.

pub(super) mod by_rows;

use affine_core::model::StateVector;
use affine_core::scalar::Scalar;

/// `sum_j a_j k_j` of pairs (stage, coefficient), stages counted from 1.
#[inline(always)]
pub(super) fn combination<S: StateVector<f64>, const TERMS: usize>(
    stages: &[S],
    row: &[(usize, f64); TERMS],
) -> S {
    let mut sum = S::zeros();
    let [(first, leading), ref rest @ ..] = row[..] else { return sum };
    for (i, sum) in sum.as_mut().iter_mut().enumerate() {
        *sum = stages[first - 1].as_ref()[i] * leading;
        for (stage, coefficient) in rest {
            *sum = stages[stage - 1].as_ref()[i].fma(*coefficient, *sum);
        }
    }
    sum
}

/// `y + h sum_j a_j k_j` of pairs (stage, coefficient), stages counted from 1, the last of which is `last`, the newest as a
/// rule: it enters last, so that what depends on it waits for two operations and not for four.
#[inline(always)]
pub(super) fn moved<S: StateVector<f64>, const TERMS: usize>(
    y: &S,
    h: f64,
    (stages, last): (&[S], &S),
    row: &[(usize, f64); TERMS],
) -> S {
    let mut moved = *y;
    let [ref earlier @ .., (_, newest)] = row[..] else { return moved };
    for (i, moved) in moved.as_mut().iter_mut().enumerate() {
        if let [(first, leading), rest @ ..] = earlier {
            let mut sum = stages[first - 1].as_ref()[i] * leading;
            for (stage, coefficient) in rest {
                sum = stages[stage - 1].as_ref()[i].fma(*coefficient, sum);
            }
            *moved = sum.fma(h, *moved);
        }
        *moved = last.as_ref()[i].fma(h * newest, *moved);
    }
    moved
}

/// The coefficients of one row less those of another that stands in the same stages.
pub(super) const fn difference<const TERMS: usize>(
    row: [(usize, f64); TERMS],
    other: &[(usize, f64)],
) -> [(usize, f64); TERMS] {
    let mut difference = row;
    let mut k = 0;
    while k < TERMS {
        let mut j = 0;
        while j < other.len() {
            if other[j].0 == row[k].0 {
                difference[k].1 -= other[j].1;
            }
            j += 1;
        }
        k += 1;
    }
    difference
}
