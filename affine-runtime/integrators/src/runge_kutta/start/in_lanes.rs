//! What several bodies begin with: lane by lane the numbers of [`Start::of`], operation by operation.

use core::marker::PhantomData;

use pulp::{Simd, WithSimd};

use super::Start;
use crate::error_norm::NormInLanes;
use crate::lanes::Lanes;
use crate::lanes::equations::Equations;
use crate::lanes::parts::in_lanes;
use crate::roughly::{exp, ln};
use crate::runge_kutta::{DormandPrince853, Pair};
use crate::step_size::{FIRST_ERROR, begun, trial as length_of_trial};
use affine_core::model::StateVector;

/// The start of each lane from its state at `t0` to `t_end`, which is another time; `None` where the state or its slope is
/// not finite, or rates leave the range of numbers.
pub fn starts_in_lanes<T: Lanes, S: StateVector<T>, R: StateVector<f64>>(
    f: &impl Equations<T, S>,
    (t0, y0): (f64, &S),
    t_end: f64,
    tolerance: f64,
) -> impl Iterator<Item = Option<Start<R>>> {
    let at_start = T::constant(t0, 0.0);
    let beginning = Beginning { f, at_start, t0, y0, t_end, tolerance, of_one: PhantomData::<R> };
    let begun = in_lanes::<T, _>(beginning, f.are_a_last_resort());
    (0..T::LANES).map(move |lane| {
        let mut slope = R::zeros();
        for (component, lanes) in slope.as_mut().iter_mut().zip(begun.slope.as_ref()) {
            *component = lanes.lane(lane);
        }
        let is_finite = |y: &S| y.as_ref().iter().all(|v| v.lane(lane).is_finite());
        let start = Start { slope, error_norm: begun.norm.lane(lane), length: begun.length.lane(lane) };
        (is_finite(y0) && is_finite(&begun.slope) && !start.length.is_nan()).then_some(start)
    })
}

/// Starts in lanes.
struct Begun<T, S> {
    slope: S,
    norm: NormInLanes<T>,
    length: T,
}

struct Beginning<'a, T, S, F, R> {
    f: &'a F,
    /// The time at the start, in every lane.
    at_start: T,
    t0: f64,
    y0: &'a S,
    t_end: f64,
    tolerance: f64,
    /// The state of one body.
    of_one: PhantomData<R>,
}

impl<T: Lanes, S: StateVector<T>, F: Equations<T, S>, R: StateVector<f64>> WithSimd
    for Beginning<'_, T, S, F, R>
{
    type Output = Begun<T, S>;
    #[inline(always)]
    fn with_simd<V: Simd>(self, simd: V) -> Begun<T, S> {
        let mut slope = S::zeros();
        self.f.slope(self.at_start, self.y0, &mut slope);
        let norm = NormInLanes::probed(simd, self.f, (self.at_start, self.y0, &slope));
        let length = self.first_step(simd, &norm, &slope);
        Begun { slope, norm, length }
    }
}

impl<T: Lanes, S: StateVector<T>, F: Equations<T, S>, R: StateVector<f64>> Beginning<'_, T, S, F, R> {
    /// Lengths of the first steps: the scalar `first_step`; NaN where rates of rates are not finite.
    #[inline(always)]
    fn first_step<V: Simd>(&self, simd: V, norm: &NormInLanes<T>, slope: &S) -> T {
        let (y, span) = (self.y0, self.t_end - self.t0);
        let first = norm.rate(simd, slope, y, y);
        let (mut trial, mut signed) = (T::zero(), T::zero());
        for lane in 0..T::LANES {
            let at_rest = || {
                let [y, slope] = [y, slope].map(|lanes| {
                    let mut of_one = R::zeros();
                    let numbers = of_one.as_mut().iter_mut().zip(lanes.as_ref());
                    numbers.for_each(|(number, lanes)| *number = lanes.lane(lane));
                    of_one
                });
                norm.lane(lane).rate_from_rest(y.as_ref(), slope.as_ref())
            };
            let length = length_of_trial(first.lane(lane), span, at_rest);
            trial.set_lane(lane, length);
            signed.set_lane(lane, length.copysign(span));
        }
        let (mut end, mut after) = (*y, S::zeros());
        for (y, slope) in end.as_mut().iter_mut().zip(slope.as_ref()) {
            *y += signed * *slope;
        }
        self.f.slope(self.at_start + signed, &end, &mut after);
        for (after, before) in after.as_mut().iter_mut().zip(slope.as_ref()) {
            *after -= *before;
        }
        let of_second = norm.rate(simd, &after, y, &end) / trial;
        let second = of_second.sqrt();
        let allowed = exp(ln(FIRST_ERROR * self.tolerance) / DormandPrince853::ERROR_ORDER);
        let mut lengths = T::zero();
        for lane in 0..T::LANES {
            let (first, second, trial) = (first.lane(lane), second.lane(lane), trial.lane(lane));
            let fastest = if first.is_finite() && first > second { first } else { second };
            let length = allowed / fastest;
            let length = if length < 100.0 * trial { length } else { 100.0 * trial };
            let length = begun(length, self.t0, span);
            lengths.set_lane(lane, if of_second.lane(lane).is_finite() { length } else { f64::NAN });
        }
        lengths
    }
}
