//! Logarithm and exponential to five digits: step sizes need no more, and small steps have no time for more.
//!
//! Sums and products in a fixed order: the same bits everywhere.

use core::f64::consts::{LN_2, LOG2_E, SQRT_2};

/// Bits of the fraction of a double.
const FRACTION: u32 = 52;
/// The exponent of 1.
const BIAS: i64 = 1023;

/// `ln x = e ln 2 + ln sqrt 2 + 2 artanh((m - sqrt 2)/(m + sqrt 2))` for `x = 2^e m`, `1 <= m < 2`, to 2e-6; what is not
/// a positive normal number gets the value of the library.
#[inline(always)]
pub(crate) fn ln(x: f64) -> f64 {
    if !(f64::MIN_POSITIVE..=f64::MAX).contains(&x) {
        return libm::log(x);
    }
    let bits = x.to_bits();
    let exponent = (bits >> FRACTION) as i64 - BIAS;
    let fraction = f64::from_bits(bits & ((1 << FRACTION) - 1) | (BIAS as u64) << FRACTION);
    let t = (fraction - SQRT_2) / (fraction + SQRT_2);
    let square = t * t;
    (exponent as f64 + 0.5) * LN_2 + 2.0 * t * (1.0 + square * (1.0 / 3.0 + square * 0.2))
}

/// `exp x = 2^n exp(x - n ln 2)` with `n` next to `x/ln 2`, to a relative 4e-6; beyond `|x| = 700`, the value of the
/// library.
#[inline(always)]
pub(crate) fn exp(x: f64) -> f64 {
    // NaN too.
    if !(-700.0..=700.0).contains(&x) {
        return libm::exp(x);
    }
    let whole = (x * LOG2_E + 0.5_f64.copysign(x)) as i64;
    let r = x - whole as f64 * LN_2;
    let power = f64::from_bits(((whole + BIAS) as u64) << FRACTION);
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
