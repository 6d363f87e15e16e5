//! Convolutions in lanes: what emitted recurrences do in their loops.
//!
//! Doubles go through vector types. Left to itself the compiler drops the lanes that nobody reads, finds the rest to be
//! no vector any more, and computes lane by lane, which is slower.

use core::any::Any;

use wide::{f64x2, f64x4};

use crate::scalar::Scalar;

/// Vectors of four doubles, as a processor has them; what it rounds is the same on all.
pub trait Vectors: Copy {
    /// `left/right`, lane by lane.
    fn quotient(self, left: [f64; 4], right: [f64; 4]) -> [f64; 4];
    /// `sum + left right`, lane by lane.
    fn plus_product(self, sum: [f64; 4], left: [f64; 4], right: [f64; 4]) -> [f64; 4];
    /// `sum - left right`, lane by lane.
    fn minus_product(self, sum: [f64; 4], left: [f64; 4], right: [f64; 4]) -> [f64; 4];
}

/// The vectors that every processor of the target has.
#[derive(Clone, Copy, Debug)]
pub struct Portable;

impl Vectors for Portable {
    #[inline(always)]
    fn quotient(self, left: [f64; 4], right: [f64; 4]) -> [f64; 4] {
        (f64x4::from(left) / f64x4::from(right)).into()
    }
    #[inline(always)]
    fn plus_product(self, sum: [f64; 4], left: [f64; 4], right: [f64; 4]) -> [f64; 4] {
        f64x4::from(left).mul_add(f64x4::from(right), f64x4::from(sum)).into()
    }
    #[inline(always)]
    fn minus_product(self, sum: [f64; 4], left: [f64; 4], right: [f64; 4]) -> [f64; 4] {
        f64x4::from(left).mul_neg_add(f64x4::from(right), f64x4::from(sum)).into()
    }
}

/// AVX2: found at run time on targets that do not promise it, so nothing is fused there either.
#[cfg(all(feature = "std", target_arch = "x86_64", not(target_feature = "avx2")))]
impl Vectors for pulp::x86::V3 {
    #[inline(always)]
    fn quotient(self, left: [f64; 4], right: [f64; 4]) -> [f64; 4] {
        pulp::cast(self.div_f64x4(pulp::cast(left), pulp::cast(right)))
    }
    #[inline(always)]
    fn plus_product(self, sum: [f64; 4], left: [f64; 4], right: [f64; 4]) -> [f64; 4] {
        let product = self.mul_f64x4(pulp::cast(left), pulp::cast(right));
        pulp::cast(self.add_f64x4(pulp::cast(sum), product))
    }
    #[inline(always)]
    fn minus_product(self, sum: [f64; 4], left: [f64; 4], right: [f64; 4]) -> [f64; 4] {
        let product = self.mul_f64x4(pulp::cast(left), pulp::cast(right));
        pulp::cast(self.sub_f64x4(pulp::cast(sum), product))
    }
}

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
        *sum = f64x2::from(left).mul_add(f64x2::from(right), f64x2::from(*sum)).into();
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
        *sum = f64x2::from(left).mul_neg_add(f64x2::from(right), f64x2::from(*sum)).into();
    } else {
        for lane in 0..W {
            sum[lane] = (-left[lane]).fma(right[lane], sum[lane]);
        }
    }
}

/// `sum += factor left`.
#[inline(always)]
pub fn add_multiple<T: Scalar, const W: usize>(
    vectors: impl Vectors,
    sum: &mut [T; W],
    left: [T; W],
    factor: T,
) {
    add_products(vectors, sum, left, [factor; W]);
}

/// `sum -= factor left`.
#[inline(always)]
pub fn subtract_multiple<T: Scalar, const W: usize>(
    vectors: impl Vectors,
    sum: &mut [T; W],
    left: [T; W],
    factor: T,
) {
    subtract_products(vectors, sum, left, [factor; W]);
}

/// `left/divisor`, lane by lane.
#[inline(always)]
pub fn divided<T: Scalar, const W: usize>(vectors: impl Vectors, left: [T; W], divisor: T) -> [T; W] {
    let mut quotient = left;
    let divisors = [divisor; W];
    if let Some((quotient, left, right)) = doubles(&mut quotient, &left, &divisors) {
        *quotient = vectors.quotient(left, right);
    } else if let Some((quotient, left, right)) = doubles(&mut quotient, &left, &divisors) {
        *quotient = (f64x2::from(left) / f64x2::from(right)).into();
    } else {
        quotient.iter_mut().for_each(|lane| *lane /= divisor);
    }
    quotient
}

/// Writes the lanes of a row that begin at a slot.
#[inline(always)]
pub fn set_lanes<T: Scalar, const W: usize>(row: &mut [T], slot: usize, vector: [T; W]) {
    if let Some(lanes) = row.get_mut(slot..).and_then(<[T]>::first_chunk_mut) {
        *lanes = vector;
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
