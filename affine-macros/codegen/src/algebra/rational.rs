//! Exact rational numbers: machine words while they fit, big integers beyond.
//!
//! The macro runs unoptimised in its users' builds, where big integers cost microseconds each; nearly every
//! coefficient of a kinetic energy fits a word.

mod rounded;

use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::fault::never_missing;

/// An exact rational number.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Rational(Repr);

/// Lowest terms, positive denominator; `Big` only for what does not fit `Small`, so that equality is structural.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
enum Repr {
    Small(i64, i64),
    /// Boxed, so that it takes no room where there is none.
    Big(Box<BigRational>),
}

impl Rational {
    /// 0.
    pub const ZERO: Self = Self(Repr::Small(0, 1));
    /// 1.
    pub const ONE: Self = Self(Repr::Small(1, 1));
    /// -1.
    pub const MINUS_ONE: Self = Self(Repr::Small(-1, 1));
    /// 1/2.
    pub const HALF: Self = Self(Repr::Small(1, 2));
    /// 1/3.
    pub const THIRD: Self = Self(Repr::Small(1, 3));
    /// 1/4.
    pub const QUARTER: Self = Self(Repr::Small(1, 4));

    /// The number of so many things.
    pub fn whole(count: usize) -> Self {
        i64::try_from(count)
            .map_or_else(|_| Self::shrink(BigRational::from_integer(count.into())), Self::from)
    }

    /// `1 / count`, of a count that is not zero.
    #[track_caller]
    pub fn one_over(count: usize) -> Self {
        never_missing(Self::whole(count).recip(), "what is divided by counts something", Self::ZERO)
    }

    /// `numerator / denominator`; `None` for a zero denominator.
    pub fn ratio(numerator: i64, denominator: i64) -> Option<Self> {
        (denominator != 0).then(|| Self::lowest(i128::from(numerator), i128::from(denominator)))
    }

    /// The number a decimal literal denotes, exactly: `12`, `0.2`, `1e-3`, `1_000.5`.
    pub fn parse_decimal(literal: &str) -> Option<Self> {
        let text: String = literal.chars().filter(|c| *c != '_').collect();
        let (mantissa, exponent) = match text.find(['e', 'E']) {
            Some(at) => (&text[..at], text[at + 1..].parse::<i32>().ok()?),
            None => (text.as_str(), 0),
        };
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let digits = format!("{whole}{fraction}");
        if digits.is_empty() || !digits.bytes().all(|b| b.is_ascii_digit()) {
            return None;
        }
        let power = exponent.checked_sub(i32::try_from(fraction.len()).ok()?)?;
        // A double ends at 1e308; far beyond that an exact power of ten only costs time.
        if power.unsigned_abs() > 5000 {
            return None;
        }
        let digits = Self::shrink(BigRational::from_integer(digits.parse::<BigInt>().ok()?));
        Some(&digits * &Self::from(10).pow(power)?)
    }

    /// Reciprocal; `None` for zero.
    pub fn recip(&self) -> Option<Self> {
        if self.is_zero() {
            return None;
        }
        Some(match &self.0 {
            Repr::Small(n, d) => Self::lowest(i128::from(*d), i128::from(*n)),
            Repr::Big(b) => Self::shrink(b.recip()),
        })
    }

    /// `self / other`; `None` for a zero divisor.
    pub fn checked_div(&self, other: &Self) -> Option<Self> {
        Some(self * &other.recip()?)
    }

    /// Integer power; `None` for a negative power of zero.
    pub fn pow(&self, exponent: i32) -> Option<Self> {
        let base = if exponent < 0 { self.recip()? } else { self.clone() };
        let mut result = Self::ONE;
        for bit in (0..32).rev() {
            result = &result * &result;
            if exponent.unsigned_abs() >> bit & 1 == 1 {
                result = &result * &base;
            }
        }
        Some(result)
    }

    /// Zero?
    pub fn is_zero(&self) -> bool {
        matches!(self.0, Repr::Small(0, _))
    }

    /// One?
    pub fn is_one(&self) -> bool {
        matches!(self.0, Repr::Small(1, 1))
    }

    /// Less than zero?
    pub fn is_negative(&self) -> bool {
        match &self.0 {
            Repr::Small(n, _) => *n < 0,
            Repr::Big(b) => b.is_negative(),
        }
    }

    /// Whole number?
    pub fn is_integer(&self) -> bool {
        match &self.0 {
            Repr::Small(_, d) => *d == 1,
            Repr::Big(b) => b.is_integer(),
        }
    }

    /// The whole number as a machine word, if it is one.
    pub fn to_i64(&self) -> Option<i64> {
        match &self.0 {
            Repr::Small(n, 1) => Some(*n),
            _ => None,
        }
    }

    /// Absolute value.
    pub fn abs(&self) -> Self {
        if self.is_negative() { -self } else { self.clone() }
    }

    /// `numerator / denominator`; `None` for a zero denominator.
    pub fn quotient(numerator: BigInt, denominator: BigInt) -> Option<Self> {
        (!denominator.is_zero()).then(|| Self::shrink(BigRational::new(numerator, denominator)))
    }

    /// Numerator and positive denominator in lowest terms.
    pub fn parts(&self) -> (BigInt, BigInt) {
        self.to_big().into_raw()
    }

