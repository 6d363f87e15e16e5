//! Numbers modulo a prime: exact arithmetic in one machine word, however long the fractions are.
//!
//! What is not zero here is not zero; what is zero here may still be a multiple of the prime.

use super::arena::{Arena, Expr};
use super::evaluate::{Field, evaluate};
use super::function::Function;
use super::rational::Rational;
use crate::symbol::Symbol;

/// A residue modulo the Mersenne prime `2^61 - 1`; none for fractions whose denominator it divides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[must_use]
pub struct Residue(Option<u64>);

impl Residue {
    /// The prime.
    pub const MODULUS: u64 = (1 << 61) - 1;
    /// The largest number in a small fraction.
    pub const SMALL: i64 = 1 << 15;
    /// 0.
    pub const ZERO: Self = Self(Some(0));
    /// Nothing is known.
    pub const UNKNOWN: Self = Self(None);

    /// A value for an indeterminate that depends on its name alone.
    pub fn sample(name: &str) -> Self {
        Self(Some(hash(name) % Self::MODULUS))
    }

    /// The fraction that it stands for, numerator and denominator at most [`SMALL`](Self::SMALL) (Wang, Proc. SYMSAC 1981,
    /// 212); `None` where no such fraction does. Of all residues one in 2^30 stands for one.
    pub fn small_fraction(self) -> Option<(i64, i64)> {
        let modulus = i64::try_from(Self::MODULUS).ok()?;
        let (mut before, mut above) = (modulus, i64::try_from(self.0?).ok()?);
        let (mut of_before, mut below) = (0_i64, 1_i64);
        while above > Self::SMALL {
            let quotient = before / above;
            (before, above) = (above, before % above);
            (of_before, below) = (below, of_before - quotient * below);
        }
        (below.abs() <= Self::SMALL).then_some((above * below.signum(), below.abs()))
    }

    /// Proved to be different from zero?
    pub fn is_nonzero(self) -> bool {
        self.0.is_some_and(|value| value != 0)
    }
}

/// FNV-1a, and the last steps of SplitMix64 (Steele et al., OOPSLA 2014), without which names that differ in the last letter
/// alone have values in arithmetic progression.
pub(super) fn hash(name: &str) -> u64 {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for byte in name.bytes() {
        hash = (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    }
    hash = (hash ^ (hash >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    hash = (hash ^ (hash >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    hash ^ (hash >> 31)
}

/// Does the value of the expression change with the symbols that are not `kept`, at two points? Also where it has none.
pub fn depends_on(arena: &Arena, expr: Expr, kept: &impl Fn(&Symbol) -> Option<Residue>) -> bool {
    let value = |point: &str| {
        at(arena, expr, &|symbol| {
            kept(symbol).unwrap_or_else(|| Residue::sample(&format!("{symbol}{point}")))
        })
    };
    let [one, other] = POINTS.map(value);
    one.is_none() || one != other
}

/// Endings of names, which make other samples of them.
pub(super) const POINTS: [&str; 2] = ["", "'"];

fn at(arena: &Arena, expr: Expr, value: &dyn Fn(&Symbol) -> Residue) -> Option<u64> {
    evaluate(arena, expr, &|symbol| Some(value(symbol)))?.0
}

fn product(a: u64, b: u64) -> u64 {
    let wide = u128::from(a) * u128::from(b);
    // 2^61 = 1 modulo the prime; both parts fit 61 bits.
    let low = (wide & u128::from(Residue::MODULUS)) as u64;
    let high = (wide >> 61) as u64;
    reduced(low + high)
}

/// The residue of a number below twice the modulus.
fn reduced(value: u64) -> u64 {
    if value < Residue::MODULUS { value } else { value - Residue::MODULUS }
}

impl Field for Residue {
    fn from_rational(value: &Rational) -> Self {
        let (numerator, denominator) = value.residues(Self::MODULUS);
        let numerator = Self(Some(numerator));
        match denominator {
            1 => numerator,
            _ => Self(Some(denominator)).recip().map_or(Self::UNKNOWN, |inverse| numerator.mul(&inverse)),
        }
    }

    fn add(&self, other: &Self) -> Self {
        let (Some(a), Some(b)) = (self.0, other.0) else { return Self::UNKNOWN };
        Self(Some(reduced(a + b)))
    }

    fn mul(&self, other: &Self) -> Self {
        let (Some(a), Some(b)) = (self.0, other.0) else { return Self::UNKNOWN };
        Self(Some(product(a, b)))
    }

    /// Any function of an argument, by a value for the two together: an identity that holds for these holds for every
    /// function, and what only the properties of one function make true does not hold here.
    fn apply(&self, function: Function) -> Option<Self> {
        Some(Self::sample(&format!("{}({})", function.name(), self.0?)))
    }

    /// Fermat: `a^(p-2) = 1/a`.
    fn recip(&self) -> Option<Self> {
        let mut square = self.0.filter(|value| *value != 0)?;
        let mut exponent = Self::MODULUS - 2;
        let mut power = 1;
        while exponent > 0 {
            if exponent & 1 == 1 {
                power = product(power, square);
            }
            square = product(square, square);
            exponent >>= 1;
        }
        Some(Self(Some(power)))
    }
}
