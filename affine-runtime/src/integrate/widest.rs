//! Hot code for the vectors that the processor has, not only those that every processor of the target has.
//!
//! On x86-64 the default target has vectors of two doubles and instructions that overwrite an operand. What goes
//! through [`widest`] is compiled a second time for AVX2 and runs so where the processor, asked once, has it. Nothing
//! is fused and no sum is reordered in either: the results are the same to the last bit.

use super::taylor::{Portable, Vectors};

/// What is worth compiling twice. Only what is inlined into `run` is.
pub(crate) trait Work {
    /// What comes out.
    type Output;
    /// Does it; to be `#[inline(always)]`.
    fn run(self, vectors: impl Vectors) -> Self::Output;
}

/// The work done, with the widest vectors there are.
#[cfg(all(feature = "std", target_arch = "x86_64", not(target_feature = "avx2")))]
#[inline(always)]
pub(crate) fn widest<W: Work>(work: W) -> W::Output {
    match pulp::x86::V3::try_new() {
        Some(vectors) => vectors.vectorize(Once { work, vectors }),
        None => work.run(Portable),
    }
}

/// The work done: the target says what vectors there are.
#[cfg(not(all(feature = "std", target_arch = "x86_64", not(target_feature = "avx2"))))]
#[inline(always)]
pub(crate) fn widest<W: Work>(work: W) -> W::Output {
    work.run(Portable)
}

#[cfg(all(feature = "std", target_arch = "x86_64", not(target_feature = "avx2")))]
struct Once<W> {
    work: W,
    vectors: pulp::x86::V3,
}

#[cfg(all(feature = "std", target_arch = "x86_64", not(target_feature = "avx2")))]
impl<W: Work> pulp::NullaryFnOnce for Once<W> {
    type Output = W::Output;
    #[inline(always)]
    fn call(self) -> W::Output {
        self.work.run(self.vectors)
    }
}
