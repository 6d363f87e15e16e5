//! Logarithm and exponential to five digits: step sizes need no more, and small steps have no time for more.
//!
//! Sums and products in a fixed order: the same bits everywhere.

use core::f64::consts::{LN_2, LOG2_E, SQRT_2};

/// Bits of the fraction of a double.
const FRACTION: u32 = 52;
/// The exponent of 1.
const BIAS: u64 = 1023;
/// `2^52`: an integer in the lowest bits of its fraction is added to it.
const UNIT: f64 = 4_503_599_627_370_496.0;
/// `2^52 + 2^51`: what is added to it is rounded to an integer, found in the lowest bits.
const ROUNDING: f64 = 1.5 * UNIT;

/// [`ln_of_normal`]; what is not a positive normal number gets the value of the library.
#[inline(always)]
pub(crate) fn ln(x: f64) -> f64 {
    if (f64::MIN_POSITIVE..=f64::MAX).contains(&x) { ln_of_normal(x) } else { libm::log(x) }
}

/// `ln x = e ln 2 + ln sqrt 2 + 2 artanh((m - sqrt 2)/(m + sqrt 2))` for `x = 2^e m`, `1 <= m < 2`, to 2e-6, of a
/// positive normal number. Without branches and conversions, so that a loop over many becomes vector instructions.
#[inline(always)]
pub(crate) fn ln_of_normal(x: f64) -> f64 {
    let bits = x.to_bits();
    let exponent = f64::from_bits(bits >> FRACTION | UNIT.to_bits()) - (UNIT + BIAS as f64);
    let fraction = f64::from_bits(bits & ((1 << FRACTION) - 1) | BIAS << FRACTION);
    let t = (fraction - SQRT_2) / (fraction + SQRT_2);
    let square = t * t;
    (exponent + 0.5) * LN_2 + 2.0 * t * (1.0 + square * (1.0 / 3.0 + square * 0.2))
}

/// [`exp_of_moderate`]; beyond `|x| = 700`, the value of the library.
#[inline(always)]
pub(crate) fn exp(x: f64) -> f64 {
    // NaN is not contained.
    if (-700.0..=700.0).contains(&x) { exp_of_moderate(x) } else { libm::exp(x) }
}

/// `exp x = 2^n exp(x - n ln 2)` with `n` next to `x/ln 2`, to a relative 4e-6, for `|x| <= 700`; as [`ln_of_normal`].
#[inline(always)]
pub(crate) fn exp_of_moderate(x: f64) -> f64 {
    let whole = (x * LOG2_E + ROUNDING) - ROUNDING;
    let r = x - whole * LN_2;
    let power = f64::from_bits((whole + (ROUNDING + BIAS as f64)).to_bits() << FRACTION);
    let series = 1.0 / 6.0 + r * (1.0 / 24.0 + r * (1.0 / 120.0));
    power * (1.0 + r * (1.0 + r * (0.5 + r * series)))
}

#[cfg(test)]
mod tests {
    use super::{exp, ln};

    #[test]
    fn five_digits() {
        for k in -5000..=5000 {
            let x = f64::from(k) * 0.1397;
            assert!((exp(x) / libm::exp(x) - 1.0).abs() < 4e-6, "exp {x}");
            let y = libm::exp(x);
            assert!((ln(y) - libm::log(y)).abs() < 2e-6, "ln {y}");
        }
    }

    #[test]
    fn ends_of_the_range() {
        assert_eq!([ln(0.0), ln(f64::INFINITY)], [f64::NEG_INFINITY, f64::INFINITY]);
        assert_eq!([exp(f64::NEG_INFINITY), exp(f64::INFINITY), exp(0.0)], [0.0, f64::INFINITY, 1.0]);
        assert!(ln(-1.0).is_nan() && ln(f64::NAN).is_nan() && exp(f64::NAN).is_nan());
        assert_eq!(ln(1e-310), libm::log(1e-310), "subnormal");
    }
}
