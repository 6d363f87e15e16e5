//! What a number must do.
//!
//! Emitted right-hand sides ask for [`Scalar`] alone: arithmetic, constants, a multiply-add and the elementary
//! functions, so that SIMD lanes, double-double and dual numbers fit without touching emitted code. Reduction,
//! expansion and energies ask for [`Real`]: an ordered number.

#[cfg(feature = "double-double")]
mod double_double;
pub(crate) mod inverse_cbrt;
mod primitive;

use core::borrow::Borrow;
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

    /// The numbers that some doubles are: these themselves, where they are such numbers already.
    fn of_doubles<const K: usize>(doubles: &[f64; K]) -> impl Borrow<[Self; K]> {
        doubles.map(|double| Self::constant(double, 0.0))
    }

    /// `self * factor + term`, with one rounding where the target has such an instruction and two elsewhere:
    /// never a library call.
    #[must_use]
    fn fma(self, factor: Self, term: Self) -> Self {
        self * factor + term
    }

    /// What tells directions apart: the numbers themselves, or, where both vanish beside `size` and have derivatives, these.
    #[inline(always)]
    fn told_apart(numbers: [Self; 2], _size: Self) -> [Self; 2] {
        numbers
    }

    /// `self * other`, and zero where this number is, whatever the other is, in each lane alone: what does not change changes
    /// nothing, be its derivative infinite.
    #[inline(always)]
    fn times_any(self, other: Self) -> Self {
        if self == Self::zero() { self } else { self * other }
    }

    /// `self + a * b`, as [`fma`](Self::fma) has it.
    #[inline(always)]
    #[must_use]
    fn plus(self, a: Self, b: Self) -> Self {
        a.fma(b, self)
    }

    /// `self - a * b`, as [`fma`](Self::fma) has it.
    #[inline(always)]
    #[must_use]
    fn minus(self, a: Self, b: Self) -> Self {
        (-a).fma(b, self)
    }

    /// Square root.
    #[must_use]
    fn sqrt(self) -> Self;
    /// Cube root.
    #[must_use]
    fn cbrt(self) -> Self;
    /// Reciprocal of the cube root.
    #[must_use]
    fn inverse_cbrt(self) -> Self {
        Self::one() / self.cbrt()
    }
    /// Exponential function.
    #[must_use]
    fn exp(self) -> Self;
    /// `exp(self) - 1` without cancellation.
    #[must_use]
    fn exp_m1(self) -> Self;
    /// Natural logarithm.
    #[must_use]
    fn ln(self) -> Self;
    /// `ln(1 + self)` without cancellation.
    #[must_use]
    fn ln_1p(self) -> Self;
    /// Sine.
    #[must_use]
    fn sin(self) -> Self;
    /// Cosine.
    #[must_use]
    fn cos(self) -> Self;
    /// Sine and cosine, each as it is alone.
    #[must_use]
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        (self.sin(), self.cos())
    }
    /// Tangent.
    #[must_use]
    fn tan(self) -> Self;
    /// Hyperbolic sine.
    #[must_use]
    fn sinh(self) -> Self;
    /// Hyperbolic cosine.
    #[must_use]
    fn cosh(self) -> Self;
    /// Hyperbolic tangent.
    #[must_use]
    fn tanh(self) -> Self;
    /// Inverse hyperbolic sine, `ln(x + sqrt(1 + x^2))` without cancellation.
    #[must_use]
    fn asinh(self) -> Self {
        let (size, one) = (self.abs(), Self::one());
        let square = size * size;
        (size + square / (one + (one + square).sqrt())).ln_1p().copysign(self)
    }
    /// Absolute value.
    #[must_use]
    fn abs(self) -> Self;
    /// The size of this number with the sign of another, either sign where that is zero: what a choice of a branch
    /// by sign becomes in straight-line code.
    #[must_use]
    fn copysign(self, sign: Self) -> Self;
    /// 1 with the sign of this number: the slope of its absolute value, either one-sided slope where it is zero.
    #[must_use]
    fn signum(self) -> Self {
        Self::one().copysign(self)
    }
    /// The larger of two finite numbers, NaN where one is: what a force of contact is made of. Its slope is that of the larger
    /// one, and that of either where they are equal.
    #[must_use]
    fn max(self, other: Self) -> Self {
        let part = (Self::one() + (self - other).signum()) * Self::constant(0.5, 0.0);
        self * part + other * (Self::one() - part)
    }
    /// The smaller of two numbers, as [`max`](Self::max) has the larger.
    #[must_use]
    fn min(self, other: Self) -> Self {
        -(-self).max(-other)
    }
}

/// An ordered number, for everything outside right-hand sides.
pub trait Real: Scalar + PartialOrd {
    /// The distance from 1 to the next number.
    const EPSILON: Self;

    /// `sqrt(self^2 + other^2)` without overflow in between.
    #[must_use]
    fn hypot(self, other: Self) -> Self;
    /// Neither infinite nor NaN.
    fn is_finite(self) -> bool;
    /// The nearest double.
    fn to_f64(self) -> f64;

    /// The number nearest to a double.
    #[must_use]
    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        Self::constant(value, 0.0)
    }
}
