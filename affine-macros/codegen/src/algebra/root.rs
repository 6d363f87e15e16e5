//! Square roots of rationals.

use num_bigint::BigInt;

use super::rational::Rational;

/// Bits of a root at least: more than a double-double holds.
const BITS: u64 = 160;

/// The square root of a positive number: exact for squares, otherwise from below with a relative error under `2^-159`.
/// `None` for other numbers.
pub fn root(value: &Rational) -> Option<Rational> {
    if value.is_negative() || value.is_zero() {
        return None;
    }
    // sqrt(p/q) = sqrt(p q)/q, and p q 4^k has a root of as many bits as k adds.
    let (numerator, denominator) = value.parts();
    let shift = BITS;
    let scaled: BigInt = (&numerator * &denominator) << (2 * shift);
    Rational::quotient(scaled.sqrt(), denominator << shift)
}
