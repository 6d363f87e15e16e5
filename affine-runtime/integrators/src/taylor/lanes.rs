//! Convolutions in lanes: what emitted recurrences do in their loops.
//!
//! Doubles go through vector types. Left to itself the compiler drops the lanes that nobody reads, finds the rest to be
//! no vector any more, and computes lane by lane, which is slower.

use core::any::Any;
use core::ops::Neg;

use wide::f64x2;

use affine_core::__private::numerics::Vectors;
use affine_core::__private::{Divisor, over};
use affine_core::scalar::Scalar;

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
pub fn add_products<T: Scalar, const W: usize>(
    vectors: impl Vectors,
    sum: &mut [T; W],
    left: [T; W],
    right: [T; W],
) {
    if let Some((sum, left, right)) = doubles(sum, &left, &right) {
        *sum = vectors.plus_product(*sum, left, right);
    } else if let Some((sum, left, right)) = doubles(sum, &left, &right) {
        *sum = vectors.plus_product_of_two(*sum, left, right);
    } else if let Some(([sum], [left], [right])) = doubles(sum, &left, &right) {
        *sum = vectors.plus_one(*sum, left, right);
    } else {
        for lane in 0..W {
            sum[lane] = left[lane].fma(right[lane], sum[lane]);
        }
    }
}

/// `sum -= left right`, lane by lane.
#[inline(always)]
pub fn subtract_products<T: Scalar, const W: usize>(
    vectors: impl Vectors,
    sum: &mut [T; W],
    left: [T; W],
    right: [T; W],
) {
    if let Some((sum, left, right)) = doubles(sum, &left, &right) {
        *sum = vectors.minus_product(*sum, left, right);
    } else if let Some((sum, left, right)) = doubles(sum, &left, &right) {
        *sum = vectors.plus_product_of_two(*sum, left.map(Neg::neg), right);
    } else if let Some(([sum], [left], [right])) = doubles(sum, &left, &right) {
        *sum = vectors.minus_one(*sum, left, right);
    } else {
        for lane in 0..W {
            sum[lane] = (-left[lane]).fma(right[lane], sum[lane]);
        }
    }
}

/// `sum += factor left`.
#[inline(always)]
pub(super) fn add_multiple<T: Scalar, const W: usize>(
    vectors: impl Vectors,
    sum: &mut [T; W],
    left: [T; W],
    factor: T,
) {
    add_products(vectors, sum, left, [factor; W]);
}

/// `sum += left right + left' right'`, lane by lane: a product of two series has its terms in such pairs, `j` and `k - j`.
#[inline(always)]
pub fn add_pair<T: Scalar, const W: usize>(
    vectors: impl Vectors,
    sum: &mut [T; W],
    one: [[T; W]; 2],
    other: [[T; W]; 2],
) {
    if let Some((sum, one, other)) = pairs(sum, one, other) {
        *sum = vectors.plus_pair(*sum, one, other);
    } else if let Some((sum, one, other)) = pairs(sum, one, other) {
        *sum = (f64x2::from(*sum) + f64x2::from(pair_of_two(vectors, one, other))).into();
    } else {
        for lane in 0..W {
            sum[lane] += one[0][lane].fma(one[1][lane], other[0][lane] * other[1][lane]);
        }
    }
}

/// `sum -= left right + left' right'`, lane by lane.
#[inline(always)]
pub fn subtract_pair<T: Scalar, const W: usize>(
    vectors: impl Vectors,
    sum: &mut [T; W],
    one: [[T; W]; 2],
    other: [[T; W]; 2],
) {
    if let Some((sum, one, other)) = pairs(sum, one, other) {
        *sum = vectors.minus_pair(*sum, one, other);
    } else if let Some((sum, one, other)) = pairs(sum, one, other) {
        *sum = (f64x2::from(*sum) - f64x2::from(pair_of_two(vectors, one, other))).into();
    } else {
        for lane in 0..W {
            sum[lane] -= one[0][lane].fma(one[1][lane], other[0][lane] * other[1][lane]);
        }
    }
}

