//! Several doubles side by side as one number: emitted right-hand sides, generic over [`Scalar`], compute several
//! bodies at once.
//!
//! Strict, [`F64x4`] and [`F64x8`]: every operation of a lane gives the bits that [`f64`] gives on the same target.
//! Arithmetic and square roots are rounded correctly in either; a multiply-add is fused in either or in neither;
//! elementary functions are computed lane by lane by those of `f64`.
//!
//! Fast, [`FastF64x4`] and [`FastF64x8`]: the same but for `cbrt`, `exp`, `exp_m1`, `ln`, `ln_1p`, `sinh`, `cosh` and
//! `tanh`, which all lanes compute at once, to within [`FAST_ULP`] units of the last place.
//!
//! Lanes are arrays, and operations loops over them, which the compiler turns into the vectors of the function that it
//! compiles: the same type serves a target's own vectors and those found at run time.

mod elementary;

use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use num_traits::{One, Zero};

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
    ($(#[$doc:meta])* $name:ident, $count:literal, $($function:ident = $value:expr),*) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name([f64; $count]);

        impl $name {
            #[inline(always)]
            fn each(self, function: impl Fn(f64) -> f64) -> Self {
                Self(self.0.map(function))
            }

            /// A loop over indices: what becomes one vector operation.
            #[inline(always)]
            fn with(self, other: Self, operation: impl Fn(f64, f64) -> f64) -> Self {
                let mut lanes = [0.0; $count];
                for lane in 0..$count {
                    lanes[lane] = operation(self.0[lane], other.0[lane]);
                }
                Self(lanes)
            }
        }

        impl Lanes for $name {
            const LANES: usize = $count;

            #[inline(always)]
            fn from_lanes(lane: impl FnMut(usize) -> f64) -> Self {
                Self(core::array::from_fn(lane))
            }

            #[inline(always)]
            fn lane(&self, index: usize) -> f64 {
                self.0.get(index).copied().unwrap_or(f64::NAN)
            }
        }

        impl Scalar for $name {
            #[inline(always)]
            fn constant(hi: f64, _lo: f64) -> Self {
                Self([hi; $count])
            }

            #[inline(always)]
            fn fma(self, factor: Self, term: Self) -> Self {
                let mut lanes = [0.0; $count];
                for lane in 0..$count {
                    lanes[lane] = self.0[lane].fma(factor.0[lane], term.0[lane]);
                }
                Self(lanes)
            }

            #[inline(always)]
            fn copysign(self, sign: Self) -> Self {
                self.with(sign, Scalar::copysign)
            }

            $(
                #[inline(always)]
                fn $function(self) -> Self {
                    self.each($value)
                }
            )*
        }

        impl Zero for $name {
            #[inline(always)]
            fn zero() -> Self {
                Self([0.0; $count])
            }
            fn is_zero(&self) -> bool {
                *self == Self::zero()
            }
        }

        impl One for $name {
            #[inline(always)]
            fn one() -> Self {
                Self([1.0; $count])
            }
        }

        impl Neg for $name {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                self.each(|lane| -lane)
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
                    self.with(other, $trait::$method)
                }
            }

            impl $assign for $name {
                #[inline(always)]
                fn $assigned(&mut self, other: Self) {
                    *self = self.with(other, $trait::$method);
                }
            }
        )*
    };
}

macro_rules! strict {
    ($(#[$doc:meta])* $name:ident, $count:literal, $($function:ident),*) => {
        lanes!($(#[$doc])* $name, $count, $($function = <f64 as Scalar>::$function),*);
    };
}

macro_rules! fast {
    ($(#[$doc:meta])* $name:ident, $count:literal, $($function:ident),*; $($at_once:ident),*) => {
        lanes!(
            $(#[$doc])* $name,
            $count,
            $($function = <f64 as Scalar>::$function,)*
            $($at_once = elementary::$at_once),*
        );
    };
}

strict!(
    /// Four doubles: a vector register of AVX2.
    F64x4, 4, sqrt, abs, cbrt, exp, exp_m1, ln, ln_1p, sin, cos, tan, sinh, cosh, tanh
);
strict!(
    /// Eight doubles: two vector registers of AVX2.
    F64x8, 8, sqrt, abs, cbrt, exp, exp_m1, ln, ln_1p, sin, cos, tan, sinh, cosh, tanh
);
fast!(
    /// Four doubles with fast elementary functions.
    FastF64x4, 4, sqrt, abs, sin, cos, tan; cbrt, exp, exp_m1, ln, ln_1p, sinh, cosh, tanh
);
fast!(
    /// Eight doubles with fast elementary functions.
    FastF64x8, 8, sqrt, abs, sin, cos, tan; cbrt, exp, exp_m1, ln, ln_1p, sinh, cosh, tanh
);

/// Largest error of a fast elementary function in units of the last place of its value, where that is a normal number.
pub const FAST_ULP: f64 = 2.5;

/// The lanes that an [`Ensemble`](crate::Ensemble) takes: one register of AVX2. Compilers split arrays of eight.
pub type Widest = F64x4;

/// An entry of several records, one to a lane; the last record fills what is left of them.
#[inline]
pub fn gathered<T: Lanes, C>(records: &[C], entry: impl Fn(&C) -> f64) -> T {
    T::from_lanes(|lane| records.get(lane).or(records.last()).map_or(f64::NAN, &entry))
}