    /// Residues of numerator and denominator, `0 <= r < modulus`.
    pub fn residues(&self, modulus: u64) -> (u64, u64) {
        match &self.0 {
            Repr::Small(n, d) => {
                let size = n.unsigned_abs() % modulus;
                let numerator = if *n < 0 && size > 0 { modulus - size } else { size };
                (numerator, d.unsigned_abs() % modulus)
            }
            Repr::Big(b) => {
                let size = |value: &BigInt| {
                    let rest = (value.magnitude() % modulus).to_u64();
                    never_missing(rest, "a rest by division fits where the divisor does", 0)
                };
                let numerator = size(b.numer());
                let numerator =
                    if b.is_negative() && numerator > 0 { modulus - numerator } else { numerator };
                (numerator, size(b.denom()))
            }
        }
    }

    fn to_big(&self) -> BigRational {
        match &self.0 {
            Repr::Small(n, d) => BigRational::new_raw((*n).into(), (*d).into()),
            Repr::Big(b) => (**b).clone(),
        }
    }

    fn shrink(big: BigRational) -> Self {
        match (big.numer().to_i64(), big.denom().to_i64()) {
            (Some(n), Some(d)) => Self(Repr::Small(n, d)),
            _ => Self(Repr::Big(Box::new(big))),
        }
    }

    fn lowest(numerator: i128, denominator: i128) -> Self {
        let common = gcd(numerator.unsigned_abs(), denominator.unsigned_abs()).cast_signed();
        let sign = if denominator < 0 { -1 } else { 1 };
        let (n, d) = (sign * numerator / common, sign * denominator / common);
        match (i64::try_from(n), i64::try_from(d)) {
            (Ok(n), Ok(d)) => Self(Repr::Small(n, d)),
            _ => Self(Repr::Big(Box::new(BigRational::new(n.into(), d.into())))),
        }
    }
}

/// An exponent that is a count: a dimension, or how often a factor stands in a product.
#[track_caller]
pub fn exponent(count: usize) -> i32 {
    never_missing(i32::try_from(count).ok(), "no product has 2^31 factors", 0)
}

fn gcd(mut a: u128, mut b: u128) -> u128 {
    // Words divide in hardware, u128 by a library loop.
    while b != 0 {
        if let (Ok(x), Ok(y)) = (u64::try_from(a), u64::try_from(b)) {
            let (mut x, mut y) = (x, y);
            while y != 0 {
                (x, y) = (y, x % y);
            }
            return x.into();
        }
        (a, b) = (b, a % b);
    }
    a.max(1)
}

impl From<i64> for Rational {
    fn from(value: i64) -> Self {
        Self(Repr::Small(value, 1))
    }
}

impl Neg for &Rational {
    type Output = Rational;
    fn neg(self) -> Rational {
        match &self.0 {
            Repr::Small(n, d) => Rational::lowest(-i128::from(*n), i128::from(*d)),
            Repr::Big(b) => Rational::shrink(-&**b),
        }
    }
}

impl Add for &Rational {
    type Output = Rational;
    fn add(self, other: &Rational) -> Rational {
        match (&self.0, &other.0) {
            (Repr::Small(a, 1), Repr::Small(b, 1)) => match a.checked_add(*b) {
                Some(sum) => Rational(Repr::Small(sum, 1)),
                None => Rational::lowest(i128::from(*a) + i128::from(*b), 1),
            },
            (Repr::Small(a, b), Repr::Small(c, d)) => {
                let (a, b, c, d) = (i128::from(*a), i128::from(*b), i128::from(*c), i128::from(*d));
                // |a d|, |c b| <= 2^126: the sum stays below 2^127.
                Rational::lowest(a * d + c * b, b * d)
            }
            _ => Rational::shrink(self.to_big() + other.to_big()),
        }
    }
}

impl Sub for &Rational {
    type Output = Rational;
    fn sub(self, other: &Rational) -> Rational {
        self + &-other
    }
}

impl Mul for &Rational {
    type Output = Rational;
    fn mul(self, other: &Rational) -> Rational {
        match (&self.0, &other.0) {
            (Repr::Small(1, 1), _) => other.clone(),
            (_, Repr::Small(1, 1)) => self.clone(),
            (Repr::Small(a, b), Repr::Small(c, d)) => {
                Rational::lowest(i128::from(*a) * i128::from(*c), i128::from(*b) * i128::from(*d))
            }
            _ => Rational::shrink(self.to_big() * other.to_big()),
        }
    }
}

impl PartialOrd for Rational {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Rational {
    fn cmp(&self, other: &Self) -> Ordering {
        match (&self.0, &other.0) {
            (Repr::Small(a, b), Repr::Small(c, d)) => {
                (i128::from(*a) * i128::from(*d)).cmp(&(i128::from(*c) * i128::from(*b)))
            }
            _ => self.to_big().cmp(&other.to_big()),
        }
    }
}

impl Zero for Rational {
    fn zero() -> Self {
        Self::ZERO
    }
    fn is_zero(&self) -> bool {
        self.is_zero()
    }
}

impl One for Rational {
    fn one() -> Self {
        Self::ONE
    }
}

macro_rules! by_value {
    ($trait:ident, $method:ident, $output:ty) => {
        impl $trait for Rational {
            type Output = $output;
            fn $method(self, other: Rational) -> $output {
                (&self).$method(&other)
            }
        }
    };
}
by_value!(Add, add, Rational);
by_value!(Sub, sub, Rational);
by_value!(Mul, mul, Rational);
