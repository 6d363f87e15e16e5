//! Steps whose last two coefficients do not tell what they leave out.

use super::{TaylorSteps, slope};
use crate::drive::Control;
use crate::step_size::shortest;
use crate::vectors::Baseline;
use affine_core::__private::numerics::{HIGHEST_ORDER, larger, norm, square, sum_of_squares};
use affine_core::model::StateVector;
use affine_core::system::Series;

/// Series of lower orders may end before the first term after a gap: `x'' = -x^7` from `x = 0` has `t^1`, `t^9`, `t^17`.
const TOLD_BY_TERMS: usize = 8;
/// Terms of a series without gaps are so near a geometric sequence, above or below it.
const NEARLY_GEOMETRIC: f64 = 50.0;
/// Part of a step that is not proved after which it is tried again.
const AGAIN: core::ops::RangeInclusive<f64> = 0.1..=0.8;
/// Rounding of the equations and of the polynomial, which no step undoes.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// The quotient of a geometric sequence from 1 to the tolerance at the order.
pub(super) fn quotient(tolerance: f64, order: usize) -> f64 {
    libm::exp(libm::log(tolerance) / order as f64)
}

impl<S: StateVector<f64>, C, R: Series<S, C>> TaylorSteps<S, C, R> {
    /// The last two coefficients may say too little of a step.
    ///
    /// The largest terms of the third and the last quarter of a series, and of the last two in a step, are nearly a geometric
    /// sequence where there is a pole, and fall a little faster where there is none. Of a series with gaps, in which `k - 1` of `k`
    /// terms vanish or nearly so, the last two may be much less than those before let expect. That matters where one of those is
    /// above the geometric sequence that ends at the tolerance: a step is too long then.
    #[inline(always)]
    pub(super) fn hides_terms(&self, h: f64) -> bool {
        if self.order < TOLD_BY_TERMS {
            return true;
        }
        let ratio = square(h / (self.unit * self.quotient));
        let (mut weights, mut weight) = ([0.0; HIGHEST_ORDER + 1], 1.0);
        for place in &mut weights[1..=self.order] {
            weight *= ratio;
            *place = weight;
        }
        let (third, last_two) = (self.order / 2, self.order - 1);
        let last = (third + last_two) / 2;
        let excess = self.error_norm.largest(h.abs(), self.y.as_ref(), self.y.as_ref(), |range| {
            let of_order =
                |j: usize| weights[j] * sum_of_squares(&self.coefficients[j].as_ref()[range.clone()]);
            let [a, b, c] = [third..last, last..last_two, last_two..self.order + 1]
                .map(|window| window.map(of_order).fold(0.0, larger));
            let (middle, ends, slack) = (b * b, a * c, square(NEARLY_GEOMETRIC));
            let is_regular = middle <= slack * ends && ends <= slack * middle;
            if is_regular { 0.0 } else { libm::sqrt(larger(a, b)) }
        });
        excess > 1.0
    }

    /// The end of a step to a time, or of a shorter one, after which the polynomial `P` solves the equations: there, `h |P' - f(P)|`
    /// is the first term that is left out times its order, `p + 1` or more, and those behind it.
    #[cold]
    #[inline(never)]
    pub(super) fn proved(&self, mut end: f64, control: &mut Control) -> f64 {
        let terms = (self.order + 1) as f64;
        let allowed = terms * larger(control.tolerance, ROUNDING);
        loop {
            let h = end - self.t;
            let (mut after, mut defect) = (self.rise(Baseline, h), self.arriving(h));
            after.as_mut().iter_mut().zip(self.y.as_ref()).for_each(|(after, y)| *after += y);
            let slope = slope(&self.series, &self.constants, end, &after);
            let rates = slope.as_ref().iter();
            defect.as_mut().iter_mut().zip(rates).for_each(|(defect, rate)| *defect = h * (*defect - rate));
            control.statistics.evaluations += 1;
            let (states, defect) = ([self.y.as_ref(), after.as_ref()], defect.as_ref());
            let error = self.error_norm.largest(h.abs(), states[0], states[1], |range| norm(&defect[range]));
            let error = larger(error, self.error_norm.over_energy(states, slope.as_ref(), defect)) / allowed;
            if error <= 1.0 || h.abs() <= shortest(self.t, control.t_end) {
                return end;
            }
            let part = libm::exp2(-libm::log2(error) / terms);
            // A defect that is no number is larger than any.
            let part = if part >= *AGAIN.start() { part } else { *AGAIN.start() };
            end = self.t + part.min(*AGAIN.end()) * h;
        }
    }

    /// `sum_(k > 0) k y_k h^(k - 1)`
    fn arriving(&self, h: f64) -> S {
        let h = h / self.unit;
        let mut rate = S::zeros();
        for (k, coefficient) in self.coefficients[..=self.order].iter().enumerate().skip(1).rev() {
            for (rate, coefficient) in rate.as_mut().iter_mut().zip(coefficient.as_ref()) {
                *rate = *rate * h + k as f64 * coefficient;
            }
        }
        rate.as_mut().iter_mut().for_each(|rate| *rate /= self.unit);
        rate
    }
}
