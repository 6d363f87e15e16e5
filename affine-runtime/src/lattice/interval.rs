//! Intervals that enclose what a function takes on others.

use core::cmp::Ordering;
use core::f64::consts::{FRAC_PI_2, PI, TAU};
use core::ops::{Add, Div, Mul, Neg, Sub};

use num_traits::{One, Zero};

use crate::dual::assigning;
use crate::scalar::{Real, Scalar};

/// What an operation or function of the runtime may be off by, relative to its value.
const ROUNDING: f64 = 4.0 * f64::EPSILON;
/// Sines of larger numbers are anything.
const LARGEST_ANGLE: f64 = 1e8;

/// All numbers from `lo` to `hi`. What is computed with it encloses the results for all of them, rounding included; a function
/// that has no value at one of them may be any number.
///
/// An interval is less or greater than another where all its numbers are; otherwise it is neither.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Interval {
    pub(super) lo: f64,
    pub(super) hi: f64,
}

impl Interval {
    const ALL: Self = Self { lo: f64::NEG_INFINITY, hi: f64::INFINITY };

    /// One number.
    pub(super) fn point(value: f64) -> Self {
        Self { lo: value, hi: value }
    }

    /// From one number to another, in either order.
    pub(super) fn between(a: f64, b: f64) -> Self {
        Self { lo: lower(a, b), hi: upper(a, b) }
    }

    /// What lies in both of two intervals that enclose the same.
    pub(super) fn and(self, other: Self) -> Self {
        Self { lo: upper(self.lo, other.lo), hi: lower(self.hi, other.hi) }
    }

    pub(super) fn contains(self, value: f64) -> bool {
        self.lo <= value && value <= self.hi
    }

    /// The numbers that rounding may have left outside with them.
    fn rounded(lo: f64, hi: f64) -> Self {
        if lo.is_nan() || hi.is_nan() {
            return Self::ALL;
        }
        // What has overflowed may be just above the largest number.
        let (lo, hi) = (lower(lo, f64::MAX), upper(hi, f64::MIN));
        Self { lo: lo - ROUNDING * lo.abs(), hi: hi + ROUNDING * hi.abs() }
    }

    /// Of a function that grows.
    fn grown(self, function: fn(f64) -> f64) -> Self {
        Self::rounded(function(self.lo), function(self.hi))
    }

    /// The same from a number on, below which it has no value.
    fn grown_from(self, least: f64, function: fn(f64) -> f64) -> Self {
        if self.lo >= least { self.grown(function) } else { Self::ALL }
    }

    /// Of a function that has its largest value 1 at `peak` and at every full turn from there, and -1 half a turn from it.
    fn turning(self, function: fn(f64) -> f64, peak: f64) -> Self {
        let passes = |extreme: f64| {
            let turns =
                |at: f64, away: f64| libm::floor((at - extreme + away * ROUNDING * (1.0 + at.abs())) / TAU);
            turns(self.hi, 1.0) > turns(self.lo, -1.0)
        };
        if !(self.lo > -LARGEST_ANGLE && self.hi < LARGEST_ANGLE) {
            return Self { lo: -1.0, hi: 1.0 };
        }
        let ends = Self::between(function(self.lo), function(self.hi));
        let lo = if passes(peak + PI) { -1.0 } else { ends.lo };
        let hi = if passes(peak) { 1.0 } else { ends.hi };
        Self::rounded(lo, hi)
    }
}

fn lower(a: f64, b: f64) -> f64 {
    if a < b || a.is_nan() { a } else { b }
}

fn upper(a: f64, b: f64) -> f64 {
    if a > b || a.is_nan() { a } else { b }
}

impl Add for Interval {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::rounded(self.lo + other.lo, self.hi + other.hi)
    }
}

impl Sub for Interval {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::rounded(self.lo - other.hi, self.hi - other.lo)
    }
}

impl Mul for Interval {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        // Nothing of any size is nothing.
        let product = |a: f64, b: f64| if a == 0.0 || b == 0.0 { 0.0 } else { a * b };
        let [a, b, c, d] =
            [(self.lo, other.lo), (self.lo, other.hi), (self.hi, other.lo), (self.hi, other.hi)]
                .map(|(a, b)| product(a, b));
        Self::rounded(lower(lower(a, b), lower(c, d)), upper(upper(a, b), upper(c, d)))
    }
}

impl Div for Interval {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let reciprocal =
            if other.contains(0.0) { Self::ALL } else { Self::rounded(1.0 / other.hi, 1.0 / other.lo) };
        self * reciprocal
    }
}

impl Neg for Interval {
    type Output = Self;
    fn neg(self) -> Self {
        Self { lo: -self.hi, hi: -self.lo }
    }
}

assigning!([] Interval);

impl Zero for Interval {
    fn zero() -> Self {
        Self::point(0.0)
    }
    fn is_zero(&self) -> bool {
        *self == Self::zero()
    }
}

impl One for Interval {
    fn one() -> Self {
        Self::point(1.0)
    }
}

impl PartialOrd for Interval {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        match (self.hi < other.lo, self.lo > other.hi) {
            (true, _) => Some(Ordering::Less),
            (_, true) => Some(Ordering::Greater),
            _ => (self == other).then_some(Ordering::Equal),
        }
    }
}

macro_rules! growing {
    ($($function:ident)*) => { $(
        fn $function(self) -> Self {
            self.grown(Scalar::$function)
        }
    )* };
}

