//! Hot code for the vectors that the processor has, not only those that every processor of the target has.
//!
//! On x86-64 the default target has vectors of two doubles and instructions that overwrite an operand. What goes
//! through [`widest`] is compiled a second time for AVX2 and runs so where the processor, asked once, has it. No sum is
//! reordered, and a multiply-add is fused where the target promises such an instruction: the results are the same to the
//! last bit. A target that promises AVX2 takes the same copies, which name their vectors: what leaves them to the compiler
//! keeps them in memory.

use super::vectors::Baseline;
#[cfg(all(feature = "std", target_arch = "x86_64"))]
use super::vectors::{Avx2, Avx512};
use affine_core::__private::Vectors;

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
        Some(vectors) => vectors.vectorize(Once { work, vectors: Avx2(vectors) }),
        None => work.run(Baseline),
    }
}

/// The work done: the target says what vectors there are.
#[cfg(not(all(feature = "std", target_arch = "x86_64")))]
#[inline(always)]
pub(crate) fn widest<W: Work>(work: W) -> W::Output {
    work.run(Baseline)
}

/// The work done, with the most registers there are: a loop over more vectors than sixteen is worth a third time. With
/// AVX-512 there are thirty-two of any width, and an operand that one number of memory fills needs none.
#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[inline(always)]
pub(crate) fn roomiest<W: Work>(work: W) -> W::Output {
    match pulp::x86::V4::try_new() {
        Some(vectors) => vectors.vectorize(Once { work, vectors: Avx512(vectors) }),
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
                for (sum, start) in sum.iter_mut().zip(&self.0) {
                    *sum = *sum * 0.3 + start * (1.0 - *sum);
                }
            }
            sum
        }
    }

    #[test]
    fn wider_vectors_round_the_same() {
        let sums = Sums([0.1, 1.0 / 3.0, -0.7, 0.9]);
        let plain = sums.run(Baseline);
        assert!(plain.iter().all(|v| v.is_finite() && *v != 0.0), "{plain:?}");
        assert_eq!(widest(sums).map(f64::to_bits), plain.map(f64::to_bits));
        assert_eq!(roomiest(sums).map(f64::to_bits), plain.map(f64::to_bits));
    }
}
