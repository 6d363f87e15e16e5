//! Hot code for the vectors that the processor has, not only those that every processor of the target has.
//!
//! On x86-64 the default target has vectors of two doubles and instructions that overwrite an operand. What goes
//! through [`widest`] is compiled a second time for AVX2 and runs so where the processor, asked once, has it. No sum is
//! reordered. A multiply-add of vectors is rounded once there, and twice by a processor without: that is the one thing by which
//! machines differ, and [`FusedArithmetic::here`] tells it. A target that promises AVX2 takes the same copies, which name their vectors:
//! what leaves them to the compiler keeps them in memory.

use core::fmt;

#[cfg(all(feature = "std", target_arch = "x86_64"))]
use super::vectors::Avx2;
use super::vectors::Baseline;
use affine_core::__private::Vectors;
use affine_core::__private::numerics::IS_FUSED;

/// Where a product and a sum are rounded once, in a fused multiply-add, and not twice.
///
/// Machines of one kind give the same bits. Between kinds the last bits of a step differ, and what a motion makes of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum FusedArithmetic {
    /// Neither in vectors nor in numbers.
    Nowhere,
    /// Where steps are in vectors, single bodies and lanes alike, and not in numbers: on x86-64 with AVX2, which the target
    /// does not promise.
    InVectors,
    /// In numbers as well: on AArch64, and where the target promises such an instruction.
    Everywhere,
}

impl fmt::Display for FusedArithmetic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Nowhere => "nowhere",
            Self::InVectors => "in vectors",
            Self::Everywhere => "everywhere",
        })
    }
}

impl FusedArithmetic {
    /// Where multiply-adds are fused on this processor, by code that is compiled as this is.
    #[must_use]
    pub fn here() -> Self {
        match (IS_FUSED, has_fused_vectors()) {
            (true, _) => Self::Everywhere,
            (false, true) => Self::InVectors,
            (false, false) => Self::Nowhere,
        }
    }
}

#[cfg(all(feature = "std", target_arch = "x86_64"))]
fn has_fused_vectors() -> bool {
    pulp::x86::V3::try_new().is_some()
}

#[cfg(not(all(feature = "std", target_arch = "x86_64")))]
fn has_fused_vectors() -> bool {
    false
}

/// What is worth compiling twice. Only what is inlined into `run` is.
pub(crate) trait Work {
    /// The result of the work.
    type Output;
    /// Does it; to be `#[inline(always)]`.
    fn run(self, vectors: impl Vectors) -> Self::Output;
}

/// The work done, with the widest vectors there are.
#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[inline(always)]
pub(crate) fn widest<W: Work>(work: W) -> W::Output {
    match pulp::x86::V3::try_new() {
        Some(vectors) => vectors.vectorize(Once { work, vectors: Avx2::<true>(vectors) }),
        None => work.run(Baseline),
    }
}

/// The work done: the target says what vectors there are.
#[cfg(not(all(feature = "std", target_arch = "x86_64")))]
#[inline(always)]
pub(crate) fn widest<W: Work>(work: W) -> W::Output {
    work.run(Baseline)
}

/// A function called that is compiled a second time, if it is inlined: its loops are in the widest vectors there are. Rust fuses
/// no multiply-add that is not asked for, so that each copy gives the same bits.
#[inline(always)]
pub fn vectorized<R>(function: impl FnOnce() -> R) -> R {
    struct Called<F>(F);
    impl<R, F: FnOnce() -> R> Work for Called<F> {
        type Output = R;
        #[inline(always)]
        fn run(self, _vectors: impl Vectors) -> R {
            (self.0)()
        }
    }
    widest(Called(function))
}

/// The work done, with the most registers there are: a loop over more vectors than sixteen is worth a third time. With
/// AVX-512 there are thirty-two, also of the vectors of AVX2, and an operand that one number of memory fills needs none.
#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[inline(always)]
pub(crate) fn roomiest<W: Work>(work: W) -> W::Output {
    match pulp::x86::V4::try_new() {
        Some(vectors) => vectors.vectorize(Once { work, vectors: Avx2::<true>(*vectors) }),
        None => widest(work),
    }
}

