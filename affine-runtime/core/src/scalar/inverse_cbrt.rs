//! `x^(-1/3)` without division and without a call: what isotropic potentials of bodies in space take of `det phi`.
//!
//! From an approximation `r`, a third of the exponent and mantissa of `x` taken as one integer, and `e = 1 - x r^3`:
//! `x^(-1/3) = r (1 - e)^(-1/3)`. For all `x`, `|e| < 0.1027`, and there a polynomial of degree 12 is the power up to
//! `6e-18`: one that interpolates `((1 - e)^(-1/3) - 1)/e` at Chebyshev's points.
//!
//! The integer third as a first approximation of a cube root: W. Kahan, Computing a real cube root (1991).

use super::Scalar;

/// Of the integer whose high half is `SEED` less a third of that of `x`; the choice that makes the largest `|e|` least.
const SEED: u64 = 0x553e_e800;
/// `2^32/3`, rounded up.
const THIRD: u64 = 0x5555_5556;
/// The polynomial.
const P: [f64; 12] = [
    0.333_333_333_333_333_26,
    0.222_222_222_222_222_18,
    0.172_839_506_173_155_66,
    0.144_032_921_811_000_72,
    0.124_828_531_886_485_23,
    0.110_958_694_987_963_1,
    0.100_391_341_690_519_72,
    0.092_025_401_613_550_18,
    0.085_182_839_540_290_03,
    0.079_503_489_594_095_27,
    0.076_864_901_859_594_45,
    0.072_611_979_706_684_12,
];

/// `x^(-1/3)`, with the sign of `x`; infinite at zero. Relative error below `0.75 epsilon`, as that of `1.0 / cbrt(x)`.
#[inline(always)]
pub(super) fn inverse_cbrt(x: f64) -> f64 {
    if is_regular(x) { of_regular(x) } else { of_any(x) }
}

/// Normal and positive.
#[inline(always)]
pub(crate) fn is_regular(x: f64) -> bool {
    (f64::MIN_POSITIVE..=f64::MAX).contains(&x)
}

/// `x^(-1/3)` of a regular number.
#[inline(always)]
pub fn of_regular(x: f64) -> f64 {
    let third = ((x.to_bits() >> 32) * THIRD) >> 32;
    let r = f64::from_bits((SEED - third) << 32);
    let e = (-(x * r)).fma(r * r, 1.0);
    // In powers of `e^4`, so that little waits for what is before it.
    let square = e * e;
    let pair = |k: usize| P[k + 1].fma(e, P[k]);
    let four = |k: usize| pair(k + 2).fma(square, pair(k));
    let (fourth, line) = (square * square, r * e);
    let high = four(8) * (fourth * (line * fourth));
    let rest = four(4).fma(line * fourth, high);
    r + four(0).fma(line, rest)
}

#[cold]
fn of_any(x: f64) -> f64 {
    1.0 / libm::cbrt(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `1 - x r^3` for `r` near `x^(-1/3)`, with all digits of the products.
    fn defect(x: f64, r: f64) -> f64 {
        let product = |a: f64, b: f64| (a * b, f64::mul_add(a, b, -(a * b)));
        let (square, square_rest) = product(r, r);
        let (line, line_rest) = product(x, r);
        let (whole, rest) = product(line, square);
        (1.0 - whole) - (rest + line * square_rest + line_rest * square)
    }

    #[test]
    fn as_good_as_a_quotient() {
        let mut largest = [0.0_f64; 2];
        for octant in [1.0, 1.0 / 64.0, 4096.0, 2.0_f64.powi(600), 2.0_f64.powi(-600)] {
            for k in 0..40_000 {
                // A cube of two: the exponent runs through all rests modulo 3.
                let x = octant * (1.0 + 7.0 * f64::from(k) / 40_000.0 + 1e-5 / f64::from(k + 3));
                for (largest, r) in largest.iter_mut().zip([inverse_cbrt(x), 1.0 / libm::cbrt(x)]) {
                    // dr/r = (1 - x r^3)/3
                    *largest = largest.max(defect(x, r).abs() / 3.0);
                }
            }
        }
        let epsilons = largest.map(|error| error / f64::EPSILON);
        assert!(epsilons.iter().all(|error| (0.5..0.75).contains(error)), "{epsilons:?}");
    }

    #[test]
    fn whole_range() {
        for exponent in -1022..1023 {
            let x = 1.37 * 2.0_f64.powi(exponent);
            let (r, plain) = (inverse_cbrt(x), 1.0 / libm::cbrt(x));
            assert!(((r - plain) / plain).abs() < 4e-16, "{x:e}: {r:e}");
        }
        for x in [f64::MIN_POSITIVE, f64::MAX, f64::MIN_POSITIVE / 8.0, 5e-324, -8.0, 8.0, f64::INFINITY] {
            let (r, plain) = (inverse_cbrt(x), 1.0 / libm::cbrt(x));
            assert!((r - plain).abs() <= 4e-16 * plain.abs(), "{x:e}: {r:e}");
        }
        assert_eq!([0.0, -0.0].map(inverse_cbrt), [f64::INFINITY, f64::NEG_INFINITY]);
        assert!(inverse_cbrt(f64::NAN).is_nan());
    }
}
