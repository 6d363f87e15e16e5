//! A double with fast elementary functions.

use super::elementary;
use affine_core::scalar::Scalar;

/// Largest error of a fast elementary function in units of the last place of its value, where that is a normal number.
pub const FAST_ULP: f64 = 2.5;

/// A double whose `cbrt`, `inverse_cbrt`, `exp`, `exp_m1`, `ln`, `ln_1p`, `sinh`, `cosh`, `tanh` and `asinh` have no branches, so that
/// a loop over many becomes vector instructions, and are right to [`FAST_ULP`] units of the last place. All else is as
/// [`f64`] has it.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Fast(pub f64);

macro_rules! functions {
    ($($function:ident = $value:expr),*) => {
        $(
            #[inline(always)]
            fn $function(self) -> Self {
                Self($value(self.0))
            }
        )*
    };
}

impl Scalar for Fast {
    #[inline(always)]
    fn constant(hi: f64, _lo: f64) -> Self {
        Self(hi)
    }
    #[inline(always)]
    fn fma(self, factor: Self, term: Self) -> Self {
        Self(Scalar::fma(self.0, factor.0, term.0))
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        Self(self.0.copysign(sign.0))
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(Scalar::max(self.0, other.0))
    }
    functions!(
        sqrt = Scalar::sqrt,
        abs = Scalar::abs,
        sin = Scalar::sin,
        cos = Scalar::cos,
        tan = Scalar::tan,
        cbrt = elementary::cbrt,
        inverse_cbrt = elementary::inverse_cbrt,
        exp = elementary::exp,
        exp_m1 = elementary::exp_m1,
        ln = elementary::ln,
        ln_1p = elementary::ln_1p,
        sinh = elementary::sinh,
        cosh = elementary::cosh,
        tanh = elementary::tanh,
        asinh = elementary::asinh
    );
}

super::operators::operators!([] Fast, f64);
