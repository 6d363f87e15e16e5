//! `R_F` and `R_D` against quadrature, another implementation, closed forms and 31 digits.

use affine_runtime::elliptic::{carlson_rd, carlson_rf};
use affine_runtime::scalar::{Real, Scalar};
use ellip::{elliprd, elliprf};

/// Arguments with zeros, in proportions up to 1e16, large and small.
const ARGUMENTS: [[f64; 3]; 8] = [
    [1.0, 1.0, 1.0],
    [1.0, 4.0, 9.0],
    [0.0, 2.0, 1.0],
    [2.0, 2.0, 0.5],
    [1e-8, 1.0, 1e8],
    [1e-3, 1e-3, 1.0],
    [3e100, 1e100, 2e101],
    [0.83, 1.19, 0.97],
];

/// `int_0^inf f(t) dt` by the trapezoidal rule in `t = exp(pi/2 sinh u)` (Takahasi and Mori, Publ. RIMS 9 (1974) 721).
fn integral(f: impl Fn(f64) -> f64) -> f64 {
    let h = 1.0 / 64.0;
    let half_pi = std::f64::consts::FRAC_PI_2;
    let at = |k: i32| {
        let u = h * f64::from(k);
        let t = (half_pi * u.sinh()).exp();
        f(t) * t * half_pi * u.cosh()
    };
    (-300..=300).map(at).filter(|value| value.is_finite()).sum::<f64>() * h
}

#[test]
fn they_are_the_integrals() {
    for [x, y, z] in ARGUMENTS.into_iter().filter(|arguments| arguments[2] < 1e50) {
        let root = |t: f64| ((t + x).sqrt() * (t + y).sqrt() * (t + z).sqrt()).recip();
        let first = 0.5 * integral(root);
        let second = 1.5 * integral(|t| root(t) / (t + z));
        for (found, known) in [(carlson_rf(x, y, z), first), (carlson_rd(x, y, z), second)] {
            assert!((found / known - 1.0).abs() < 1e-13, "({x}, {y}, {z}): {found} {known}");
        }
    }
}

/// With two zeros the integrals diverge, and with negative arguments there are none.
#[test]
fn elsewhere_they_are_no_numbers() {
    for [x, y, z] in
        [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.0], [-1.0, 1.0, 2.0], [f64::NAN, 1.0, 2.0]]
    {
        assert!(carlson_rf(x, y, z).is_nan(), "{x} {y} {z}");
    }
    assert!(carlson_rd(0.0_f64, 0.0, 1.0).is_nan());
    // The smallest and the largest numbers that have all digits.
    let [tiny, huge] = [f64::MIN_POSITIVE, 1e308];
    for [x, y, z] in [[0.0, tiny, huge], [tiny, tiny, huge], [0.0, tiny, tiny]] {
        assert!(carlson_rf(x, y, z).is_finite(), "{x} {y} {z}");
    }
}

#[test]
fn another_implementation_agrees() {
    for [x, y, z] in ARGUMENTS {
        let known = [elliprf(x, y, z).unwrap(), elliprd(x, y, z).unwrap()];
        for (found, known) in [carlson_rf(x, y, z), carlson_rd(x, y, z)].into_iter().zip(known) {
            assert!((found / known - 1.0).abs() < 2e-15, "({x}, {y}, {z}): {found} {known}");
        }
        assert!((carlson_rf(z, x, y) / known[0] - 1.0).abs() < 2e-15);
    }
}

/// Of spheroids: `R_F(a^2, a^2, c^2)` is `acos(c/a)/sqrt(a^2 - c^2)` where `c < a`, and `acosh(c/a)/sqrt(c^2 - a^2)` beyond.
#[test]
fn spheroids_are_elementary() {
    for c in [0.05_f64, 0.3, 0.9, 1.2, 7.0] {
        let distance = (1.0 - c * c).abs().sqrt();
        let closed = if c < 1.0 { c.acos() } else { c.acosh() } / distance;
        let found = carlson_rf(1.0, 1.0, c * c);
        assert!((found / closed - 1.0).abs() < 1e-14, "{c}: {found} {closed}");
    }
}

/// By mpmath at 40 digits, as sums of two doubles.
#[test]
fn double_doubles_have_all_digits() {
    type Quad = qd::Quad;
    let [one, four, nine] = [1.0, 4.0, 9.0].map(|value| Quad::constant(value, 0.0));
    for (found, known) in [
        (carlson_rf(one, four, nine), Quad::constant(0.5086446185700303, -5.5333711504421756e-17)),
        (carlson_rd(one, four, nine), Quad::constant(0.07815034941463549, 5.591107141702455e-18)),
    ] {
        let error = Scalar::abs(found / known - one);
        assert!(error.to_f64() < 1e-30, "{found:?} {known:?}");
    }
}

#[test]
fn what_is_no_argument_gives_no_number() {
    assert!(carlson_rf(-1.0_f64, 1.0, 1.0).is_nan());
    assert!(carlson_rd(-1.0_f64, 1.0, 1.0).is_nan());
    assert!(carlson_rf(f64::NAN, 1.0, 1.0).is_nan());
}