/// The work done: the target says what registers there are.
#[cfg(not(all(feature = "std", target_arch = "x86_64")))]
#[inline(always)]
pub(crate) fn roomiest<W: Work>(work: W) -> W::Output {
    widest(work)
}

#[cfg(all(feature = "std", target_arch = "x86_64"))]
struct Once<W, V> {
    work: W,
    vectors: V,
}

#[cfg(all(feature = "std", target_arch = "x86_64"))]
impl<W: Work, V: Vectors> pulp::NullaryFnOnce for Once<W, V> {
    type Output = W::Output;
    #[inline(always)]
    fn call(self) -> W::Output {
        self.work.run(self.vectors)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use affine_core::__private::numerics::Portable;

    /// Products added and subtracted in lanes, and a loop over components that compilers turn into vectors.
    #[derive(Clone, Copy)]
    struct Sums([f64; 4]);

    impl Work for Sums {
        type Output = [f64; 4];
        #[inline(always)]
        fn run(self, vectors: impl Vectors) -> [f64; 4] {
            let mut sum = self.0;
            for _ in 0..50 {
                sum = vectors.plus_product(sum, sum, [0.37, -0.81, 1e-3, 0.1]);
                sum = vectors.minus_product(self.0, sum, [0.29, 0.7, -0.3, 0.9]);
                sum = vectors.minus_pair(sum, [self.0, sum], [sum, [0.21; 4]]);
                sum = vectors.plus_pair(sum, [sum, sum], [self.0, vectors.whole(self.0)]);
                sum[0] = vectors.plus_one(sum[0], sum[1], -0.3);
                [sum[0], sum[1]] =
                    vectors.plus_product_of_two([sum[0], sum[1]], [sum[2], sum[3]], [0.3, -0.1]);
                for (sum, start) in sum.iter_mut().zip(&self.0) {
                    *sum = *sum * 0.3 + start * (1.0 - *sum);
                }
            }
            sum
        }
    }

    /// Numbers one by one, each multiply-add by the function of the standard library.
    #[derive(Clone, Copy)]
    struct ByTheLibrary;

    impl Vectors for ByTheLibrary {
        fn plus_one(self, sum: f64, left: f64, right: f64) -> f64 {
            left.mul_add(right, sum)
        }
    }

    #[test]
    fn a_multiply_add_of_wider_vectors_is_rounded_once() {
        let sums = Sums([0.1, 1.0 / 3.0, -0.7, 0.9]);
        let expected = match FusedArithmetic::here() {
            FusedArithmetic::Nowhere => sums.run(Portable),
            FusedArithmetic::InVectors | FusedArithmetic::Everywhere => sums.run(ByTheLibrary),
        };
        assert!(expected.iter().all(|v| v.is_finite() && *v != 0.0), "{expected:?}");
        assert_eq!(widest(sums).map(f64::to_bits), expected.map(f64::to_bits));
        assert_eq!(roomiest(sums).map(f64::to_bits), expected.map(f64::to_bits));
    }

    /// Sums on vectors that round as numbers.
    #[derive(Clone, Copy)]
    struct AsNumbers(Sums);

    impl Work for AsNumbers {
        type Output = [f64; 4];
        #[inline(always)]
        fn run(self, vectors: impl Vectors) -> [f64; 4] {
            self.0.run(vectors.rounding_as_numbers())
        }
    }

    #[test]
    fn what_rounds_as_numbers_does_so_on_any_vectors() {
        let sums = Sums([0.1, 1.0 / 3.0, -0.7, 0.9]);
        let expected = sums.run(Portable).map(f64::to_bits);
        assert_eq!(widest(AsNumbers(sums)).map(f64::to_bits), expected);
        assert_eq!(roomiest(AsNumbers(sums)).map(f64::to_bits), expected);
    }

    #[test]
    fn the_baseline_rounds_as_numbers_do() {
        let sums = Sums([0.1, 1.0 / 3.0, -0.7, 0.9]);
        assert_eq!(sums.run(Baseline).map(f64::to_bits), sums.run(Portable).map(f64::to_bits));
        assert_eq!(
            sums.run(ByTheLibrary) == sums.run(Portable),
            IS_FUSED,
            "numbers are fused everywhere or nowhere"
        );
    }
}
