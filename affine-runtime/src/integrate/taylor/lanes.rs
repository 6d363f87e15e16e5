//! Convolutions in lanes: what emitted recurrences do in their loops. Written so that a vector of lanes stays in
//! registers.

use crate::scalar::Scalar;

/// `sum += left right`, lane by lane.
#[inline(always)]
pub fn add_products<T: Scalar, const W: usize>(sum: &mut [T; W], left: [T; W], right: [T; W]) {
    for lane in 0..W {
        sum[lane] = left[lane].fma(right[lane], sum[lane]);
    }
}

/// `sum -= left right`, lane by lane.
#[inline(always)]
pub fn subtract_products<T: Scalar, const W: usize>(sum: &mut [T; W], left: [T; W], right: [T; W]) {
    for lane in 0..W {
        sum[lane] = (-left[lane]).fma(right[lane], sum[lane]);
    }
}

/// `sum += factor left`.
#[inline(always)]
pub fn add_multiple<T: Scalar, const W: usize>(sum: &mut [T; W], left: [T; W], factor: T) {
    add_products(sum, left, [factor; W]);
}

/// `sum -= factor left`.
#[inline(always)]
pub fn subtract_multiple<T: Scalar, const W: usize>(sum: &mut [T; W], left: [T; W], factor: T) {
    subtract_products(sum, left, [factor; W]);
}