impl Scalar for Interval {
    fn constant(hi: f64, lo: f64) -> Self {
        if lo == 0.0 { Self::point(hi) } else { Self::rounded(hi, hi) }
    }
    growing! { cbrt exp exp_m1 sinh tanh asinh }
    fn sqrt(self) -> Self {
        self.grown_from(0.0, Scalar::sqrt)
    }
    fn ln(self) -> Self {
        self.grown_from(0.0, Scalar::ln)
    }
    fn ln_1p(self) -> Self {
        self.grown_from(-1.0, Scalar::ln_1p)
    }
    fn sin(self) -> Self {
        self.turning(Scalar::sin, FRAC_PI_2)
    }
    fn cos(self) -> Self {
        self.turning(Scalar::cos, 0.0)
    }
    fn tan(self) -> Self {
        if self.cos().contains(0.0) { Self::ALL } else { self.grown(Scalar::tan) }
    }
    fn cosh(self) -> Self {
        self.abs().grown(Scalar::cosh)
    }
    fn abs(self) -> Self {
        let ends = Self::between(self.lo.abs(), self.hi.abs());
        if self.contains(0.0) { Self { lo: 0.0, ..ends } } else { ends }
    }
    fn copysign(self, sign: Self) -> Self {
        let size = self.abs();
        match sign.contains(0.0) {
            true => Self { lo: -size.hi, hi: size.hi },
            false if sign.hi < 0.0 => -size,
            false => size,
        }
    }
    fn max(self, other: Self) -> Self {
        Self { lo: upper(self.lo, other.lo), hi: upper(self.hi, other.hi) }
    }
}

impl Real for Interval {
    const EPSILON: Self = Self { lo: f64::EPSILON, hi: f64::EPSILON };

    fn hypot(self, other: Self) -> Self {
        (self * self + other * other).sqrt()
    }
    fn is_finite(self) -> bool {
        self.lo.is_finite() && self.hi.is_finite()
    }
    fn to_f64(self) -> f64 {
        0.5 * (self.lo + self.hi)
    }
}

#[cfg(test)]
mod tests {
    use super::Interval;
    use crate::scalar::{Real, Scalar};

    /// Of intervals from narrow to wide, which step over zeros, extrema and poles.
    fn intervals() -> impl Iterator<Item = Interval> {
        let starts = (-40..40).map(|k| 0.17 * f64::from(k));
        let widths = [0.0, 1e-9, 0.01, 0.3, 2.0, 7.0];
        starts.flat_map(move |lo| widths.map(|width| Interval::between(lo + width, lo)))
    }

    fn samples(of: Interval) -> impl Iterator<Item = f64> {
        (0..=32)
            .map(move |k| of.lo + f64::from(k) / 32.0 * (of.hi - of.lo))
            .filter(move |at| of.contains(*at))
    }

    /// Every value that is a number lies in the enclosure, which is narrow where the interval is a point.
    fn assert_encloses(enclosure: fn(Interval) -> Interval, function: fn(f64) -> f64) {
        for over in intervals() {
            let found = enclosure(over);
            for at in samples(over).filter(|at| !function(*at).is_nan()) {
                assert!(found.contains(function(at)), "{over:?}: {found:?} and {} at {at}", function(at));
            }
            let value = function(over.lo);
            if over.lo == over.hi && value.is_finite() && found.is_finite() {
                assert!(found.hi - found.lo <= 1e-13 * (1.0 + value.abs()), "{over:?}: {found:?}");
            }
        }
    }

    macro_rules! assert_functions {
        ($($function:ident)*) => { $(
            assert_encloses(Scalar::$function, Scalar::$function);
        )* };
    }

    #[test]
    fn functions_are_enclosed() {
        assert_functions! { sqrt cbrt inverse_cbrt exp exp_m1 ln ln_1p sin cos tan sinh cosh tanh asinh abs }
    }

    #[test]
    fn operations_are_enclosed() {
        for (a, b) in intervals().flat_map(|a| intervals().step_by(7).map(move |b| (a, b))) {
            for (x, y) in samples(a).step_by(8).zip(samples(b).step_by(8)) {
                assert!((a + b).contains(x + y) && (a - b).contains(x - y) && (a * b).contains(x * y));
                assert!((a / b).contains(x / y) || y == 0.0, "{a:?} over {b:?}: {x} over {y}");
                assert!(Scalar::max(a, b).contains(Scalar::max(x, y)));
                assert!(a.copysign(b).contains(x.copysign(y)) && a.hypot(b).contains(x.hypot(y)));
                let is_told = a.partial_cmp(&b).is_some();
                assert!(!is_told || a.partial_cmp(&b) == x.partial_cmp(&y), "{a:?} and {b:?}");
            }
        }
    }

    /// What no function has a value at may be any number; and nothing of it is nothing.
    #[test]
    fn no_value_is_any_number() {
        let around = Interval::between(-1.0, 1.0);
        let one = Interval::point(1.0);
        for found in [around.ln(), around.sqrt(), one / around, Interval::between(1.0, 2.0).tan()] {
            assert!(found == Interval::ALL, "{found:?}");
        }
        assert_eq!(Interval::point(0.0) * Interval::ALL, Interval::point(0.0));
        let huge = Interval::point(1e200) * Interval::point(1e200);
        assert!(huge.lo < f64::INFINITY && huge.hi == f64::INFINITY, "{huge:?}");
    }
}
