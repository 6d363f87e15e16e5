//! States and right-hand sides in vectors of four doubles.
//!
//! A compiler that is left to find vectors in a right-hand side over single components finds some, and spends as many
//! instructions on taking them apart and putting them together again as on arithmetic: between them and the sums over
//! stages, which are vectors, all components change places twice in every stage.

use core::ops::{Add, Index, Mul, Neg, Sub};

use crate::system::StateVector;
use crate::vectors::Vectors;

/// Four doubles that are computed with together, on the vectors `V` of a processor: a product and a sum are rounded as it
/// rounds them, everything else as it is outside of lanes.
#[derive(Clone, Copy, Debug)]
pub struct Four<V> {
    vectors: V,
    lanes: [f64; 4],
}

/// `x + -0` is `x` for every `x`, and compilers know it.
const NOTHING: [f64; 4] = [-0.0; 4];
const ONES: [f64; 4] = [1.0; 4];

impl<V: Vectors> Four<V> {
    /// With these lanes.
    #[inline(always)]
    pub fn of(vectors: V, lanes: [f64; 4]) -> Self {
        Self { vectors, lanes }
    }

    /// `self + a b`, rounded once or twice as the processor does.
    #[must_use]
    #[inline(always)]
    pub fn plus(self, a: Self, b: Self) -> Self {
        Self { lanes: self.vectors.plus_product(self.lanes, a.lanes, b.lanes), ..self }
    }

    /// `self - a b`, rounded likewise.
    #[must_use]
    #[inline(always)]
    pub fn minus(self, a: Self, b: Self) -> Self {
        Self { lanes: self.vectors.minus_product(self.lanes, a.lanes, b.lanes), ..self }
    }
}

impl<V: Vectors> Add for Four<V> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { lanes: self.vectors.plus_product(self.lanes, other.lanes, ONES), ..self }
    }
}

impl<V: Vectors> Sub for Four<V> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { lanes: self.vectors.minus_product(self.lanes, other.lanes, ONES), ..self }
    }
}

impl<V: Vectors> Mul for Four<V> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self { lanes: self.vectors.plus_product(NOTHING, self.lanes, other.lanes), ..self }
    }
}

impl<V: Vectors> Neg for Four<V> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { lanes: self.vectors.minus_product(NOTHING, self.lanes, ONES), ..self }
    }
}

impl<V> Index<usize> for Four<V> {
    type Output = f64;
    #[inline(always)]
    fn index(&self, lane: usize) -> &f64 {
        &self.lanes[lane]
    }
}

/// A state as `L/4` vectors of four, where the processor reads and writes each at once.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(32))]
pub struct Packed<const L: usize>(pub [f64; L]);

impl<const L: usize> Packed<L> {
    /// The vectors.
    #[inline(always)]
    pub fn vectors<V: Vectors, const R: usize>(&self, vectors: V) -> [Four<V>; R] {
        let (chunks, _) = self.0.as_chunks();
        // As many as there are.
        core::array::from_fn(|k| Four::of(vectors, chunks.get(k).copied().unwrap_or([0.0; 4])))
    }

    /// The state of these vectors.
    #[inline(always)]
    pub fn of<V, const R: usize>(vectors: [Four<V>; R]) -> Self {
        let mut state = Self([0.0; L]);
        let (chunks, _) = state.0.as_chunks_mut();
        for (chunk, four) in chunks.iter_mut().zip(vectors) {
            *chunk = four.lanes;
        }
        state
    }
}

impl<const L: usize> AsRef<[f64]> for Packed<L> {
    #[inline(always)]
    fn as_ref(&self) -> &[f64] {
        &self.0
    }
}

impl<const L: usize> AsMut<[f64]> for Packed<L> {
    #[inline(always)]
    fn as_mut(&mut self) -> &mut [f64] {
        &mut self.0
    }
}

impl<const L: usize> StateVector<f64> for Packed<L> {
    const LEN: usize = L;
    #[inline(always)]
    fn zeros() -> Self {
        Self([0.0; L])
    }
}
