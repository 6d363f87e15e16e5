//! Division by small whole numbers, without one.

use super::HIGHEST_ORDER;
use crate::scalar::Scalar;

/// A whole number that is divided by, as its reciprocal in two parts.
///
/// The nearest double alone would be off by the same in every step of a motion, and the energy drift. What it leaves out
/// has its share: `v/n = v r + v r'`, where `r + r'` is off by `2^-107`, and the rounding of both products and their sum
/// follows the digits of `v`. That takes half the time of a division, which no other can overlap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Divisor<T> {
    pub(super) nearest: T,
    pub(super) rest: T,
}

impl<T: Scalar> Divisor<T> {
    /// The divisor `n > 0`.
    #[inline(always)]
    pub(crate) fn of(n: usize) -> Self {
        let [nearest, rest] = RECIPROCALS.get(n).copied().unwrap_or_else(|| reciprocal(n));
        Self { nearest: T::constant(nearest, 0.0), rest: T::constant(rest, 0.0) }
    }

    /// `n` over a unit, which is a power of two.
    #[inline(always)]
    pub(crate) fn over(self, unit: T) -> Self {
        Self { nearest: self.nearest * unit, rest: self.rest * unit }
    }
}

/// `value/n`.
#[inline(always)]
pub fn over<T: Scalar>(value: T, divisor: Divisor<T>) -> T {
    value.fma(divisor.nearest, value * divisor.rest)
}

const RECIPROCALS: [[f64; 2]; HIGHEST_ORDER + 2] = {
    let mut all = [[0.0; 2]; HIGHEST_ORDER + 2];
    let mut n = 1;
    while n < all.len() {
        all[n] = reciprocal(n);
        n += 1;
    }
    all
};

/// `1/n` rounded, and what is left.
const fn reciprocal(n: usize) -> [f64; 2] {
    let nearest = 1.0 / n as f64;
    // Half the digits: their product with a number below 2^26 is exact, and so is that of the other half.
    let half = f64::from_bits(nearest.to_bits() & !0x7ff_ffff);
    let left = (1.0 - half * n as f64) - (nearest - half) * n as f64;
    [nearest, left / n as f64]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_parts_make_a_reciprocal() {
        for n in 1..=1000_u32 {
            let [nearest, rest] = reciprocal(n as usize);
            assert_eq!(nearest, 1.0 / f64::from(n));
            // What `n` of the first part lack of 1, in one rounding.
            let lacking = nearest.mul_add(-f64::from(n), 1.0);
            assert!((rest * f64::from(n) - lacking).abs() <= lacking.abs() * f64::EPSILON, "1/{n}");
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
