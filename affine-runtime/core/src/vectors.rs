//! Vectors of four doubles, by the instructions of each processor.

use crate::scalar::Scalar;

/// Vectors of four doubles, as a processor has them. A product and a sum are rounded once by processors whose vectors have
/// such an instruction, and otherwise as [`Scalar::fma`] of doubles rounds them.
pub trait Vectors: Copy {
    /// Wider ones are looked for at run time, and these are for processors without. There slopes and sums over stages are
    /// called, not inlined: what is compiled for every model is shorter.
    const IS_LAST_RESORT: bool = false;
    /// These with a multiply-add that is rounded as [`Scalar::fma`] of doubles: for steps whose equations are of numbers.
    #[inline(always)]
    fn rounding_as_numbers(self) -> impl Vectors {
        self
    }
    /// The same, as one vector where it might else be taken apart: stored so, it can be loaded so at once.
    fn whole(self, vector: [f64; 4]) -> [f64; 4];
    /// `left right + left' right'`, lane by lane.
    fn pair(self, one: [[f64; 4]; 2], other: [[f64; 4]; 2]) -> [f64; 4];
    /// `sum + left right`, lane by lane.
    fn plus_product(self, sum: [f64; 4], left: [f64; 4], right: [f64; 4]) -> [f64; 4];
    /// `sum + left right` of a number that fills no vector, rounded as a lane is.
    fn plus_one(self, sum: f64, left: f64, right: f64) -> f64;
    /// `sum - left right` likewise.
    #[inline(always)]
    fn minus_one(self, sum: f64, left: f64, right: f64) -> f64 {
        self.plus_one(sum, -left, right)
    }
    /// `sum + left right` in half a vector.
    fn plus_product_of_two(self, sum: [f64; 2], left: [f64; 2], right: [f64; 2]) -> [f64; 2];
    /// `sum - left right` in half a vector.
    fn minus_product_of_two(self, sum: [f64; 2], left: [f64; 2], right: [f64; 2]) -> [f64; 2];
    /// `sum - left right`, lane by lane.
    fn minus_product(self, sum: [f64; 4], left: [f64; 4], right: [f64; 4]) -> [f64; 4];
    /// `sum + (left right + left' right')`, lane by lane: the sum waits for one addition.
    fn plus_pair(self, sum: [f64; 4], one: [[f64; 4]; 2], other: [[f64; 4]; 2]) -> [f64; 4];
    /// `sum - (left right + left' right')`, lane by lane.
    fn minus_pair(self, sum: [f64; 4], one: [[f64; 4]; 2], other: [[f64; 4]; 2]) -> [f64; 4];
}

/// Numbers one by one, as every processor has them.
#[derive(Clone, Copy, Debug)]
pub struct Portable;

impl Vectors for Portable {
    #[inline(always)]
    fn whole(self, vector: [f64; 4]) -> [f64; 4] {
        vector
    }
    #[inline(always)]
    fn pair(self, one: [[f64; 4]; 2], other: [[f64; 4]; 2]) -> [f64; 4] {
        core::array::from_fn(|k| one[0][k].fma(one[1][k], other[0][k] * other[1][k]))
    }
    #[inline(always)]
    fn plus_product(self, sum: [f64; 4], left: [f64; 4], right: [f64; 4]) -> [f64; 4] {
        core::array::from_fn(|k| sum[k].plus(left[k], right[k]))
    }
    #[inline(always)]
    fn plus_one(self, sum: f64, left: f64, right: f64) -> f64 {
        sum.plus(left, right)
    }
    #[inline(always)]
    fn plus_product_of_two(self, sum: [f64; 2], left: [f64; 2], right: [f64; 2]) -> [f64; 2] {
        core::array::from_fn(|k| sum[k].plus(left[k], right[k]))
    }
    #[inline(always)]
    fn minus_product_of_two(self, sum: [f64; 2], left: [f64; 2], right: [f64; 2]) -> [f64; 2] {
        core::array::from_fn(|k| sum[k].minus(left[k], right[k]))
    }
    #[inline(always)]
    fn minus_product(self, sum: [f64; 4], left: [f64; 4], right: [f64; 4]) -> [f64; 4] {
        core::array::from_fn(|k| sum[k].minus(left[k], right[k]))
    }
    #[inline(always)]
    fn plus_pair(self, sum: [f64; 4], one: [[f64; 4]; 2], other: [[f64; 4]; 2]) -> [f64; 4] {
        let pair = self.pair(one, other);
        core::array::from_fn(|k| sum[k] + pair[k])
    }
    #[inline(always)]
    fn minus_pair(self, sum: [f64; 4], one: [[f64; 4]; 2], other: [[f64; 4]; 2]) -> [f64; 4] {
        let pair = self.pair(one, other);
        core::array::from_fn(|k| sum[k] - pair[k])
    }
}
