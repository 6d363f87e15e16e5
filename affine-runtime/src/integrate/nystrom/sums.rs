//! Linear combinations of halves of states, four components to a vector: left to itself the compiler adds number by
//! number. In vectors of any processor, not in the widest: a step waits for one number after another, and gathering
//! those into wide vectors and taking them apart again costs more than it saves.

use wide::f64x4;

use crate::model::StateVector;
use crate::scalar::Scalar;

/// `sum_j a_j k_j` of pairs (stage, coefficient), stages counted from 1.
#[inline(always)]
pub(super) fn sum<H: StateVector<f64>>(stages: &[H], terms: &[(usize, f64)]) -> H {
    let mut sum = H::zeros();
    for (stage, coefficient) in terms {
        plus_multiple(&mut sum, &stages[stage - 1], *coefficient);
    }
    sum
}

/// `sum += factor term`.
#[inline(always)]
pub(super) fn plus_multiple<H: StateVector<f64>>(sum: &mut H, term: &H, factor: f64) {
    let (sums, single_sums) = sum.as_mut().as_chunks_mut();
    let (terms, single_terms) = term.as_ref().as_chunks();
    for (sum, term) in sums.iter_mut().zip(terms) {
        *sum = f64x4::from(*term).mul_add(f64x4::splat(factor), f64x4::from(*sum)).into();
    }
    for (sum, term) in single_sums.iter_mut().zip(single_terms) {
        *sum = term.fma(factor, *sum);
    }
}
