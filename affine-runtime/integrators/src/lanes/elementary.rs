//! Elementary functions without branches and tables, which compilers turn into vector instructions.
//!
//! An argument is reduced to where a Taylor polynomial, with coefficients known in advance, ends below rounding; nothing
//! is fused. Errors are in units of the last place (ulp) of the result, wherever that is a normal number.

use core::f64::consts::LOG2_E;

use affine_core::__private::numerics::{LN2_HIGH, LN2_LOW, SERIES, of_regular};

/// `2^52 + 2^51`: what is added to it is rounded to an integer, found in the lowest bits.
const INTEGER: f64 = 6_755_399_441_055_744.0;

/// `2/3, 2/5, .. 2/23`: for `s^2 <= (3 - 2 sqrt 2)^2` the next term of `2 artanh(s)/s` is below `2^-63`.
const LOGARITHM: [f64; 11] = [
    2.0 / 3.0,
    2.0 / 5.0,
    2.0 / 7.0,
    2.0 / 9.0,
    2.0 / 11.0,
    2.0 / 13.0,
    2.0 / 15.0,
    2.0 / 17.0,
    2.0 / 19.0,
    2.0 / 21.0,
    2.0 / 23.0,
];

/// `sum_k c_k x^k`.
#[inline(always)]
fn polynomial(coefficients: &[f64], x: f64) -> f64 {
    let mut sum = 0.0;
    for coefficient in coefficients.iter().rev() {
        sum = sum * x + coefficient;
    }
    sum
}

/// `2^k` of an integer from -1022 to 1023, with nothing but an addition and a shift.
#[inline(always)]
fn power_of_two(k: f64) -> f64 {
    f64::from_bits((k + (INTEGER + 1023.0)).to_bits() << 52)
}

/// `(e^r - 1, k)` with `x = k ln 2 + r`, `|r| <= ln 2/2`.
#[inline(always)]
fn reduced(x: f64) -> (f64, f64) {
    let k = (x * LOG2_E + INTEGER) - INTEGER;
    let r = (x - k * LN2_HIGH) - k * LN2_LOW;
    // The first term left out, r^14/14!, is below 2^-57.
    (r + r * r * polynomial(&SERIES[2..14], r), k)
}

/// An argument within limits; NaN stays.
#[inline(always)]
fn within(x: f64, least: f64, most: f64) -> f64 {
    let x = if x < least { least } else { x };
    if x > most { most } else { x }
}

/// `e^x`.
#[inline(always)]
pub(crate) fn exp(x: f64) -> f64 {
    let (less, k) = reduced(within(x, -746.0, 710.0));
    // In two factors: the power itself may be out of range.
    let half = (0.5 * k + INTEGER) - INTEGER;
    (1.0 + less) * power_of_two(half) * power_of_two(k - half)
}

/// `e^x - 1`.
#[inline(always)]
pub(crate) fn exp_m1(x: f64) -> f64 {
    let (less, k) = reduced(within(x, -40.0, 710.0));
    let half = power_of_two(k - 1.0);
    let value = 2.0 * (half * less + (half - 0.5));
    // The sign of a zero.
    if x == 0.0 { x } else { value }
}

/// `((e^x - 1)/4, e^x/4)` of a number from 0 on, up to which `sinh` and `cosh` are finite and beyond.
#[inline(always)]
fn quarters(x: f64) -> (f64, f64) {
    let (less, k) = reduced(within(x, 0.0, 710.5));
    let quarter = power_of_two(k - 2.0);
    (quarter * less + (quarter - 0.25), quarter * less + quarter)
}

/// `sinh x`.
#[inline(always)]
pub(crate) fn sinh(x: f64) -> f64 {
    let (less, _) = quarters(x.abs());
    (2.0 * (less + less / (4.0 * less + 1.0))).copysign(x)
}

/// `cosh x`.
#[inline(always)]
pub(crate) fn cosh(x: f64) -> f64 {
    let (_, quarter) = quarters(x.abs());
    2.0 * (quarter + 0.0625 / quarter)
}

/// `tanh x`.
#[inline(always)]
pub(crate) fn tanh(x: f64) -> f64 {
    let less = exp_m1(2.0 * within(x.abs(), 0.0, 22.0));
    (less / (less + 2.0)).copysign(x)
}

