//! Step sizes: the first one, and how they follow the error.

use core::ops::Range;

use super::error_norm::{ErrorNorm, norm};
use super::roughly::{exp, ln};
#[cfg(feature = "std")]
use super::tape::Tape;
use crate::model::StateVector;
use crate::scalar::Scalar;

/// Below 1, so that the next step is accepted although the error grows along the way: steps settle where the error
/// is `SAFETY^(k/INTEGRAL)`, a third of the tolerance for `k = 8`.
const SAFETY: f64 = 0.9;
/// A step is at most so many times longer than the one before: the estimate holds only nearby.
const LARGEST_GROWTH: f64 = 6.0;
/// And at least so long.
const LARGEST_CUT: f64 = 0.2;
/// The integral part of the controller: `h ~ error^(-I/k)`; 1 without a proportional part would be the plain
/// controller. On the test problems all usual pairs give the same error for the same work, up to a few percent.
const INTEGRAL: f64 = 0.8;
/// Its proportional part: `h ~ (previous error / error)^(P/k)`, which damps oscillations of the step size.
const PROPORTIONAL: f64 = 0.3;
/// Logarithm of the part of the tolerance below which errors carry no information on the trend, but that the step was
/// too short.
const TREND_FROM: f64 = -9.0;
/// Smaller errors, zero among them, count as this: what is left of the largest growth a hundred times over.
const LEAST_ERROR: f64 = 1e-30;
/// The error of a first step, relative to the tolerance, by rates in place of derivatives. The coefficients of the
/// error terms of methods of high order are so small that it errs far less.
pub(crate) const FIRST_ERROR: f64 = 10.0;

/// The proportional-integral controller (K. Gustafsson, ACM Trans. Math. Software 17 (1991) 533-554):
/// `h_next = h S error^(-(I + P)/k) previous^(P/k)` for an error of order `h^k`, errors relative to the tolerance and
/// times the margin; without the trend where the error is tiny, as after a first step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Controller {
    /// `k`.
    order: f64,
    /// Steps aim at an error so many times below the tolerance, beside [`SAFETY`]. A rejected step costs as much as an
    /// accepted one, and the margin shortens steps by little.
    margin: f64,
    /// Logarithm of the previous error.
    previous: f64,
    rejected: bool,
}

impl Controller {
    /// For an error of order `h^order`.
    pub(crate) fn of(order: f64, margin: f64) -> Self {
        Self { order, margin, previous: TREND_FROM, rejected: false }
    }

    /// What the next step sizes depend on.
    #[cfg(feature = "std")]
    pub(crate) fn exchange(&mut self, tape: &mut impl Tape) {
        tape.number(&mut self.previous);
        tape.flag(&mut self.rejected);
    }

    /// Factor of the step size after an accepted step with `error <= 1`.
    pub(crate) fn accept(&mut self, error: f64) -> f64 {
        let error = ln(self.margin * if error > LEAST_ERROR { error } else { LEAST_ERROR });
        let has_trend = error > TREND_FROM;
        let trend = if has_trend { PROPORTIONAL * (self.previous - error) } else { 0.0 };
        // After a rejection the longer step has just been seen to fail.
        let growth = if self.rejected { 1.0 } else { LARGEST_GROWTH };
        *self = Self { previous: if has_trend { error } else { TREND_FROM }, rejected: false, ..*self };
        (SAFETY * exp((trend - INTEGRAL * error) / self.order)).clamp(LARGEST_CUT, growth)
    }

    /// Factor of the step size after a rejected step; NaN stands for numbers that are not finite.
    pub(crate) fn reject(&mut self, error: f64) -> f64 {
        self.rejected = true;
        if error.is_finite() {
            (SAFETY * exp(-ln(self.margin * error) / self.order)).clamp(LARGEST_CUT, SAFETY)
        } else {
            LARGEST_CUT
        }
    }
}

/// End of the step to try from `t`: `t_end` itself where the step reaches about there, and half the way where it
/// reaches further than that, since a step and a short rest cost as much as two equal ones.
pub(crate) fn next_time(t: f64, length: f64, t_end: f64) -> f64 {
    let rest = t_end - t;
    if 1.01 * length >= rest.abs() {
        t_end
    } else if 2.0 * length > rest.abs() {
        t + 0.5 * rest
    } else {
        t + length.copysign(rest)
    }
}

/// Steps from `t` at or below this length are lost in the rounding of times.
pub(crate) fn shortest(t: f64, t_end: f64) -> f64 {
    let (size, span) = (t.abs(), (t_end - t).abs());
    16.0 * f64::EPSILON * if size > f64::EPSILON * span { size } else { f64::EPSILON * span }
}

/// Length of the first step, after Hairer, Norsett, Wanner, section II.4, with rates in place of their
/// derivatives so that it scales with the unit of time: from `r = max(|y'|/|y|, sqrt(|y''|/|y|))` by groups,
/// `h = (c tolerance)^(1/k)/r` for an error of order `h^k`, `c =` [`FIRST_ERROR`]. Costs one evaluation of `f`, for `y''` as a difference.
pub(crate) fn first_step<S: StateVector<f64>>(
    f: &impl Fn(f64, &S) -> S,
    error_norm: &ErrorNorm,
    (t, y, slope): (f64, &S, &S),
    span: f64,
    (tolerance, order): (f64, f64),
) -> f64 {
    let sizes = error_norm.at_a_state(y.as_ref(), |r| [norm(&slope.as_ref()[r])]);
    let [first] = sizes.largest(f64::INFINITY);
    let within = |h: f64| if h < span.abs() { h } else { span.abs() };
    // Nothing moves, or something that is zero moves: no rate to go by.
    let trial = if first > 0.0 && first.is_finite() { within(0.01 / first) } else { 1e-6 * span.abs() };
    let signed = trial.copysign(span);
    let (mut end, mut change) = (*y, S::zeros());
    for (y, slope) in end.as_mut().iter_mut().zip(slope.as_ref()) {
        *y += signed * slope;
    }
    let slope_after = f(t + signed, &end);
    for (i, change) in change.as_mut().iter_mut().enumerate() {
        *change = (slope_after.as_ref()[i] - slope.as_ref()[i]) / trial;
    }
    let of_change = |r: Range<usize>| norm(&change.as_ref()[r]);
    let second = error_norm.largest(f64::INFINITY, y.as_ref(), end.as_ref(), of_change);
    let second = Scalar::sqrt(second);
    let fastest = if first.is_finite() && first > second { first } else { second };
    let length = exp(ln(FIRST_ERROR * tolerance) / order) / fastest;
    // A step a hundred times the trial is beyond what the two slopes say; this also catches rate 0 and NaN.
    within(if length < 100.0 * trial { length } else { 100.0 * trial })
}
