//! Dense output of bodies in lanes.

use pulp::{Simd, WithSimd};

use super::RungeKutta8InLanes;
use super::attempt::{AT_BEGIN, AT_END, Attempt, Slopes, combination};
use super::before::Before;
use crate::lanes::Lanes;
use crate::lanes::equations::Equations;
use crate::lanes::parts::{in_lanes, part, parts, set_part};
use crate::runge_kutta::dormand_prince_853::*;
use affine_core::model::StateVector;

impl<T: Lanes, S: StateVector<T>, F: Equations<T, S>> RungeKutta8InLanes<T, S, F> {
    /// Keeps where each step begins, from the next one on: what [`within`](Self::within) asks.
    pub fn keep(&mut self) {
        self.before = Some(Before::none(self.clocks.t));
    }

    /// Time reached in a lane.
    pub fn t(&self, lane: usize) -> f64 {
        self.clocks.t.lane(lane)
    }

    /// The last attempt in a lane was a step, of those that are kept.
    pub fn has_stepped(&self, lane: usize) -> bool {
        self.before.as_ref().is_some_and(|before| before.t.lane(lane) != self.t(lane))
    }

    /// State reached in a lane.
    pub fn state<R: StateVector<f64>>(&self, lane: usize) -> R {
        let mut state = R::zeros();
        copied(&self.y, lane, &mut state);
        state
    }

    /// Time and state where the last step in a lane began, of those that are kept; `None` where there was no step.
    pub fn begin<R: StateVector<f64>>(&self, lane: usize) -> Option<(f64, R)> {
        let before = self.before.as_ref().filter(|_| self.has_stepped(lane))?;
        let mut state = R::zeros();
        copied(&before.y, lane, &mut state);
        Some((before.t.lane(lane), state))
    }

    /// The state in a lane at a time within its last step, which was [kept](Self::keep): by the dense output of
    /// [`RungeKutta8`](super::super::RungeKutta8), operation by operation. `None` where there was no step. The first time that is
    /// asked for costs three evaluations, which serve all lanes until they step again.
    pub fn within<R: StateVector<f64>>(&mut self, lane: usize, t: f64) -> Option<R> {
        if !self.has_stepped(lane) {
            return None;
        }
        if self.before.as_ref().is_some_and(|before| !before.is_dense) {
            let is_a_last_resort = self.f.are_a_last_resort();
            in_lanes::<T, _>(Polynomials(self), is_a_last_resort);
        }
        let Before { t: begin, y, coefficients, .. } = self.before.as_ref()?;
        let (begin, end) = (begin.lane(lane), self.t(lane));
        if t == end {
            return Some(self.state(lane));
        }
        let mut state = R::zeros();
        let theta = (t - begin) / (end - begin);
        let mut of_body = R::zeros();
        for (k, of_lanes) in coefficients.iter().enumerate().rev() {
            copied(of_lanes, lane, &mut of_body);
            let factor = if k % 2 == 0 { theta } else { 1.0 - theta };
            for (value, coefficient) in state.as_mut().iter_mut().zip(of_body.as_ref()) {
                *value = (*value + coefficient) * factor;
            }
        }
        copied(y, lane, &mut of_body);
        state.as_mut().iter_mut().zip(of_body.as_ref()).for_each(|(value, y)| *value += y);
        Some(state)
    }
}

/// What stands in a lane.
#[inline(always)]
fn copied<T: Lanes, S: StateVector<T>, R: StateVector<f64>>(lanes: &S, lane: usize, state: &mut R) {
    for (component, lanes) in state.as_mut().iter_mut().zip(lanes.as_ref()) {
        *component = lanes.lane(lane);
    }
}

/// The coefficients of [`Dense`](super::super::Dense) over the last steps.
struct Polynomials<'a, T, S, F>(&'a mut RungeKutta8InLanes<T, S, F>);

impl<T: Lanes, S: StateVector<T>, F: Equations<T, S>> WithSimd for Polynomials<'_, T, S, F> {
    type Output = ();
    #[inline(always)]
    fn with_simd<V: Simd>(self, simd: V) {
        let RungeKutta8InLanes { f, y: reached, trial, stages, clocks, before, .. } = self.0;
        let Some(Before { t, y, coefficients, is_dense }) = before else { return };
        // As in the attempt, whose stages but the first are still there.
        let h = clocks.t - *t;
        let mut attempt = Attempt { f, t: *t, end: clocks.t, h, y, stages, trial };
        attempt.stage(simd, NODES[12], &const { from_begin(A14) });
        attempt.stage(simd, NODES[13], &const { from_begin(A15) });
        attempt.stage(simd, NODES[14], &const { from_begin(A16) });
        let [first, second, third, d4, d5, d6, d7] = coefficients;
        of_ends(simd, h, [y, reached], [&stages[AT_BEGIN], &stages[AT_END]], [first, second, third]);
        of_slopes(simd, h, stages, &const { from_begin(D4) }, d4);
        of_slopes(simd, h, stages, &const { from_begin(D5) }, d5);
        of_slopes(simd, h, stages, &const { from_begin(D6) }, d6);
        of_slopes(simd, h, stages, &const { from_begin(D7) }, d7);
        *is_dense = true;
    }
}

/// A row whose first slope is that of the last step.
const fn from_begin<const TERMS: usize>(mut row: [(usize, f64); TERMS]) -> [(usize, f64); TERMS] {
    row[0].0 = AT_BEGIN + 1;
    row
}

/// The coefficients of the values and slopes at both ends.
#[inline(always)]
fn of_ends<V: Simd, T: Lanes, S: StateVector<T>>(
    simd: V,
    h: T,
    values: [&S; 2],
    slopes: [&S; 2],
    coefficients: [&mut S; 3],
) {
    let [rises, seconds, thirds] = coefficients;
    for k in 0..parts::<V, T>() {
        let h = part(simd, &h, k);
        for i in 0..S::LEN {
            let begin = simd.mul_f64s(h, part(simd, &slopes[0].as_ref()[i], k));
            let end = simd.mul_f64s(h, part(simd, &slopes[1].as_ref()[i], k));
            let (y, reached) = (&values[0].as_ref()[i], &values[1].as_ref()[i]);
            let rise = simd.sub_f64s(part(simd, reached, k), part(simd, y, k));
            let twice = simd.mul_f64s(simd.splat_f64s(2.0), rise);
            set_part(simd, &mut rises.as_mut()[i], k, rise);
            set_part(simd, &mut seconds.as_mut()[i], k, simd.sub_f64s(begin, rise));
            set_part(simd, &mut thirds.as_mut()[i], k, simd.sub_f64s(twice, simd.add_f64s(begin, end)));
        }
    }
}

/// The coefficients by the slopes of a row.
#[inline(always)]
fn of_slopes<V: Simd, T: Lanes, S: StateVector<T>, const TERMS: usize>(
    simd: V,
    h: T,
    stages: &Slopes<S>,
    row: &[(usize, f64); TERMS],
    coefficients: &mut S,
) {
    for k in 0..parts::<V, T>() {
        let h = part(simd, &h, k);
        for i in 0..S::LEN {
            let sum = combination(simd, stages, (i, k), row, TERMS);
            set_part(simd, &mut coefficients.as_mut()[i], k, simd.mul_f64s(h, sum));
        }
    }
}
