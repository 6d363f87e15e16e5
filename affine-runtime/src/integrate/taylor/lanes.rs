//! Convolutions in lanes: what emitted recurrences do in their loops.
//!
//! Doubles go through vector types. Left to itself the compiler drops the lanes that nobody reads, finds the rest to be
//! no vector any more, and computes lane by lane: two to three times slower.

use core::any::Any;

use wide::{f64x2, f64x4};

use crate::scalar::Scalar;

/// The lanes of a row that begin at a slot.
#[inline(always)]
pub fn lanes<T: Scalar, const W: usize>(row: &[T], slot: usize) -> [T; W] {
    // A slot of the row, so the branch is gone once the row has its length.
    match row.get(slot..).and_then(<[T]>::first_chunk) {
        Some(vector) => *vector,
        None => [T::zero(); W],
    }
}

/// `sum += left right`, lane by lane.
#[inline(always)]
pub fn add_products<T: Scalar, const W: usize>(sum: &mut [T; W], left: [T; W], right: [T; W]) {
    if let Some((sum, left, right)) = doubles(sum, &left, &right) {
        *sum = f64x4::from(left).mul_add(f64x4::from(right), f64x4::from(*sum)).into();
    } else if let Some((sum, left, right)) = doubles(sum, &left, &right) {
        *sum = f64x2::from(left).mul_add(f64x2::from(right), f64x2::from(*sum)).into();
    } else {
        for lane in 0..W {
            sum[lane] = left[lane].fma(right[lane], sum[lane]);
        }
    }
}

/// `sum -= left right`, lane by lane.
#[inline(always)]
pub fn subtract_products<T: Scalar, const W: usize>(sum: &mut [T; W], left: [T; W], right: [T; W]) {
    if let Some((sum, left, right)) = doubles(sum, &left, &right) {
        *sum = f64x4::from(left).mul_neg_add(f64x4::from(right), f64x4::from(*sum)).into();
    } else if let Some((sum, left, right)) = doubles(sum, &left, &right) {
        *sum = f64x2::from(left).mul_neg_add(f64x2::from(right), f64x2::from(*sum)).into();
    } else {
        for lane in 0..W {
            sum[lane] = (-left[lane]).fma(right[lane], sum[lane]);
        }
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

/// The same, where the lanes are `V` doubles: known when the call is compiled.
#[inline(always)]
fn doubles<'s, T: Scalar, const W: usize, const V: usize>(
    sum: &'s mut [T; W],
    left: &[T; W],
    right: &[T; W],
) -> Option<(&'s mut [f64; V], [f64; V], [f64; V])> {
    let left: &[f64; V] = (left as &dyn Any).downcast_ref()?;
    let right: &[f64; V] = (right as &dyn Any).downcast_ref()?;
    Some(((sum as &mut dyn Any).downcast_mut()?, *left, *right))
}
