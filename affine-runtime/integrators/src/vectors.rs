//! Vectors of four doubles, as processors have them.
//!
//! No array is mapped here: `map` of an array is a call in builds whose parts are not optimised together, and a call leaves the
//! vectors of its caller.

use affine_core::__private::Vectors;
#[cfg(all(feature = "std", target_arch = "x86_64"))]
use affine_core::__private::numerics::IS_FUSED;
use affine_core::scalar::Scalar;
use wide::{f64x2, f64x4};

/// The vectors that every processor of the target has.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Baseline;

impl Vectors for Baseline {
    const IS_LAST_RESORT: bool = cfg!(all(feature = "std", target_arch = "x86_64"));
    #[inline(always)]
    fn pair(self, one: [[f64; 4]; 2], other: [[f64; 4]; 2]) -> [f64; 4] {
        f64x4::from(one[0]).mul_add(f64x4::from(one[1]), f64x4::from(other[0]) * f64x4::from(other[1])).into()
    }
    #[inline(always)]
    fn plus_product(self, sum: [f64; 4], left: [f64; 4], right: [f64; 4]) -> [f64; 4] {
        f64x4::from(left).mul_add(f64x4::from(right), f64x4::from(sum)).into()
    }
    #[inline(always)]
    fn plus_one(self, sum: f64, left: f64, right: f64) -> f64 {
        left.fma(right, sum)
    }
    #[inline(always)]
    fn plus_product_of_two(self, sum: [f64; 2], left: [f64; 2], right: [f64; 2]) -> [f64; 2] {
        f64x2::from(left).mul_add(f64x2::from(right), f64x2::from(sum)).into()
    }
    #[inline(always)]
    fn minus_product(self, sum: [f64; 4], left: [f64; 4], right: [f64; 4]) -> [f64; 4] {
        f64x4::from(left).mul_neg_add(f64x4::from(right), f64x4::from(sum)).into()
    }
    #[inline(always)]
    fn plus_pair(self, sum: [f64; 4], one: [[f64; 4]; 2], other: [[f64; 4]; 2]) -> [f64; 4] {
        (f64x4::from(sum) + f64x4::from(self.pair(one, other))).into()
    }
    #[inline(always)]
    fn minus_pair(self, sum: [f64; 4], one: [[f64; 4]; 2], other: [[f64; 4]; 2]) -> [f64; 4] {
        (f64x4::from(sum) - f64x4::from(self.pair(one, other))).into()
    }
}

/// AVX2, found at run time where the target does not promise it, with the multiply-add that came with it, or with one that is
/// rounded as that of numbers.
#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Avx2<const FUSED: bool>(pub(crate) pulp::x86::V3);

#[cfg(all(feature = "std", target_arch = "x86_64"))]
impl<const FUSED: bool> Vectors for Avx2<FUSED> {
    #[inline(always)]
    fn rounding_as_numbers(self) -> impl Vectors {
        Avx2::<false>(self.0)
    }
    #[inline(always)]
    fn whole(self, vector: [f64; 4]) -> [f64; 4] {
        // The factor is gone when the compiler has seen that all of the vector is read.
        pulp::cast(self.0.mul_f64x4(pulp::cast(vector), self.0.splat_f64x4(1.0)))
    }
    #[inline(always)]
    fn pair(self, [a, b]: [[f64; 4]; 2], [c, d]: [[f64; 4]; 2]) -> [f64; 4] {
        let product = pulp::cast(self.0.mul_f64x4(pulp::cast(c), pulp::cast(d)));
        self.plus_product(product, a, b)
    }
    #[inline(always)]
    fn plus_product(self, sum: [f64; 4], left: [f64; 4], right: [f64; 4]) -> [f64; 4] {
        let (sum, left, right) = (pulp::cast(sum), pulp::cast(left), pulp::cast(right));
        pulp::cast(if const { FUSED || IS_FUSED } {
            self.0.mul_add_f64x4(left, right, sum)
        } else {
            self.0.add_f64x4(sum, self.0.mul_f64x4(left, right))
        })
    }
    #[inline(always)]
    fn plus_one(self, sum: f64, left: f64, right: f64) -> f64 {
        if const { FUSED } { left.mul_add(right, sum) } else { left.fma(right, sum) }
    }
    #[inline(always)]
    fn plus_product_of_two(self, sum: [f64; 2], left: [f64; 2], right: [f64; 2]) -> [f64; 2] {
        if const { !FUSED } {
            return f64x2::from(left).mul_add(f64x2::from(right), f64x2::from(sum)).into();
        }
        let (sum, left, right) = (pulp::cast(sum), pulp::cast(left), pulp::cast(right));
        pulp::cast(self.0.mul_add_f64x2(left, right, sum))
    }
    #[inline(always)]
    fn minus_product(self, sum: [f64; 4], left: [f64; 4], right: [f64; 4]) -> [f64; 4] {
        let (sum, left, right) = (pulp::cast(sum), pulp::cast(left), pulp::cast(right));
        pulp::cast(if const { FUSED || IS_FUSED } {
            self.0.negate_mul_add_f64x4(left, right, sum)
        } else {
            self.0.sub_f64x4(sum, self.0.mul_f64x4(left, right))
        })
    }
    #[inline(always)]
    fn plus_pair(self, sum: [f64; 4], one: [[f64; 4]; 2], other: [[f64; 4]; 2]) -> [f64; 4] {
        pulp::cast(self.0.add_f64x4(pulp::cast(sum), pulp::cast(self.pair(one, other))))
    }
    #[inline(always)]
    fn minus_pair(self, sum: [f64; 4], one: [[f64; 4]; 2], other: [[f64; 4]; 2]) -> [f64; 4] {
        pulp::cast(self.0.sub_f64x4(pulp::cast(sum), pulp::cast(self.pair(one, other))))
    }
}
