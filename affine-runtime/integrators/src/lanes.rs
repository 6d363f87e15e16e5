//! Several doubles side by side as one number: the bodies of an ensemble, each in a lane.
//!
//! Strict, [`F64x8`]: every operation of a lane gives the bits that [`f64`] gives on the same target.
//! Arithmetic and square roots are rounded correctly in either; a multiply-add is fused in either or in neither;
//! elementary functions are computed lane by lane by those of `f64`.
//!
//! Fast, [`FastF64x8`]: the same but for roots of order 3 and exponential, logarithmic and hyperbolic functions, those
//! of [`Fast`], which become vector instructions, right to [`FAST_ULP`] units of the last place.
//!
//! Each has a twin whose multiply-adds are fused whatever the target promises: for bodies whose steps alone are in vectors, where
//! those of the processor are fused.
//!
//! Lanes are arrays, and operations loops over them, which the compiler turns into the vectors of the function that it
//! compiles: the same type serves a target's own vectors and those found at run time. No array is mapped, since
//! `map` of an array is a call in builds whose parts are not optimised together.

mod elementary;
#[cfg(feature = "std")]
pub(crate) mod equations;
mod fast;
mod fused;
mod operators;
#[cfg(feature = "std")]
pub(crate) mod parts;

use core::marker::PhantomData;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use num_traits::{One, Zero};

use affine_core::scalar::{Real, Scalar};

pub use affine_core::lanes::Lanes;
pub use fast::{FAST_ULP, Fast};
use fused::InLane;

/// `LANES` doubles that are computed with as numbers `S`. A line of the cache, or several whole ones, so that no vector stands in two of them.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub struct Several<S, const LANES: usize>([f64; LANES], PhantomData<S>);

/// Eight doubles, the lanes that an `Ensemble` takes: one vector of AVX-512, two of AVX2. Of sixteen lanes the stages of a
/// step hardly fit into the nearest cache, and with AVX2 a right-hand side of the size of P2 no longer into the registers.
pub type F64x8 = Several<f64, 8>;
/// Eight doubles with fast elementary functions.
pub type FastF64x8 = Several<Fast, 8>;

impl<S: Real, const LANES: usize> Several<S, LANES> {
    #[inline(always)]
    fn all(number: S) -> Self {
        Self([number.to_f64(); LANES], PhantomData)
    }

    #[inline(always)]
    fn each(mut self, function: impl Fn(S) -> S) -> Self {
        for lane in &mut self.0 {
            *lane = function(S::from_f64(*lane)).to_f64();
        }
        self
    }

    /// A loop over indices: what becomes vector operations.
    #[inline(always)]
    fn with(mut self, other: Self, operation: impl Fn(S, S) -> S) -> Self {
        for lane in 0..LANES {
            self.0[lane] = operation(S::from_f64(self.0[lane]), S::from_f64(other.0[lane])).to_f64();
        }
        self
    }
}

impl<S: InLane, const LANES: usize> Lanes for Several<S, LANES> {
    type Lane = S;
    type Fused = Several<S::Fused, LANES>;
    const IS_FUSED: bool = S::IS_FUSED;
    const LANES: usize = LANES;

    #[inline(always)]
    fn from_lanes(mut lane: impl FnMut(usize) -> f64) -> Self {
        let mut lanes = Self([0.0; LANES], PhantomData);
        for (index, own) in lanes.0.iter_mut().enumerate() {
            *own = S::from_f64(lane(index)).to_f64();
        }
        lanes
    }

    #[inline(always)]
    fn lane(&self, index: usize) -> f64 {
        self.0.get(index).copied().unwrap_or(f64::NAN)
    }

    #[inline(always)]
    fn set_lane(&mut self, index: usize, value: f64) {
        if let Some(lane) = self.0.get_mut(index) {
            *lane = S::from_f64(value).to_f64();
        }
    }

    #[inline(always)]
    fn as_slice(&self) -> &[f64] {
        &self.0
    }

    #[inline(always)]
    fn as_mut_slice(&mut self) -> &mut [f64] {
        &mut self.0
    }
}

macro_rules! elementary {
    ($($function:ident),*) => {
        $(
            #[inline(always)]
            fn $function(self) -> Self {
                self.each(S::$function)
            }
        )*
    };
}

impl<S: Real, const LANES: usize> Scalar for Several<S, LANES> {
    #[inline(always)]
    fn constant(hi: f64, lo: f64) -> Self {
        Self::all(S::constant(hi, lo))
    }

    #[inline(always)]
    fn fma(mut self, factor: Self, term: Self) -> Self {
        for lane in 0..LANES {
            let own = S::from_f64(self.0[lane]);
            self.0[lane] = own.fma(S::from_f64(factor.0[lane]), S::from_f64(term.0[lane])).to_f64();
        }
        self
    }

    #[inline(always)]
    fn times_any(self, other: Self) -> Self {
        self.with(other, S::times_any)
    }

    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        self.with(sign, S::copysign)
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.with(other, S::max)
    }

    elementary!(
        sqrt,
        abs,
        cbrt,
        inverse_cbrt,
        exp,
        exp_m1,
        ln,
        ln_1p,
        sin,
        cos,
        tan,
        sinh,
        cosh,
        tanh,
        asinh
    );
}

impl<S: Real, const LANES: usize> Zero for Several<S, LANES> {
    #[inline(always)]
    fn zero() -> Self {
        Self::all(S::zero())
    }
    fn is_zero(&self) -> bool {
        *self == Self::zero()
    }
}

impl<S: Real, const LANES: usize> One for Several<S, LANES> {
    #[inline(always)]
    fn one() -> Self {
        Self::all(S::one())
    }
}

impl<S: Real, const LANES: usize> Neg for Several<S, LANES> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.each(S::neg)
    }
}

macro_rules! operators {
    ($($trait:ident $method:ident $assign:ident $assigned:ident),*) => {
        $(
            impl<S: Real, const LANES: usize> $trait for Several<S, LANES> {
                type Output = Self;
                #[inline(always)]
                fn $method(self, other: Self) -> Self {
                    self.with(other, $trait::$method)
                }
            }

            impl<S: Real, const LANES: usize> $assign for Several<S, LANES> {
                #[inline(always)]
                fn $assigned(&mut self, other: Self) {
                    *self = self.with(other, $trait::$method);
                }
            }
        )*
    };
}
operators!(Add add AddAssign add_assign, Sub sub SubAssign sub_assign, Mul mul MulAssign mul_assign, Div div DivAssign div_assign);
