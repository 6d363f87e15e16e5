//! Step sizes: the first one, and how they follow the error.

#[cfg(feature = "std")]
pub(crate) mod in_lanes;

use super::error_norm::ErrorNorm;
use super::roughly::{exp, exp_of_moderate, ln, ln_of_normal};
use super::tape::Tape;
use affine_core::__private::numerics::larger;
use affine_core::model::StateVector;
use affine_core::scalar::Scalar;

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
/// Smaller errors, zero among them, count as this, which allows the largest growth.
const LEAST_ERROR: f64 = 1e-30;
/// After each step so much is left of the time that errors of momenta are held against. A short contact, of up to a hundred
/// steps, is measured by the flight before it; a body that goes on vibrating, by its vibrations.
const LASTING: f64 = 0.98;
/// The error of a first step, relative to the tolerance, by rates in place of derivatives. The coefficients of the
/// error terms of methods of high order are so small that it errs far less.
pub(crate) const FIRST_ERROR: f64 = 10.0;

/// The proportional-integral controller (K. Gustafsson, ACM Trans. Math. Software 17 (1991) 533-554):
/// `h_next = h S error^(-(I + P)/k) previous^(P/k)` for an error of order `h^k`, errors relative to the tolerance and
/// times the margin; without the trend where the error is tiny, as after a first step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Controller {
    /// `1/k`.
    inverse_order: f64,
    /// Steps aim at an error so many times below the tolerance, beside [`SAFETY`], as a logarithm. A rejected step costs
    /// as much as an accepted one, and the margin shortens steps by little.
    margin: f64,
    /// Logarithm of the previous error.
    pub(super) previous: f64,
    pub(super) rejected: bool,
    /// The longest of the steps before, each shortened by [`LASTING`] for every step since.
    pub(crate) lasting: f64,
}

impl Controller {
    /// For an error of order `h^order`.
    pub(crate) fn of(order: f64, margin: f64) -> Self {
        Self {
            inverse_order: 1.0 / order,
            margin: ln_of_normal(margin),
            previous: TREND_FROM,
            rejected: false,
            lasting: 0.0,
        }
    }

    /// What the next step sizes depend on.
    pub(crate) fn exchange(&mut self, tape: &mut impl Tape) {
        tape.number(&mut self.previous);
        tape.flag(&mut self.rejected);
        tape.number(&mut self.lasting);
    }

    /// The time in which what an error of a momentum moves counts, in a step of length `h`: an error lasts, and moves the body by
    /// more once steps are longer again.
    #[inline(always)]
    pub(crate) fn lasting(&self, h: f64) -> f64 {
        larger(h, self.lasting)
    }

    /// A step of a length was taken.
    #[inline(always)]
    pub(crate) fn took(&mut self, h: f64) {
        self.lasting = larger(h, LASTING * self.lasting);
    }

    /// Factor of the step size after an accepted step with `error <= 1`.
    #[inline(never)]
    pub(crate) fn accept(&mut self, error: f64) -> f64 {
        self.factor(true, error)
    }

    /// Factor of the step size after a rejected step; NaN stands for numbers that are not finite.
    #[inline(never)]
    pub(crate) fn reject(&mut self, error: f64) -> f64 {
        self.factor(false, error)
    }

    /// Either. All that is called between two steps is without branches, for many bodies at once.
    #[inline(always)]
    fn factor(&mut self, accepted: bool, error: f64) -> f64 {
        let seen = if error > LEAST_ERROR { error } else { LEAST_ERROR };
        // What is not finite cuts a step as the largest number does.
        let failed = if error < f64::MAX { error } else { f64::MAX };
        let logarithm = self.margin + ln_of_normal(if accepted { seen } else { failed });
        let has_trend = logarithm > TREND_FROM;
        let trend = if has_trend { PROPORTIONAL * (self.previous - logarithm) } else { 0.0 };
        let exponent =
            (if accepted { trend - INTEGRAL * logarithm } else { -logarithm }) * self.inverse_order;
        // After a rejection the longer step has just been seen to fail.
        let growth = if self.rejected { 1.0 } else { LARGEST_GROWTH };
        let growth = if accepted { growth } else { SAFETY };
        let seen = if has_trend { logarithm } else { TREND_FROM };
        self.previous = if accepted { seen } else { self.previous };
        self.rejected = !accepted;
        within(LARGEST_CUT, growth, SAFETY * exp_of_moderate(exponent))
    }
}

