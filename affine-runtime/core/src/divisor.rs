//! Division by small whole numbers and other constants, without one.

use crate::scalar::Scalar;

/// The highest order of Taylor polynomials.
pub const HIGHEST_ORDER: usize = 32;
/// The lowest order of Taylor polynomials: the step follows from two coefficients.
pub const LOWEST_ORDER: usize = 2;

/// A number that is divided by, as its reciprocal in two parts.
///
/// The nearest double alone would be off by the same in every step of a motion, and the energy drift. In `v/n = v r + v r'`
/// the first part has half the digits of a double: the second is far above what rounding the first product leaves out, or
/// it would be lost in the sum. `r + r'` is off by `2^-79` in doubles, and what is rounded follows the digits of `v`. That takes half the
/// time of a division, which no other can overlap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Divisor<T> {
    /// Half of the digits.
    pub half: T,
    /// What these leave out.
    pub rest: T,
}

impl<T: Scalar> Divisor<T> {
    /// The divisor `n > 0`.
    #[inline(always)]
    pub fn of(n: usize) -> Self {
        let [half, rest, left] = RECIPROCALS.get(n).copied().unwrap_or_else(|| reciprocal(n));
        Self::with_reciprocal(half, rest, left)
    }

    /// The divisor with a reciprocal of so many parts: half of the digits, the rest, and what that leaves out.
    #[must_use]
    #[inline(always)]
    pub fn with_reciprocal(half: f64, rest: f64, left: f64) -> Self {
        Self { half: T::constant(half, 0.0), rest: T::constant(rest, left) }
    }

    /// `n` over a unit, which is a power of two.
    #[inline(always)]
    pub fn over(self, unit: T) -> Self {
        Self { half: self.half * unit, rest: self.rest * unit }
    }
}

/// `value/n`.
#[inline(always)]
pub fn over<T: Scalar>(value: T, divisor: Divisor<T>) -> T {
    value.fma(divisor.half, value * divisor.rest)
}

const RECIPROCALS: [[f64; 3]; HIGHEST_ORDER + 2] = {
    let mut all = [[0.0; 3]; HIGHEST_ORDER + 2];
    let mut n = 1;
    while n < all.len() {
        all[n] = reciprocal(n);
        n += 1;
    }
    all
};

/// `1/n` to half the digits of a double, the rest rounded, and what is left of that.
const fn reciprocal(n: usize) -> [f64; 3] {
    // Half the digits times a number below 2^26 is exact, and so is what lacks of 1 then.
    let half = leading(1.0 / n as f64);
    let lacking = 1.0 - half * n as f64;
    let rest = lacking / n as f64;
    let lacking = (lacking - leading(rest) * n as f64) - (rest - leading(rest)) * n as f64;
    [half, rest, lacking / n as f64]
}

/// The leading half of the digits.
const fn leading(value: f64) -> f64 {
    f64::from_bits(value.to_bits() & !0x7ff_ffff)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_parts_make_a_reciprocal() {
        for n in 1..=1000_u32 {
            let ([half, rest, left], n) = (reciprocal(n as usize), f64::from(n));
            // What `n` of the parts so far lack of 1, rounded once at most.
            let lacking = half.mul_add(-n, 1.0);
            assert!((half - 1.0 / n).abs() <= half * 2f64.powi(-25), "1/{n}");
            assert_eq!(rest, lacking / n, "1/{n}");
            assert_eq!(left, rest.mul_add(-n, lacking) / n, "1/{n}");
        }
    }

    /// A mean error of the size of a rounding would add up over the steps of a motion.
    #[test]
    fn quotients_are_off_by_nothing_on_average() {
        for n in 3..=HIGHEST_ORDER + 1 {
            let count = 10000_u32;
            let error = |k: u32| {
                let value = f64::from(k).sqrt();
                let quotient = over(value, Divisor::of(n));
                // Exact: quotient times n less value.
                quotient.mul_add(n as f64, -value) / value / f64::EPSILON
            };
            let mean = (1..=count).map(error).sum::<f64>() / f64::from(count);
            assert!(mean.abs() < 0.02, "1/{n}: {mean}");
        }
    }

    /// The parts are those that the generator writes for `5/18` and `5/6`.
    #[test]
    fn products_with_fractions_are_off_by_nothing_on_average() {
        for (reciprocal, parts) in [
            (5.0 / 18.0, [0.277_777_776_122_093_2, 1.655_684_577_094_184e-9, 9.190_895_695_033_64e-26]),
            (5.0 / 6.0, [0.833_333_328_366_279_6, 4.967_053_731_282_552e-9, 2.757_268_708_510_092e-25]),
        ] {
            let divisor = Divisor::<f64>::with_reciprocal(parts[0], parts[1], parts[2]);
            let (numerator, denominator) = (5.0, 5.0 / reciprocal);
            let count = 10000_u32;
            let error = |k: u32| {
                let value = f64::from(k).sqrt();
                let product = over(value, divisor);
                // Exact but for one rounding of what is small: product times denominator less value times numerator.
                let of_value = value * numerator;
                let lacking = value.mul_add(numerator, -of_value);
                (product.mul_add(denominator, -of_value) - lacking) / of_value / f64::EPSILON
            };
            let mean = (1..=count).map(error).sum::<f64>() / f64::from(count);
            assert!(mean.abs() < 0.02, "{reciprocal}: {mean}");
            let worst = (1..=count).map(|k| error(k).abs()).fold(0.0, f64::max);
            assert!(worst < 1.0, "{reciprocal}: {worst}");
        }
    }

    #[test]
    fn quotients_are_rounded_once_or_twice() {
        for n in 1..=HIGHEST_ORDER + 1 {
            for k in 1..100_u32 {
                let value = f64::from(k).sqrt();
                let (quotient, divided) = (over(value, Divisor::of(n)), value / n as f64);
                assert!((quotient - divided).abs() <= divided * f64::EPSILON, "{value}/{n}");
            }
        }
    }
}
