//! What a number must do.
//!
//! Emitted right-hand sides ask for [`Scalar`] alone: ring operations, constants and a multiply-add, so that
//! SIMD lanes, double-double and dual numbers fit without touching emitted code. Reduction, expansion and
//! energies ask for [`Real`]: an ordered field with the elementary functions.

use core::fmt::Debug;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use num_traits::{One, Zero};

/// A number that straight-line code can compute with.
pub trait Scalar:
    Copy
    + Debug
    + PartialEq
    + Send
    + Sync
    + 'static
    + Zero
    + One
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + DivAssign
{
    /// The constant `hi + lo`: the double nearest to an exact rational, and the double nearest to the rest.
    /// A type with the precision of `f64` or less ignores `lo`.
    fn constant(hi: f64, lo: f64) -> Self;

    /// `self * factor + term`, with one rounding where the target has such an instruction and two elsewhere:
    /// never a library call.
    #[must_use]
    fn fma(self, factor: Self, term: Self) -> Self {
        self * factor + term
    }
}

/// An ordered number with the elementary functions, for everything outside right-hand sides.
pub trait Real: Scalar + PartialOrd {
    /// The distance from 1 to the next number.
    const EPSILON: Self;

    /// Square root.
    #[must_use]
    fn sqrt(self) -> Self;
    /// Exponential function.
    #[must_use]
    fn exp(self) -> Self;
    /// Natural logarithm.
    #[must_use]
    fn ln(self) -> Self;
    /// Sine.
    #[must_use]
    fn sin(self) -> Self;
    /// Cosine.
    #[must_use]
    fn cos(self) -> Self;
    /// Absolute value.
    #[must_use]
    fn abs(self) -> Self;
    /// `sqrt(self^2 + other^2)` without overflow in between.
    #[must_use]
    fn hypot(self, other: Self) -> Self;
    /// Neither infinite nor NaN.
    fn is_finite(self) -> bool;
    /// The nearest double.
    fn to_f64(self) -> f64;

    /// The number nearest to a double.
    #[must_use]
    fn from_f64(value: f64) -> Self {
        Self::constant(value, 0.0)
    }
}

macro_rules! primitive {
    ($type:ty, $sqrt:path, $exp:path, $ln:path, $sin:path, $cos:path, $hypot:path) => {
        impl Scalar for $type {
            #[inline(always)]
            #[allow(clippy::cast_possible_truncation)]
            fn constant(hi: f64, _lo: f64) -> Self {
                hi as $type
            }

            #[inline(always)]
            fn fma(self, factor: Self, term: Self) -> Self {
                #[cfg(all(feature = "std", target_feature = "fma"))]
                return self.mul_add(factor, term);
                #[cfg(not(all(feature = "std", target_feature = "fma")))]
                return self * factor + term;
            }
        }

        impl Real for $type {
            const EPSILON: Self = <$type>::EPSILON;

            fn sqrt(self) -> Self {
                $sqrt(self)
            }
            fn exp(self) -> Self {
                $exp(self)
            }
            fn ln(self) -> Self {
                $ln(self)
            }
            fn sin(self) -> Self {
                $sin(self)
            }
            fn cos(self) -> Self {
                $cos(self)
            }
            fn abs(self) -> Self {
                <$type>::abs(self)
            }
            fn hypot(self, other: Self) -> Self {
                $hypot(self, other)
            }
            fn is_finite(self) -> bool {
                <$type>::is_finite(self)
            }
            fn to_f64(self) -> f64 {
                f64::from(self)
            }
        }
    };
}

primitive!(f64, libm::sqrt, libm::exp, libm::log, libm::sin, libm::cos, libm::hypot);
primitive!(f32, libm::sqrtf, libm::expf, libm::logf, libm::sinf, libm::cosf, libm::hypotf);