/// The nearest number between two others.
#[inline(always)]
fn within(least: f64, most: f64, x: f64) -> f64 {
    let x = if x < least { least } else { x };
    if x > most { most } else { x }
}

/// End of the step to try from `t`: `t_end` itself where the step reaches about there, and half the way where it
/// reaches further than that, since a step and a short rest cost as much as two equal ones.
#[inline(always)]
pub(crate) fn next_time(t: f64, length: f64, t_end: f64) -> f64 {
    let rest = t_end - t;
    let step = if 2.0 * length > rest.abs() { 0.5 * rest } else { length.copysign(rest) };
    if 1.01 * length >= rest.abs() { t_end } else { t + step }
}

/// Steps from `t` at or below this length are lost in the rounding of times.
#[inline(always)]
pub(crate) fn shortest(t: f64, t_end: f64) -> f64 {
    let (size, span) = (t.abs(), (t_end - t).abs());
    16.0 * f64::EPSILON * if size > f64::EPSILON * span { size } else { f64::EPSILON * span }
}

/// The length of a first step from `t`: within the span, and one that times near `t` can tell from none, however far the end. What
/// is zero but for rounding, as a change of the state may be, seems to move at once.
#[inline(always)]
pub(crate) fn begun(length: f64, t: f64, span: f64) -> f64 {
    let least = 2.0 * shortest(t, t);
    let length = if length < least { least } else { length };
    if length < span.abs() { length } else { span.abs() }
}

/// Length of the step over which slopes are compared at the start: a hundredth of the time in which the fastest group changes
/// by itself. Momenta that are zero have no such time, and are held against what they are on the way to, `at_rest`; what
/// does not move at all may stay so for all of the interval. Where something else that is zero begins to move there is no
/// rate to go by.
#[inline(always)]
pub(crate) fn trial(first: f64, span: f64, at_rest: impl FnOnce() -> f64) -> f64 {
    let rate = if first == f64::INFINITY { at_rest() } else { first };
    let length = 0.01 / rate;
    if length < span.abs() && length > 0.0 {
        length
    } else if length >= span.abs() {
        span.abs()
    } else {
        1e-6 * span.abs()
    }
}

/// Length of the first step, after Hairer, Norsett, Wanner, section II.4, with rates in place of their
/// derivatives so that it scales with the unit of time: from `r = max(|y'|/|y|, sqrt(|y''|/|y|))` by groups,
/// `h = (c tolerance)^(1/k)/r` for an error of order `h^k`, `c =` [`FIRST_ERROR`]. Costs one evaluation of `f`, for `y''` as
/// a difference over a [`trial`] step.
pub(crate) fn first_step<S: StateVector<f64>>(
    f: &dyn Fn(f64, &S) -> S,
    error_norm: &ErrorNorm,
    (t, y, slope): (f64, &S, &S),
    span: f64,
    (tolerance, order): (f64, f64),
) -> f64 {
    let first = error_norm.over_size(y.as_ref(), slope.as_ref());
    let at_rest = || error_norm.rate_from_rest(y.as_ref(), slope.as_ref());
    let trial = trial(first, span, at_rest);
    let signed = trial.copysign(span);
    let (mut end, mut change) = (*y, S::zeros());
    for (y, slope) in end.as_mut().iter_mut().zip(slope.as_ref()) {
        *y += signed * slope;
    }
    let slope_after = f(t + signed, &end);
    for (i, change) in change.as_mut().iter_mut().enumerate() {
        *change = slope_after.as_ref()[i] - slope.as_ref()[i];
    }
    // Over time in the end: rates of rates leave the range of numbers first.
    let of_second = error_norm.over_sizes([y.as_ref(), end.as_ref()], change.as_ref()) / trial;
    // Something that is zero begins to move, under a force that was zero: no rate to go by either.
    let second = if of_second == f64::INFINITY { 0.0 } else { Scalar::sqrt(of_second) };
    let fastest = if first.is_finite() && first > second { first } else { second };
    let length = exp(ln(FIRST_ERROR * tolerance) / order) / fastest;
    // A step a hundred times the trial is beyond what the two slopes say; this also catches rate 0 and NaN.
    begun(if length < 100.0 * trial { length } else { 100.0 * trial }, t, span)
}

