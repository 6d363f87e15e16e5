//! Vectors of four doubles, by the instructions of each processor.

use wide::f64x4;

/// Vectors of four doubles, as a processor has them; what it rounds is the same on all.
pub trait Vectors: Copy {
    /// Wider ones are looked for at run time, and these are for processors without. There slopes and sums over stages are
    /// called, not inlined: what is compiled for every model is shorter.
    const IS_LAST_RESORT: bool = false;
    /// The same, as one vector where it might else be taken apart: stored so, it can be loaded so at once.
    fn whole(self, vector: [f64; 4]) -> [f64; 4];
    /// `left right + left' right'`, lane by lane.
    fn pair(self, one: [[f64; 4]; 2], other: [[f64; 4]; 2]) -> [f64; 4];
    /// `sum + left right`, lane by lane.
    fn plus_product(self, sum: [f64; 4], left: [f64; 4], right: [f64; 4]) -> [f64; 4];
    /// `sum - left right`, lane by lane.
    fn minus_product(self, sum: [f64; 4], left: [f64; 4], right: [f64; 4]) -> [f64; 4];
    /// `sum + (left right + left' right')`, lane by lane: the sum waits for one addition.
    fn plus_pair(self, sum: [f64; 4], one: [[f64; 4]; 2], other: [[f64; 4]; 2]) -> [f64; 4];
    /// `sum - (left right + left' right')`, lane by lane.
    fn minus_pair(self, sum: [f64; 4], one: [[f64; 4]; 2], other: [[f64; 4]; 2]) -> [f64; 4];
}

/// The vectors that every processor of the target has.
#[derive(Clone, Copy, Debug)]
pub struct Portable;

impl Vectors for Portable {
    const IS_LAST_RESORT: bool =
        cfg!(all(feature = "std", target_arch = "x86_64", not(target_feature = "avx2")));
    #[inline(always)]
    fn whole(self, vector: [f64; 4]) -> [f64; 4] {
        vector
    }
    #[inline(always)]
    fn pair(self, one: [[f64; 4]; 2], other: [[f64; 4]; 2]) -> [f64; 4] {
        let [[one, by], [other, with]] = [one, other].map(|factors| factors.map(f64x4::from));
        one.mul_add(by, other * with).into()
    }
    #[inline(always)]
    fn plus_product(self, sum: [f64; 4], left: [f64; 4], right: [f64; 4]) -> [f64; 4] {
        f64x4::from(left).mul_add(f64x4::from(right), f64x4::from(sum)).into()
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

/// AVX2: found at run time on targets that do not promise it, so nothing is fused there either.
#[cfg(all(feature = "std", target_arch = "x86_64", not(target_feature = "avx2")))]
impl Vectors for pulp::x86::V3 {
    #[inline(always)]
    fn whole(self, vector: [f64; 4]) -> [f64; 4] {
        // The factor is gone when the compiler has seen that all of the vector is read.
        pulp::cast(self.mul_f64x4(pulp::cast(vector), self.splat_f64x4(1.0)))
    }
    #[inline(always)]
    fn pair(self, one: [[f64; 4]; 2], other: [[f64; 4]; 2]) -> [f64; 4] {
        let [one, other] = [one, other].map(|[a, b]| self.mul_f64x4(pulp::cast(a), pulp::cast(b)));
        pulp::cast(self.add_f64x4(one, other))
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
    #[inline(always)]
    fn plus_pair(self, sum: [f64; 4], one: [[f64; 4]; 2], other: [[f64; 4]; 2]) -> [f64; 4] {
        pulp::cast(self.add_f64x4(pulp::cast(sum), pulp::cast(self.pair(one, other))))
    }
    #[inline(always)]
    fn minus_pair(self, sum: [f64; 4], one: [[f64; 4]; 2], other: [[f64; 4]; 2]) -> [f64; 4] {
        pulp::cast(self.sub_f64x4(pulp::cast(sum), pulp::cast(self.pair(one, other))))
    }
}

/// AVX-512, of which the vectors of AVX2 have use for the registers.
#[cfg(all(feature = "std", target_arch = "x86_64", not(target_feature = "avx2")))]
impl Vectors for pulp::x86::V4 {
    #[inline(always)]
    fn whole(self, vector: [f64; 4]) -> [f64; 4] {
        Vectors::whole(*self, vector)
    }
    #[inline(always)]
    fn pair(self, one: [[f64; 4]; 2], other: [[f64; 4]; 2]) -> [f64; 4] {
        Vectors::pair(*self, one, other)
    }
    #[inline(always)]
    fn plus_product(self, sum: [f64; 4], left: [f64; 4], right: [f64; 4]) -> [f64; 4] {
        Vectors::plus_product(*self, sum, left, right)
    }
    #[inline(always)]
    fn minus_product(self, sum: [f64; 4], left: [f64; 4], right: [f64; 4]) -> [f64; 4] {
        Vectors::minus_product(*self, sum, left, right)
    }
    #[inline(always)]
    fn plus_pair(self, sum: [f64; 4], one: [[f64; 4]; 2], other: [[f64; 4]; 2]) -> [f64; 4] {
        Vectors::plus_pair(*self, sum, one, other)
    }
    #[inline(always)]
    fn minus_pair(self, sum: [f64; 4], one: [[f64; 4]; 2], other: [[f64; 4]; 2]) -> [f64; 4] {
        Vectors::minus_pair(*self, sum, one, other)
    }
}
