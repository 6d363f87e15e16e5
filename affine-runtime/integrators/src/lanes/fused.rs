//! A number whose multiply-add is rounded once.

use affine_core::scalar::{Real, Scalar};

use super::Fast;

/// A number that lanes hold.
pub trait InLane: Real {
    /// The same with a multiply-add that is rounded once.
    type Fused: InLane;
    /// That is this one.
    const IS_FUSED: bool = false;
}

impl InLane for f64 {
    type Fused = Fused<f64>;
}

impl InLane for Fast {
    type Fused = Fused<Fast>;
}

impl<S: InLane> InLane for Fused<S> {
    type Fused = Self;
    const IS_FUSED: bool = true;
}

/// A number of the precision of doubles with a multiply-add that is rounded once: one instruction in functions that are
/// compiled for processors which have it, and a call elsewhere. All else is as `S` has it.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Fused<S>(pub S);

macro_rules! functions {
    ($($function:ident),*) => {
        $(
            #[inline(always)]
            fn $function(self) -> Self {
                Self(self.0.$function())
            }
        )*
    };
}

impl<S: Real> Scalar for Fused<S> {
    #[inline(always)]
    fn constant(hi: f64, lo: f64) -> Self {
        Self(S::constant(hi, lo))
    }
    #[inline(always)]
    fn fma(self, factor: Self, term: Self) -> Self {
        let (own, factor, term) = (self.to_f64(), factor.to_f64(), term.to_f64());
        #[cfg(feature = "std")]
        return Self::from_f64(own.mul_add(factor, term));
        #[cfg(not(feature = "std"))]
        return Self::from_f64(libm::fma(own, factor, term));
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        Self(self.0.copysign(sign.0))
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(Scalar::max(self.0, other.0))
    }
    functions!(sqrt, cbrt, inverse_cbrt, exp, exp_m1, ln, ln_1p, sin, cos, tan, sinh, cosh, tanh, asinh, abs);
}

super::operators::operators!([S] Fused<S>, S);
