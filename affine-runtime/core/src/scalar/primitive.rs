//! Doubles and singles as scalars.

use core::borrow::Borrow;

use super::inverse_cbrt;
use super::{Real, Scalar};

/// Rounded correctly by either: one instruction, also of vectors, where the standard library is.
#[inline(always)]
fn square_root(x: f64) -> f64 {
    #[cfg(feature = "std")]
    return x.sqrt();
    #[cfg(not(feature = "std"))]
    return libm::sqrt(x);
}

macro_rules! primitive {
    ($type:ty, $hypot:path, $sin_cos:path, $($function:ident = $path:path),* $(; $of_doubles:item)?) => {
        impl Scalar for $type {
            $($of_doubles)?

            #[inline(always)]
            #[allow(clippy::cast_possible_truncation)]
            fn constant(hi: f64, _lo: f64) -> Self {
                hi as $type
            }

            #[inline(always)]
            fn fma(self, factor: Self, term: Self) -> Self {
                #[cfg(all(feature = "std", any(target_feature = "fma", target_arch = "aarch64")))]
                return self.mul_add(factor, term);
                #[cfg(not(all(feature = "std", any(target_feature = "fma", target_arch = "aarch64"))))]
                return self * factor + term;
            }

            #[inline(always)]
            fn sin_cos(self) -> (Self, Self) {
                $sin_cos(self)
            }

            #[inline(always)]
            fn copysign(self, sign: Self) -> Self {
                <$type>::copysign(self, sign)
            }

            #[inline(always)]
            fn max(self, other: Self) -> Self {
                if (self > other) | self.is_nan() { self } else { other }
            }

            $(
                #[inline(always)]
                fn $function(self) -> Self {
                    $path(self)
                }
            )*
        }

        impl Real for $type {
            const EPSILON: Self = <$type>::EPSILON;

            #[inline]
            fn hypot(self, other: Self) -> Self {
                let squares = self * self + other * other;
                // Neither overflow nor a square that has lost digits to underflow and counts.
                if (squares < <$type>::MAX / 2.0) & (squares > <$type>::MIN_POSITIVE / <$type>::EPSILON) {
                    return Scalar::sqrt(squares);
                }
                $hypot(self, other)
            }
            fn is_finite(self) -> bool {
                <$type>::is_finite(self)
            }
            #[inline(always)]
            fn to_f64(self) -> f64 {
                f64::from(self)
            }
        }
    };
}

primitive!(
    f64,
    libm::hypot,
    libm::sincos,
    sqrt = square_root,
    cbrt = libm::cbrt,
    inverse_cbrt = inverse_cbrt::inverse_cbrt,
    exp = libm::exp,
    exp_m1 = libm::expm1,
    ln = libm::log,
    ln_1p = libm::log1p,
    sin = libm::sin,
    cos = libm::cos,
    tan = libm::tan,
    sinh = libm::sinh,
    cosh = libm::cosh,
    tanh = libm::tanh,
    asinh = libm::asinh,
    abs = f64::abs;
    #[inline(always)]
    fn of_doubles<const K: usize>(doubles: &[f64; K]) -> impl Borrow<[f64; K]> {
        doubles
    }
);
primitive!(
    f32,
    libm::hypotf,
    libm::sincosf,
    sqrt = libm::sqrtf,
    cbrt = libm::cbrtf,
    exp = libm::expf,
    exp_m1 = libm::expm1f,
    ln = libm::logf,
    ln_1p = libm::log1pf,
    sin = libm::sinf,
    cos = libm::cosf,
    tan = libm::tanf,
    sinh = libm::sinhf,
    cosh = libm::coshf,
    tanh = libm::tanhf,
    asinh = libm::asinhf,
    abs = f32::abs
);

#[cfg(test)]
mod tests {
    use super::{Real, Scalar};

    #[test]
    fn sines_and_cosines_are_what_they_are_alone() {
        for k in -20_000..20_000 {
            let x = f64::from(k) * 10.0_f64.powi(k % 40 - 30);
            assert_eq!(Scalar::sin_cos(x), (libm::sin(x), libm::cos(x)), "{x}");
            let x = x as f32;
            assert_eq!(Scalar::sin_cos(x), (libm::sinf(x), libm::cosf(x)), "{x}");
        }
    }

    #[test]
    fn hypotenuses_of_any_size() {
        for (a, b, c) in [(3.0, 4.0, 5.0), (5.0, -12.0, 13.0), (0.0, -7.3, 7.3), (0.0, 0.0, 0.0)] {
            for unit in [1.0, 2.0_f64.powi(1000), 2.0_f64.powi(-1000), 2.0_f64.powi(-1060)] {
                let size = c * unit;
                assert_eq!(Real::hypot(a * unit, b * unit), size.abs(), "{a} {b} {unit}");
            }
        }
        for k in 0..1000 {
            let (a, b) = (f64::from(k).sin(), 10.0_f64.powi(k % 300 - 150) * f64::from(k).cos());
            let (found, exact) = (Real::hypot(a, b), libm::hypot(a, b));
            assert!((found - exact).abs() <= f64::EPSILON * exact, "{a} {b}");
        }
        assert!(Real::hypot(f64::NAN, 1.0).is_nan());
        assert_eq!(Real::hypot(f64::INFINITY, 1.0), f64::INFINITY);
        let unit = 2.0_f32.powi(100);
        assert_eq!(Real::hypot(3.0 * unit, 4.0 * unit), 5.0 * unit);
    }
}
