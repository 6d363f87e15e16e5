//! The stages of a step in lanes.

use pulp::Simd;

use crate::lanes::Lanes;
use crate::lanes::equations::Equations;
use crate::lanes::parts::{part, parts, plus, set_part};
use crate::runge_kutta::field::STAGES;
use affine_core::model::StateVector;

/// Place of the slope at the end of a step, which is the first of the next.
pub(super) const AT_END: usize = 12;
/// Place of the first slope of the last step, where that is kept.
pub(super) const AT_BEGIN: usize = STAGES;

/// Slopes in lanes.
pub(super) type Slopes<S> = [S; STAGES + 1];

/// The stages of a step in every lane, from states at a time to another.
pub(super) struct Attempt<'s, T, S, F> {
    pub(super) f: &'s F,
    pub(super) t: T,
    pub(super) end: T,
    /// The length of the step.
    pub(super) h: T,
    pub(super) y: &'s S,
    pub(super) stages: &'s mut Slopes<S>,
    pub(super) trial: &'s mut S,
}

impl<T: Lanes, S: StateVector<T>, F: Equations<T, S>> Attempt<'_, T, S, F> {
    #[inline(always)]
    pub(super) fn stage<V: Simd, const TERMS: usize>(
        &mut self,
        simd: V,
        (number, node): (usize, f64),
        row: &[(usize, f64); TERMS],
    ) {
        let mut time = self.end;
        if node != 1.0 {
            time = self.t + T::constant(node, 0.0) * self.h;
        }
        self.at_stage(simd, row);
        self.f.slope(time, self.trial, &mut self.stages[number - 1]);
    }

    /// The trial states at the stage of a row: the last one enters last.
    #[inline(always)]
    fn at_stage<V: Simd, const TERMS: usize>(&mut self, simd: V, row: &[(usize, f64); TERMS]) {
        let (last, newest) = row[TERMS - 1];
        for k in 0..parts::<V, T>() {
            let h = part(simd, &self.h, k);
            let of_newest = simd.mul_f64s(h, simd.splat_f64s(newest));
            for i in 0..S::LEN {
                let mut at = part(simd, &self.y.as_ref()[i], k);
                if TERMS > 1 {
                    at = plus::<V, T>(simd, combination(simd, self.stages, (i, k), row, TERMS - 1), h, at);
                }
                let slope = part(simd, &self.stages[last - 1].as_ref()[i], k);
                set_part(simd, &mut self.trial.as_mut()[i], k, plus::<V, T>(simd, slope, of_newest, at));
            }
        }
    }
}

/// Component `i` of the slopes in a vector of lanes, each times the coefficient that a row has for it: of its first terms,
/// whose number is known where this is compiled.
#[inline(always)]
pub(super) fn combination<V: Simd, T: Lanes, S: StateVector<T>, const TERMS: usize>(
    simd: V,
    stages: &Slopes<S>,
    (i, k): (usize, usize),
    row: &[(usize, f64); TERMS],
    terms: usize,
) -> V::f64s {
    let mut sum = simd.splat_f64s(0.0);
    for (term, (stage, coefficient)) in row.iter().enumerate().take(terms) {
        let slope = part(simd, &stages[stage - 1].as_ref()[i], k);
        let coefficient = simd.splat_f64s(*coefficient);
        sum = if term == 0 {
            simd.mul_f64s(slope, coefficient)
        } else {
            plus::<V, T>(simd, slope, coefficient, sum)
        };
    }
    sum
}