#[cfg(test)]
mod tests {
    use super::{Controller, LARGEST_CUT, LARGEST_GROWTH, SAFETY, first_step, next_time, shortest, trial};
    use crate::ErrorNorm;
    use affine_core::model::{Group, Quantity};

    const ORDER: f64 = 8.0;

    fn controller() -> Controller {
        Controller::of(ORDER, 1.0)
    }

    fn near(found: f64, expected: f64) -> bool {
        (found - expected).abs() <= 1e-3 * expected.abs()
    }

    #[test]
    fn what_is_not_finite_cuts_most() {
        for error in [f64::NAN, f64::INFINITY, f64::MAX, 1e30] {
            assert_eq!(controller().reject(error), LARGEST_CUT, "{error}");
        }
    }

    /// `h (S error^(-1/k))`, shorter than before in any case.
    #[test]
    fn rejected_steps_are_cut_by_their_error() {
        for error in [2.0_f64, 10.0, 1e3] {
            let factor = controller().reject(error);
            assert!(near(factor, SAFETY * error.powf(-1.0 / ORDER)), "{error}: {factor}");
        }
        assert!(near(controller().reject(1.0 + 1e-9), SAFETY));
        // An estimate that is small where a step has been rejected for another reason does not lengthen it.
        assert!(near(controller().reject(1e-20), SAFETY));
    }

    #[test]
    fn a_step_after_a_rejected_one_does_not_grow() {
        let mut controller = controller();
        controller.reject(2.0);
        assert!(controller.accept(1e-20) <= 1.0);
        assert_eq!(controller.accept(1e-20), LARGEST_GROWTH, "the one after it may");
    }

    #[test]
    fn errors_that_grow_shorten_steps_before_they_are_too_large() {
        let after = |errors: [f64; 2]| {
            let mut controller = controller();
            controller.accept(errors[0]);
            controller.accept(errors[1])
        };
        let (growing, steady, falling) = (after([0.01, 0.1]), after([0.1, 0.1]), after([0.5, 0.1]));
        assert!(growing < steady && steady < falling, "{growing} {steady} {falling}");
        // S error^(-(I + P)/k) previous^(P/k)
        assert!(near(growing, 0.9 * 0.1_f64.powf(-1.1 / ORDER) * 0.01_f64.powf(0.3 / ORDER)), "{growing}");
        assert_eq!(controller().accept(0.0), LARGEST_GROWTH);
        // A rejected step is no trend.
        let mut once = controller();
        once.accept(0.1);
        let mut twice = once;
        twice.reject(5.0);
        assert_eq!(once.previous, twice.previous);
    }

    /// An error counts as many times as the margin says, with a trend from what is too small to tell of one.
    #[test]
    fn margins_multiply_the_error() {
        let error = 0.4_f64.ln();
        let expected = SAFETY * ((0.3 * (-9.0 - error) - 0.8 * error) / ORDER).exp();
        for (margin, error) in [(4.0, 0.1), (1.0, 0.4)] {
            let found = Controller::of(ORDER, margin).accept(error);
            assert!(near(found, expected), "{found} {expected}");
        }
    }

