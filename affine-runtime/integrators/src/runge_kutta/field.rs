//! What a Runge-Kutta method integrates, in the variables in which its steps are taken.

use core::marker::PhantomData;

use crate::lie::{Coordinates, Flat, Sum};
use crate::packed;
use crate::stages::{self, by_rows};
use crate::vectors::Baseline;
use crate::widest::{Work, widest};
use affine_core::__private::Vectors;
use affine_core::model::StateVector;
use affine_core::scalar::Scalar;
use affine_core::system::Packing;

/// The first, eleven more, that at the end of the step, and three for dense output.
pub(super) const STAGES: usize = 16;

/// `z' = f(t, z)` as the stages of a step see it, and the sums over them.
pub trait Stages<L: StateVector<f64>> {
    /// `f(t, z)`.
    fn slope(&self, t: f64, z: &L) -> L;

    /// `sum_j a_j k_j` of pairs (stage, coefficient), stages counted from 1.
    #[inline(always)]
    fn combination<const TERMS: usize>(&self, stages: &[L], row: &[(usize, f64); TERMS]) -> L {
        stages::combination(stages, row)
    }

    /// `z + h sum_j a_j k_j`, where nothing but the last stage of the row is waited for: it stands beside the others, where
    /// it can be in registers.
    #[inline(always)]
    fn moved<const TERMS: usize>(&self, z: &L, h: f64, stages: (&[L], &L), row: &[(usize, f64); TERMS]) -> L {
        stages::moved(z, h, stages, row)
    }

    /// `z + h rise`.
    #[inline(always)]
    fn plus_multiple(&self, z: &L, h: f64, rise: &L) -> L {
        let mut sum = *rise;
        for (sum, z) in sum.as_mut().iter_mut().zip(z.as_ref()) {
            *sum = sum.fma(h, *z);
        }
        sum
    }
}

impl<L: StateVector<f64>, F: Fn(f64, &L) -> L> Stages<L> for F {
    #[inline(always)]
    fn slope(&self, t: f64, z: &L) -> L {
        self(t, z)
    }
}

/// `y' = f(t, y)` of states `S` with what steps are taken in: `L` is how coordinates of the kind `C` are stored.
///
/// Functions of states are such, with `L = S`; [`InVectors`] is the other kind.
pub trait Field<S, C, L: StateVector<f64>> {
    /// Sums over stages are in vectors throughout.
    const IS_IN_VECTORS: bool = false;

    /// `f(t, y)`.
    fn rate(&self, t: f64, y: &S) -> S;

    /// Coordinates, or a rate of them, as they are stored.
    fn stored(&self, z: &S) -> L;

    /// Coordinates, or a rate of them, from what is stored.
    fn read(&self, stored: &L) -> S;

    /// `z'` as a function of time and of coordinates around `base`.
    fn stages<V: Vectors>(&self, vectors: V, coordinates: C, base: &Sum<S>) -> impl Stages<L>;

    /// `f` at the state `y` with the coordinates `z`, and `z'` there.
    fn at(&self, vectors: impl Vectors, coordinates: C, t: f64, place: (&S, &L)) -> (S, L);
}

impl<S: StateVector<f64>, C: Coordinates<S>, F: Fn(f64, &S) -> S> Field<S, C, S> for F {
    #[inline(always)]
    fn rate(&self, t: f64, y: &S) -> S {
        self(t, y)
    }
    #[inline(always)]
    fn stored(&self, z: &S) -> S {
        *z
    }
    #[inline(always)]
    fn read(&self, stored: &S) -> S {
        *stored
    }
    #[inline(always)]
    fn stages<V: Vectors>(&self, _vectors: V, coordinates: C, base: &Sum<S>) -> impl Stages<S> {
        let slope = move |t: f64, z: &S| {
            let state = coordinates.state(base, z).value;
            coordinates.velocity(&state, z, &self(t, &state))
        };
        StagesInNumbers { slope, vectors: PhantomData::<V> }
    }
    #[inline(always)]
    fn at(&self, _vectors: impl Vectors, coordinates: C, t: f64, (y, z): (&S, &S)) -> (S, S) {
        let rate = self(t, y);
        (rate, coordinates.velocity(y, z, &rate))
    }
}

/// Equations whose steps are taken in vectors of four, and the constants of the trajectory.
#[derive(Clone, Copy, Debug)]
pub struct InVectors<R, K>(pub R, pub K);

impl<S: StateVector<f64>, K, R: Packing<S, K>> Field<S, Flat, R::Packed> for InVectors<R, K> {
    const IS_IN_VECTORS: bool = true;
    #[inline(always)]
    fn rate(&self, t: f64, y: &S) -> S {
        self.0.unpacked(&slope(self, Baseline, t, &self.0.packed(y)))
    }
    #[inline(always)]
    fn stored(&self, z: &S) -> R::Packed {
        self.0.packed(z)
    }
    #[inline(always)]
    fn read(&self, stored: &R::Packed) -> S {
        self.0.unpacked(stored)
    }
    #[inline(always)]
    fn stages<V: Vectors>(&self, vectors: V, _: Flat, _: &Sum<S>) -> impl Stages<R::Packed> {
        StagesInVectors { field: self, vectors, state: PhantomData }
    }
    #[inline(always)]
    fn at(&self, vectors: impl Vectors, _: Flat, t: f64, (_, z): (&S, &R::Packed)) -> (S, R::Packed) {
        let slope = slope(self, vectors, t, z);
        (self.0.unpacked(&slope), slope)
    }
}

