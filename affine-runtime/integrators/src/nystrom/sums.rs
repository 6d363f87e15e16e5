//! Linear combinations of halves of states, four components to a vector: left to itself the compiler adds number by
//! number.

use super::tableau::{MOST_STAGES, Row};
use affine_core::__private::Vectors;
use affine_core::model::StateVector;
use affine_core::scalar::Scalar;

/// `sum_j a_j k_j` over the stages of a row.
#[inline(always)]
pub(super) fn of_row<H: StateVector<f64>>(vectors: impl Vectors, stages: &[H; MOST_STAGES], row: Row) -> H {
    let mut sum = H::zeros();
    for (stage, coefficient) in row {
        // A stage there is, so that nothing is left out.
        if let Some(stage) = stages.get(stage - 1) {
            plus_multiple(vectors, &mut sum, stage, *coefficient);
        }
    }
    sum
}

/// `sum += factor term`.
#[inline(always)]
pub(super) fn plus_multiple<H: StateVector<f64>>(vectors: impl Vectors, sum: &mut H, term: &H, factor: f64) {
    let (sums, single_sums) = sum.as_mut().as_chunks_mut();
    let (terms, single_terms) = term.as_ref().as_chunks();
    for (sum, term) in sums.iter_mut().zip(terms) {
        *sum = vectors.plus_product(*sum, *term, [factor; 4]);
    }
    for (sum, term) in single_sums.iter_mut().zip(single_terms) {
        *sum = term.fma(factor, *sum);
    }
}
