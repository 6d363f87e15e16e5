//! Several doubles side by side as one number: emitted right-hand sides, generic over [`Scalar`], compute several
//! bodies at once.
//!
//! Strict: every operation of a lane gives the bits that [`f64`] gives on the same target. Arithmetic and square roots
//! are rounded correctly in either; a multiply-add is fused in either or in neither; elementary functions are computed
//! lane by lane by those of `f64`.

use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use num_traits::{One, Zero};
use wide::{f64x4, f64x8};

use crate::scalar::Scalar;

/// A number of several lanes.
pub trait Lanes: Scalar {
    /// Number of lanes.
    const LANES: usize;

    /// The lanes, from a function of their index.
    fn from_lanes(lane: impl FnMut(usize) -> f64) -> Self;

    /// A lane; NaN beyond the last.
    fn lane(&self, index: usize) -> f64;
}

macro_rules! lanes {
    ($(#[$doc:meta])* $name:ident, $vector:ty, $count:literal, $($function:ident),*) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name($vector);

        impl $name {
            #[inline(always)]
            fn each(self, function: impl Fn(f64) -> f64) -> Self {
                Self(<$vector>::from(self.0.to_array().map(function)))
            }
        }

        impl Lanes for $name {
            const LANES: usize = $count;

            #[inline(always)]
            fn from_lanes(lane: impl FnMut(usize) -> f64) -> Self {
                Self(<$vector>::from(core::array::from_fn::<f64, $count, _>(lane)))
            }

            #[inline(always)]
            fn lane(&self, index: usize) -> f64 {
                self.0.to_array().get(index).copied().unwrap_or(f64::NAN)
            }

        }

        impl Scalar for $name {
            #[inline(always)]
            fn constant(hi: f64, _lo: f64) -> Self {
                Self(<$vector>::splat(hi))
            }

            #[inline(always)]
            fn fma(self, factor: Self, term: Self) -> Self {
                #[cfg(all(feature = "std", target_feature = "fma"))]
                return Self(self.0.mul_add(factor.0, term.0));
                #[cfg(not(all(feature = "std", target_feature = "fma")))]
                return self * factor + term;
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                Self(self.0.sqrt())
            }

            #[inline(always)]
            fn abs(self) -> Self {
                Self(self.0.abs())
            }

            #[inline(always)]
            fn copysign(self, sign: Self) -> Self {
                Self::from_lanes(|lane| Scalar::copysign(self.lane(lane), sign.lane(lane)))
            }

            $(
                #[inline(always)]
                fn $function(self) -> Self {
                    self.each(<f64 as Scalar>::$function)
                }
            )*
        }

        impl Zero for $name {
            #[inline(always)]
            fn zero() -> Self {
                Self(<$vector>::splat(0.0))
            }
            fn is_zero(&self) -> bool {
                *self == Self::zero()
            }
        }

        impl One for $name {
            #[inline(always)]
            fn one() -> Self {
                Self(<$vector>::splat(1.0))
            }
        }

        impl Neg for $name {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self(-self.0)
            }
        }

        lanes!(@operators $name, Add add AddAssign add_assign, Sub sub SubAssign sub_assign,
            Mul mul MulAssign mul_assign, Div div DivAssign div_assign);
    };
    (@operators $name:ident, $($trait:ident $method:ident $assign:ident $assigned:ident),*) => {
        $(
            impl $trait for $name {
                type Output = Self;
                #[inline(always)]
                fn $method(self, other: Self) -> Self {
                    Self($trait::$method(self.0, other.0))
                }
            }

            impl $assign for $name {
                #[inline(always)]
                fn $assigned(&mut self, other: Self) {
                    *self = $trait::$method(*self, other);
                }
            }
        )*
    };
}

lanes!(
    /// Four doubles: a vector register of AVX2.
    F64x4, f64x4, 4, cbrt, exp, exp_m1, ln, ln_1p, sin, cos, tan, sinh, cosh, tanh
);
lanes!(
    /// Eight doubles: a vector register of AVX-512, or several narrower ones.
    F64x8, f64x8, 8, cbrt, exp, exp_m1, ln, ln_1p, sin, cos, tan, sinh, cosh, tanh
);

/// The lanes of the widest vector registers of the target.
#[cfg(target_feature = "avx512f")]
pub type Widest = F64x8;
/// The lanes of the widest vector registers of the target.
#[cfg(not(target_feature = "avx512f"))]
pub type Widest = F64x4;

/// An entry of several records, one to a lane; the last record fills what is left of them.
#[inline]
pub fn gathered<T: Lanes, C>(records: &[C], entry: impl Fn(&C) -> f64) -> T {
    T::from_lanes(|lane| records.get(lane).or(records.last()).map_or(f64::NAN, &entry))
}