/// `f(t, z)` by itself, on the widest vectors.
struct Evaluation<'a, S, K, R: Packing<S, K>> {
    field: &'a InVectors<R, K>,
    t: f64,
    z: &'a R::Packed,
}

impl<S, K, R: Packing<S, K>> Work for Evaluation<'_, S, K, R> {
    type Output = R::Packed;
    #[inline(always)]
    fn run(self, vectors: impl Vectors) -> R::Packed {
        let InVectors(packing, constants) = self.field;
        packing.slope(vectors, self.t, constants, self.z)
    }
}

/// `f(t, z)` in vectors. The last resort is also for what is done once in many steps: on the vectors that steps have, by a
/// call.
#[inline(always)]
fn slope<S, K, R: Packing<S, K>, V: Vectors>(
    field: &InVectors<R, K>,
    vectors: V,
    t: f64,
    z: &R::Packed,
) -> R::Packed {
    let evaluation = Evaluation::<S, K, R> { field, t, z };
    if const { V::IS_LAST_RESORT } { called(|| widest(evaluation)) } else { evaluation.run(vectors) }
}

/// What is done, by a call.
#[inline(never)]
pub(super) fn called<T>(act: impl FnOnce() -> T) -> T {
    act()
}

/// `z + h sum_j a_j k_j` by rows that are data: compiled once for all models whose states are stored alike.
#[inline(never)]
fn moved_by_a_call<const IN_VECTORS: bool, L: StateVector<f64>>(
    z: &L,
    h: f64,
    stages: &[L],
    row: &[(usize, f64)],
) -> L {
    let mut moved = *z;
    by_rows::moved(IN_VECTORS, moved.as_mut(), h, &components(stages), row);
    moved
}

/// `sum_j a_j k_j` by rows that are data.
#[inline(never)]
fn combination_by_a_call<const IN_VECTORS: bool, L: StateVector<f64>>(
    stages: &[L],
    row: &[(usize, f64)],
) -> L {
    let mut sum = L::zeros();
    by_rows::combination(IN_VECTORS, sum.as_mut(), &components(stages), row);
    sum
}

/// The components of each stage.
fn components<L: StateVector<f64>>(stages: &[L]) -> [&[f64]; STAGES] {
    let mut components: [&[f64]; STAGES] = [&[]; STAGES];
    for (components, stage) in components.iter_mut().zip(stages) {
        *components = stage.as_ref();
    }
    components
}

/// Slopes of numbers, and the sums over stages.
struct StagesInNumbers<F, V> {
    slope: F,
    vectors: PhantomData<V>,
}

impl<L: StateVector<f64>, F: Fn(f64, &L) -> L, V: Vectors> Stages<L> for StagesInNumbers<F, V> {
    #[inline(always)]
    fn slope(&self, t: f64, z: &L) -> L {
        if const { V::IS_LAST_RESORT } { called(|| (self.slope)(t, z)) } else { (self.slope)(t, z) }
    }
    #[inline(always)]
    fn combination<const TERMS: usize>(&self, stages: &[L], row: &[(usize, f64); TERMS]) -> L {
        if const { V::IS_LAST_RESORT } {
            combination_by_a_call::<false, _>(stages, row)
        } else {
            stages::combination(stages, row)
        }
    }
    #[inline(always)]
    fn moved<const TERMS: usize>(&self, z: &L, h: f64, stages: (&[L], &L), row: &[(usize, f64); TERMS]) -> L {
        if const { V::IS_LAST_RESORT } {
            moved_by_a_call::<false, _>(z, h, stages.0, row)
        } else {
            stages::moved(z, h, stages, row)
        }
    }
}

/// Slopes and sums over stages on the vectors of a processor. No closure: of those compilers decide by themselves
/// whether they become part of what is compiled for these vectors.
struct StagesInVectors<'f, S, R, K, V> {
    field: &'f InVectors<R, K>,
    vectors: V,
    state: PhantomData<S>,
}

impl<S, K, R: Packing<S, K>, V: Vectors> Stages<R::Packed> for StagesInVectors<'_, S, R, K, V> {
    #[inline(always)]
    fn slope(&self, t: f64, z: &R::Packed) -> R::Packed {
        slope(self.field, self.vectors, t, z)
    }
    #[inline(always)]
    fn combination<const TERMS: usize>(
        &self,
        stages: &[R::Packed],
        row: &[(usize, f64); TERMS],
    ) -> R::Packed {
        if const { V::IS_LAST_RESORT } {
            combination_by_a_call::<true, _>(stages, row)
        } else {
            packed::combination(self.vectors, stages, row)
        }
    }
    #[inline(always)]
    fn moved<const TERMS: usize>(
        &self,
        z: &R::Packed,
        h: f64,
        stages: (&[R::Packed], &R::Packed),
        row: &[(usize, f64); TERMS],
    ) -> R::Packed {
        if const { V::IS_LAST_RESORT } {
            moved_by_a_call::<true, _>(z, h, stages.0, row)
        } else {
            packed::moved(self.vectors, (z, h), stages, row)
        }
    }
    #[inline(always)]
    fn plus_multiple(&self, z: &R::Packed, h: f64, rise: &R::Packed) -> R::Packed {
        packed::plus_multiple(self.vectors, z, h, rise)
    }
}