/// `ln x`.
#[inline(always)]
pub(crate) fn ln(x: f64) -> f64 {
    const MANTISSA: u64 = 0x000f_ffff_ffff_ffff;
    const ONE: u64 = 0x3ff0_0000_0000_0000;
    const SQRT_HALF: u64 = 0x3fe6_a09e_667f_3bcd;
    let subnormal = x < f64::MIN_POSITIVE;
    let bits = (if subnormal { x * 18_014_398_509_481_984.0 } else { x }).to_bits();
    // x = 2^k m with m from sqrt(1/2) to sqrt 2: k + 1023 is the exponent of x 2/sqrt 2.
    let above = bits.wrapping_add(ONE - SQRT_HALF);
    let exponent = f64::from_bits((above >> 52) | 0x4330_0000_0000_0000) - 4_503_599_627_370_496.0;
    let k = exponent - if subnormal { 1023.0 + 54.0 } else { 1023.0 };
    let f = f64::from_bits((above & MANTISSA) + SQRT_HALF) - 1.0;
    // ln(1 + f) = f - f^2/2 + s (f^2/2 + s^2 P(s^2)) with s = f/(2 + f), so that f itself is not rounded.
    let s = f / (2.0 + f);
    let (square, half) = (s * s, 0.5 * f * f);
    let rest = s * (half + square * polynomial(&LOGARITHM, square));
    let value = k * LN2_HIGH - ((half - (rest + k * LN2_LOW)) - f);
    let value = if x < f64::INFINITY { value } else { x };
    let value = if x == 0.0 { f64::NEG_INFINITY } else { value };
    if x < 0.0 { f64::NAN } else { value }
}

/// `ln(1 + x)`.
#[inline(always)]
pub(crate) fn ln_1p(x: f64) -> f64 {
    let u = 1.0 + x;
    // What the sum lost, relative to it.
    let lost = (x - (u - 1.0)) / u;
    let value = ln(u) + lost;
    let value = if u > 0.0 && u < f64::INFINITY { value } else { ln(u) };
    if x == 0.0 { x } else { value }
}

/// `arsinh x`.
#[inline(always)]
pub(crate) fn asinh(x: f64) -> f64 {
    let size = x.abs();
    let square = size * size;
    let less = size + square / (1.0 + affine_core::scalar::Scalar::sqrt(1.0 + square));
    // Where the square would be out of range, `ln(2 |x|)` is as good.
    let (of, more) = if size < 1e150 { (less, 0.0) } else { (size, core::f64::consts::LN_2) };
    (ln_1p(of) + more).copysign(x)
}

/// `2^18`, whose cube brings subnormal numbers up and the largest, whose root cubed may be too large, down.
const SCALE: f64 = 262_144.0;
const CUBE: f64 = SCALE * SCALE * SCALE;

/// A positive number times the cube of a power of two, `x^(-1/3)` of that, and the power.
#[inline(always)]
fn inverse_root(size: f64) -> (f64, f64, f64) {
    let (up, down) = (size < f64::MIN_POSITIVE, size > 1e300);
    let scaled = size * if up { CUBE } else { 1.0 } * if down { 1.0 / CUBE } else { 1.0 };
    let power = if up { SCALE } else { 1.0 } * if down { 1.0 / SCALE } else { 1.0 };
    (scaled, of_regular(scaled), power)
}

/// `x^(-1/3)`.
#[inline(always)]
pub(crate) fn inverse_cbrt(x: f64) -> f64 {
    let (_, root, power) = inverse_root(x.abs());
    let root = if x == 0.0 { f64::INFINITY } else { root * power };
    let root = if x.abs() == f64::INFINITY { 0.0 } else { root };
    root.copysign(x)
}

/// `x^(1/3)`.
#[inline(always)]
pub(crate) fn cbrt(x: f64) -> f64 {
    let (scaled, inverse, power) = inverse_root(x.abs());
    let root = scaled * inverse * inverse;
    // A step of Newton's method for the root itself, which its own rounding needs.
    let root = root + (scaled - root * root * root) * (inverse * inverse) * (1.0 / 3.0);
    let root = if x.abs() < f64::INFINITY { root / power } else { x.abs() };
    root.copysign(x)
}
