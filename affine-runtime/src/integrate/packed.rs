//! States and right-hand sides in vectors of four doubles.
//!
//! A compiler that is left to find vectors in a right-hand side over single components finds some, and spends as many
//! instructions on taking them apart and putting them together again as on arithmetic: between them and the sums over
//! stages, which are vectors, all components change places twice in every stage.

use core::ops::{Add, Index, Mul, Neg, Sub};

use super::taylor::Vectors;
use crate::model::StateVector;

/// Four doubles that are computed with together, on the vectors `V` of a processor. Nothing is fused but where the
/// target says so for numbers as well: each lane has the bits that the same operations have outside of it.
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

    /// `self + a b`, as [`Scalar::plus`](crate::scalar::Scalar::plus) of doubles rounds it.
    #[must_use]
    #[inline(always)]
    pub fn plus(self, a: Self, b: Self) -> Self {
        Self { lanes: self.vectors.plus_product(self.lanes, a.lanes, b.lanes), ..self }
    }

    /// `self - a b`, as [`Scalar::minus`](crate::scalar::Scalar::minus) of doubles rounds it.
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

/// `y' = f(t, y)` of states `S` in vectors, where `f` depends on constants `C`.
pub trait Packing<S, C> {
    /// A state in vectors.
    type Packed: StateVector<f64>;

    /// The state in vectors; some components may stand in several lanes, and some lanes may hold none.
    fn packed(&self, state: &S) -> Self::Packed;

    /// The state of vectors.
    fn unpacked(&self, packed: &Self::Packed) -> S;

    /// `f(t, y)`, with the bits that it has over single components.
    fn slope(&self, vectors: impl Vectors, t: f64, constants: &C, packed: &Self::Packed) -> Self::Packed;
}

/// `sum_j a_j k_j` of pairs (stage, coefficient), stages counted from 1, with the bits of
/// [`combination`](super::stages::combination).
#[inline(always)]
pub(super) fn combination<S: StateVector<f64>, const TERMS: usize>(
    vectors: impl Vectors,
    stages: &[S],
    row: &[(usize, f64); TERMS],
) -> S {
    let mut sum = S::zeros();
    let [(first, leading), ref rest @ ..] = row[..] else { return sum };
    let of = |stage: usize, k: usize| stages[stage - 1].as_ref().as_chunks().0[k];
    for (k, sum) in sum.as_mut().as_chunks_mut().0.iter_mut().enumerate() {
        *sum = vectors.plus_product(NOTHING, of(first, k), [leading; 4]);
        for (stage, coefficient) in rest {
            *sum = vectors.plus_product(*sum, of(*stage, k), [*coefficient; 4]);
        }
    }
    sum
}

/// `y + h sum_j a_j k_j`, with the bits of [`moved`](super::stages::moved).
#[inline(always)]
pub(super) fn moved<S: StateVector<f64>, const TERMS: usize>(
    vectors: impl Vectors,
    (y, h): (&S, f64),
    (stages, last): (&[S], &S),
    row: &[(usize, f64); TERMS],
) -> S {
    let mut moved = *y;
    let [ref earlier @ .., (_, newest)] = row[..] else { return moved };
    let of = |stage: usize, k: usize| stages[stage - 1].as_ref().as_chunks().0[k];
    for (k, moved) in moved.as_mut().as_chunks_mut().0.iter_mut().enumerate() {
        if let [(first, leading), rest @ ..] = earlier {
            let mut sum = vectors.plus_product(NOTHING, of(*first, k), [*leading; 4]);
            for (stage, coefficient) in rest {
                sum = vectors.plus_product(sum, of(*stage, k), [*coefficient; 4]);
            }
            *moved = vectors.plus_product(*moved, sum, [h; 4]);
        }
        *moved = vectors.plus_product(*moved, last.as_ref().as_chunks().0[k], [h * newest; 4]);
    }
    moved
}

/// `y + h rise`.
#[inline(always)]
pub(super) fn plus_multiple<S: StateVector<f64>>(vectors: impl Vectors, y: &S, h: f64, rise: &S) -> S {
    let mut sum = *y;
    let chunks = sum.as_mut().as_chunks_mut().0.iter_mut().zip(rise.as_ref().as_chunks().0);
    chunks.for_each(|(sum, rise)| *sum = vectors.plus_product(*sum, *rise, [h; 4]));
    sum
}
