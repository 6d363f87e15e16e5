//! Linear combinations of halves of states, four components to a vector. Left to itself the compiler unrolls a step into
//! operations on single numbers.

use crate::integrate::taylor::Vectors;
use crate::model::StateVector;
use crate::scalar::Scalar;

/// `sum_j a_j k_j` of pairs (stage, coefficient), stages counted from 1.
#[inline(always)]
pub(super) fn sum<H: StateVector<f64>>(vectors: impl Vectors, stages: &[H], terms: &[(usize, f64)]) -> H {
    let mut sum = H::zeros();
    for (stage, coefficient) in terms {
        plus_multiple(vectors, &mut sum, &stages[stage - 1], *coefficient);
    }
    sum
}

/// `sum += factor term`.
#[inline(always)]
pub(super) fn plus_multiple<H: StateVector<f64>>(
    vectors: impl Vectors,
    sum: &mut H,
    term: &H,
    factor: f64,
) {
    let (sums, single_sums) = sum.as_mut().as_chunks_mut();
    let (terms, single_terms) = term.as_ref().as_chunks();
    for (sum, term) in sums.iter_mut().zip(terms) {
        *sum = vectors.plus_product(*sum, *term, [factor; 4]);
    }
    for (sum, term) in single_sums.iter_mut().zip(single_terms) {
        *sum = term.fma(factor, *sum);
    }
}