    /// Two equal steps where one and a short rest would do.
    #[test]
    fn the_last_two_steps_are_equal() {
        for sign in [1.0, -1.0] {
            let end = 3.0 * sign;
            assert_eq!(next_time(0.0, 1.0, end), sign);
            assert_eq!(next_time(sign, 1.5, end), 2.0 * sign);
            assert_eq!(next_time(sign, 2.0, end), end);
            assert_eq!(next_time(sign, 1.99, end), end, "a hundredth is no step");
            assert_eq!(next_time(sign, 1.9, end), 2.0 * sign);
            assert_eq!(next_time(sign, 1.0, end), 2.0 * sign);
        }
    }

    #[test]
    fn roundings_of_times() {
        assert_eq!(shortest(4.0, 5.0), 64.0 * f64::EPSILON);
        assert_eq!(shortest(-4.0, 5.0), 64.0 * f64::EPSILON);
        assert_eq!(shortest(0.0, 2.0), 32.0 * f64::EPSILON * f64::EPSILON);
    }

    #[test]
    fn trials_by_what_is_known_of_the_rate() {
        assert_eq!(trial(2.0, 1.0, || f64::NAN), 0.005);
        assert_eq!(trial(0.001, -1.0, || f64::NAN), 1.0);
        assert_eq!(trial(f64::INFINITY, 1.0, || 4.0), 0.0025);
        assert_eq!(trial(f64::INFINITY, 1.0, || 0.0), 1.0);
        assert_eq!(trial(f64::INFINITY, 8.0, || f64::INFINITY), 8e-6);
        assert_eq!(trial(f64::NAN, 8.0, || 1.0), 8e-6);
    }

    /// `y' = -w y`: `(10 eps)^(1/k)/w`, in any unit of time, and never beyond what the trial says.
    #[test]
    fn first_steps() {
        const GROUPS: &[Group] = &[Group::new(Quantity::AffineSpin, 2)];
        let norm = ErrorNorm::new(GROUPS);
        for w in [1e-6, 1.0, 1e9] {
            let f = |_: f64, y: &[f64; 2]| y.map(|v| -w * v);
            let y = [1.0, 2.0];
            let length = |tolerance: f64, span: f64| {
                first_step(&f, &norm, (0.0, &y, &f(0.0, &y)), span, (tolerance, ORDER))
            };
            for tolerance in [1e-12_f64, 1e-9, 1e-4] {
                let expected = (10.0 * tolerance).powf(1.0 / ORDER) / w;
                let found = length(tolerance, 1e3 / w);
                assert!((found - expected).abs() < 0.02 * expected, "{found:e} {expected:e}");
                assert!(near(length(tolerance, -1e3 / w), found));
            }
            assert!(length(0.9, 1e3 / w) <= 1.0001 / w);
            assert_eq!(length(1e-9, 1e-3 / w), 1e-3 / w);
        }
        // A rate that grows at once: the second derivative decides.
        let jump = |t: f64, _: &[f64; 2]| [1e4 * t, 0.0];
        let y = [1.0, 1.0];
        let found = first_step(&jump, &norm, (0.0, &y, &[0.0; 2]), 10.0, (1e-9, ORDER));
        let rate = (1e4 / 2.0_f64.sqrt()).sqrt();
        assert!((found * rate / 0.1 - 1.0).abs() < 0.1, "{found:e}");
        // What is no number has the shortest start there is.
        let lost = |_: f64, _: &[f64; 2]| [f64::NAN; 2];
        let found = first_step(&lost, &norm, (0.0, &y, &[1.0; 2]), 10.0, (1e-9, ORDER));
        assert!(found > 0.0 && found <= 10.0, "{found}");
    }
}
