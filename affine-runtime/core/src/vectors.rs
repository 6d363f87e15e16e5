//! Vectors of four doubles, by the instructions of each processor.

use core::array;

use crate::scalar::Scalar;

/// The target promises a correctly rounded multiply-add: [`Scalar::fma`] of doubles is one, and so is that of everything
/// made of them. Elsewhere it is a product and a sum, each rounded.
pub const IS_FUSED: bool = cfg!(all(feature = "std", any(target_feature = "fma", target_arch = "aarch64")));

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
    #[inline(always)]
    fn whole(self, vector: [f64; 4]) -> [f64; 4] {
        vector
    }
    /// `sum + left right` of a number that fills no vector, rounded as a lane is.
    fn plus_one(self, sum: f64, left: f64, right: f64) -> f64;
    /// `sum - left right` likewise.
    #[inline(always)]
    fn minus_one(self, sum: f64, left: f64, right: f64) -> f64 {
        self.plus_one(sum, -left, right)
    }
    /// `left right + left' right'`, lane by lane.
    fn pair(self, [a, b]: [[f64; 4]; 2], [c, d]: [[f64; 4]; 2]) -> [f64; 4] {
        array::from_fn(|k| self.plus_one(c[k] * d[k], a[k], b[k]))
    }
    /// `sum + left right`, lane by lane.
    #[inline(always)]
    fn plus_product(self, sum: [f64; 4], left: [f64; 4], right: [f64; 4]) -> [f64; 4] {
        array::from_fn(|k| self.plus_one(sum[k], left[k], right[k]))
    }
    /// `sum - left right`, lane by lane.
    fn minus_product(self, sum: [f64; 4], left: [f64; 4], right: [f64; 4]) -> [f64; 4] {
        array::from_fn(|k| self.minus_one(sum[k], left[k], right[k]))
    }
    /// `sum + left right` in half a vector.
    #[inline(always)]
    fn plus_product_of_two(self, sum: [f64; 2], left: [f64; 2], right: [f64; 2]) -> [f64; 2] {
        array::from_fn(|k| self.plus_one(sum[k], left[k], right[k]))
    }
    /// `sum + (left right + left' right')`, lane by lane: the sum waits for one addition.
    fn plus_pair(self, sum: [f64; 4], one: [[f64; 4]; 2], other: [[f64; 4]; 2]) -> [f64; 4] {
        array::from_fn(|k| sum[k] + self.pair(one, other)[k])
    }
    /// `sum - (left right + left' right')`, lane by lane.
    fn minus_pair(self, sum: [f64; 4], one: [[f64; 4]; 2], other: [[f64; 4]; 2]) -> [f64; 4] {
        array::from_fn(|k| sum[k] - self.pair(one, other)[k])
    }
}

/// Numbers one by one, as every processor has them.
#[derive(Clone, Copy, Debug)]
pub struct Portable;

impl Vectors for Portable {
    #[inline(always)]
    fn plus_one(self, sum: f64, left: f64, right: f64) -> f64 {
        sum.plus(left, right)
    }
}