/// `left right + left' right'` in half a vector.
#[inline(always)]
fn pair_of_two(vectors: impl Vectors, one: [[f64; 2]; 2], other: [[f64; 2]; 2]) -> [f64; 2] {
    let product = f64x2::from(other[0]) * f64x2::from(other[1]);
    vectors.plus_product_of_two(product.into(), one[0], one[1])
}

/// The rows before the middle, the one in the middle where their number is odd, those behind: a convolution pairs them
/// off, from the middle on, so that what was computed last comes last.
#[inline(always)]
pub fn halves<R>(rows: &[R]) -> (&[R], Option<&R>, &[R]) {
    let (low, rest) = rows.split_at(rows.len() / 2);
    match rest {
        [middle, high @ ..] if high.len() == low.len() => (low, Some(middle), high),
        high => (low, None, high),
    }
}

/// `vector/2`: the term in the middle of a square, whose other terms come in equal pairs and are formed once.
#[inline(always)]
pub fn halved<T: Scalar, const W: usize>(vectors: impl Vectors, vector: [T; W]) -> [T; W] {
    let mut half = [T::zero(); W];
    add_multiple(vectors, &mut half, vector, T::constant(0.5, 0.0));
    half
}

/// `2 sum`: of a square, both terms of each pair.
#[inline(always)]
pub fn doubled<T: Scalar, const W: usize>(vectors: impl Vectors, sum: [T; W]) -> [T; W] {
    let mut twice = sum;
    add_multiple(vectors, &mut twice, sum, T::one());
    twice
}

/// The rows but for the first and the last.
#[inline(always)]
pub fn between<R>(rows: &[R]) -> &[R] {
    match rows {
        [_, middle @ .., _] => middle,
        _ => &[],
    }
}

/// `left/divisor`, lane by lane.
#[inline(always)]
pub fn divided<T: Scalar, const W: usize>(
    vectors: impl Vectors,
    left: [T; W],
    divisor: Divisor<T>,
) -> [T; W] {
    let (one, other) = ([left, [divisor.half; W]], [left, [divisor.rest; W]]);
    let mut quotient = left;
    if let Some((quotient, one, other)) = pairs(&mut quotient, one, other) {
        *quotient = vectors.pair(one, other);
    } else if let Some((quotient, one, other)) = pairs(&mut quotient, one, other) {
        *quotient = pair_of_two(vectors, one, other);
    } else {
        quotient.iter_mut().for_each(|lane| *lane = over(*lane, divisor));
    }
    quotient
}

/// Writes the lanes of a row that begin at a slot.
#[inline(always)]
pub fn set_lanes<T: Scalar, const W: usize>(
    vectors: impl Vectors,
    row: &mut [T],
    slot: usize,
    vector: [T; W],
) {
    if let Some(lanes) = row.get_mut(slot..).and_then(<[T]>::first_chunk_mut) {
        *lanes = vector;
        if let Some((lanes, vector, _)) = doubles(lanes, &vector, &vector) {
            *lanes = vectors.whole(vector);
        }
    }
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

/// The same of two products.
#[inline(always)]
#[allow(clippy::type_complexity, reason = "a name for two pairs of vectors would say less")]
fn pairs<T: Scalar, const W: usize, const V: usize>(
    sum: &mut [T; W],
    one: [[T; W]; 2],
    other: [[T; W]; 2],
) -> Option<(&mut [f64; V], [[f64; V]; 2], [[f64; V]; 2])> {
    let (sum, left, right) = doubles(sum, &one[0], &one[1])?;
    let (mut unread, with) = (other[0], &other[1]);
    let (_, other, with) = doubles(&mut unread, &other[0], with)?;
    Some((sum, [left, right], [other, with]))
}
