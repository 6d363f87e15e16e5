//! Sums over stages in vectors of four doubles.

use affine_core::__private::Vectors;
use affine_core::model::StateVector;

/// `x + -0` is `x` for every `x`, and compilers know it.
const NOTHING: [f64; 4] = [-0.0; 4];

/// `sum_j a_j k_j` of pairs (stage, coefficient), stages counted from 1, with the bits of
/// [`combination`](super::stages::combination).
#[inline(always)]
pub(super) fn combination<S: StateVector<f64>, const TERMS: usize>(
    vectors: impl Vectors,
    stages: &[S],
    row: &[(usize, f64); TERMS],
) -> S {
    let mut sum = S::zeros();
    let [(first, leading), ref rest @ ..] = row[..] else { return sum };
    let of = |stage: usize, k: usize| stages[stage - 1].as_ref().as_chunks().0[k];
    for (k, sum) in sum.as_mut().as_chunks_mut().0.iter_mut().enumerate() {
        *sum = vectors.plus_product(NOTHING, of(first, k), [leading; 4]);
        for (stage, coefficient) in rest {
            *sum = vectors.plus_product(*sum, of(*stage, k), [*coefficient; 4]);
        }
    }
    sum
}

/// `y + h sum_j a_j k_j`, with the bits of [`moved`](super::stages::moved).
#[inline(always)]
pub(super) fn moved<S: StateVector<f64>, const TERMS: usize>(
    vectors: impl Vectors,
    (y, h): (&S, f64),
    (stages, last): (&[S], &S),
    row: &[(usize, f64); TERMS],
) -> S {
    let mut moved = *y;
    let [ref earlier @ .., (_, newest)] = row[..] else { return moved };
    let of = |stage: usize, k: usize| stages[stage - 1].as_ref().as_chunks().0[k];
    for (k, moved) in moved.as_mut().as_chunks_mut().0.iter_mut().enumerate() {
        if let [(first, leading), rest @ ..] = earlier {
            let mut sum = vectors.plus_product(NOTHING, of(*first, k), [*leading; 4]);
            for (stage, coefficient) in rest {
                sum = vectors.plus_product(sum, of(*stage, k), [*coefficient; 4]);
            }
            *moved = vectors.plus_product(*moved, sum, [h; 4]);
        }
        *moved = vectors.plus_product(*moved, last.as_ref().as_chunks().0[k], [h * newest; 4]);
    }
    moved
}

/// `y + h rise`.
#[inline(always)]
pub(super) fn plus_multiple<S: StateVector<f64>>(vectors: impl Vectors, y: &S, h: f64, rise: &S) -> S {
    let mut sum = *y;
    let chunks = sum.as_mut().as_chunks_mut().0.iter_mut().zip(rise.as_ref().as_chunks().0);
    chunks.for_each(|(sum, rise)| *sum = vectors.plus_product(*sum, *rise, [h; 4]));
    sum
}
