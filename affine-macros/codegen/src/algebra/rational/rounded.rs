//! Rational numbers as doubles and as text.

use std::fmt;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::ToPrimitive;

use super::{Rational, Repr, exponent};
use crate::algebra::fault::never_missing;

impl Rational {
    /// Does it have more digits than anyone reads, as what stands for an irrational number has?
    pub fn is_long(&self) -> bool {
        match &self.0 {
            Repr::Small(..) => false,
            Repr::Big(b) => b.numer().bits() + b.denom().bits() > 256,
        }
    }

    /// For readers: exactly, or the nearest double of a long one, of one beyond them to three digits.
    pub fn shown(&self) -> String {
        match self.is_long() {
            false => self.to_string(),
            true if self.fits_a_double() => self.to_doubles().0.to_string(),
            true => self.about(),
        }
    }

    /// Is it zero, or of the size of a normal double: does rounding leave it its digits?
    pub fn fits_a_double(&self) -> bool {
        match &self.0 {
            Repr::Small(..) => true,
            Repr::Big(b) => nearest(b).is_normal(),
        }
    }

    /// `k` with `2^(k - 1) < |number| < 2^(k + 1)`; 0 for zero.
    pub fn binary_exponent(&self) -> i64 {
        let (numerator, denominator) = self.parts();
        let bits =
            |part: BigInt| never_missing(i64::try_from(part.bits()).ok(), "a number fits in memory", 0);
        if self.is_zero() { 0 } else { bits(numerator) - bits(denominator) }
    }

    /// To three digits, however large or small: `1e-400`, `-2.35e312`.
    pub fn about(&self) -> String {
        // Digits above less digits below: the decimal exponent, or one more.
        let (numerator, denominator) = self.abs().parts();
        let digits = |part: &BigInt| exponent(part.to_string().len());
        let exponent = digits(&numerator) - digits(&denominator);
        let unit = never_missing(Self::from(10).pow(-exponent), "ten is not zero", Self::ONE);
        let scaled = format!("{:.2e}", (self * &unit).to_doubles().0);
        let parts =
            scaled.split_once('e').and_then(|(mantissa, rest)| Some((mantissa, rest.parse::<i32>().ok()?)));
        let (mantissa, rest) = never_missing(parts, "this notation has a whole exponent", (&scaled, 0));
        let exponent = exponent + rest;
        format!("{}e{exponent}", mantissa.trim_end_matches('0').trim_end_matches('.'))
    }

    /// The double nearest to the number, and the double nearest to the rest: correct to double-double.
    pub fn to_doubles(&self) -> (f64, f64) {
        let exact = self.to_big();
        let hi = nearest(&exact);
        let lo = BigRational::from_float(hi).map_or(0.0, |value| nearest(&(exact - value)));
        (hi, lo)
    }

    /// The number to half the digits of a double, the double nearest to the rest, and the one nearest to what is left.
    pub fn to_halves(&self) -> [f64; 3] {
        let exact = self.to_big();
        let half = f64::from_bits(nearest(&exact).to_bits() & !0x7ff_ffff);
        let rest = BigRational::from_float(half).map_or_else(BigRational::default, |half| exact - half);
        let (rest, left) = Self::shrink(rest).to_doubles();
        [half, rest, left]
    }
}

/// `num-rational` rounds the quotient to nearest, ties to even.
fn nearest(value: &BigRational) -> f64 {
    never_missing(value.to_f64(), "every fraction has a nearest double or infinity", f64::NAN)
}

impl fmt::Display for Rational {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            Repr::Small(n, 1) => write!(f, "{n}"),
            Repr::Small(n, d) => write!(f, "{n}/{d}"),
            Repr::Big(b) => write!(f, "{b}"),
        }
    }
}
