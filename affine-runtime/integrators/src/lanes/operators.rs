//! Arithmetic of a number that wraps another one.

/// Zero, one, the operators of a wrapper and what is real of it, those of what it wraps.
macro_rules! operators {
    ([$($parameter:ident)?] $wrapper:ty, $inner:ty) => {
        impl$(<$parameter: affine_core::scalar::Real>)? num_traits::Zero for $wrapper {
            #[inline(always)]
            fn zero() -> Self {
                Self(<$inner>::zero())
            }
            fn is_zero(&self) -> bool {
                self.0.is_zero()
            }
        }

        impl$(<$parameter: affine_core::scalar::Real>)? num_traits::One for $wrapper {
            #[inline(always)]
            fn one() -> Self {
                Self(<$inner>::one())
            }
        }

        impl$(<$parameter: affine_core::scalar::Real>)? core::ops::Neg for $wrapper {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self(-self.0)
            }
        }

        impl$(<$parameter: affine_core::scalar::Real>)? affine_core::scalar::Real for $wrapper {
            const EPSILON: Self = Self(<$inner>::EPSILON);
            fn hypot(self, other: Self) -> Self {
                Self(affine_core::scalar::Real::hypot(self.0, other.0))
            }
            fn is_finite(self) -> bool {
                affine_core::scalar::Real::is_finite(self.0)
            }
            #[inline(always)]
            fn to_f64(self) -> f64 {
                self.0.to_f64()
            }
            #[inline(always)]
            fn from_f64(value: f64) -> Self {
                Self(<$inner>::from_f64(value))
            }
        }

        $crate::lanes::operators::operator!([$($parameter)?] $wrapper, Add add AddAssign add_assign);
        $crate::lanes::operators::operator!([$($parameter)?] $wrapper, Sub sub SubAssign sub_assign);
        $crate::lanes::operators::operator!([$($parameter)?] $wrapper, Mul mul MulAssign mul_assign);
        $crate::lanes::operators::operator!([$($parameter)?] $wrapper, Div div DivAssign div_assign);
    };
}

macro_rules! operator {
    ([$($parameter:ident)?] $wrapper:ty, $trait:ident $method:ident $assign:ident $assigned:ident) => {
        impl$(<$parameter: affine_core::scalar::Real>)? core::ops::$trait for $wrapper {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(core::ops::$trait::$method(self.0, other.0))
            }
        }

        impl$(<$parameter: affine_core::scalar::Real>)? core::ops::$assign for $wrapper {
            #[inline(always)]
            fn $assigned(&mut self, other: Self) {
                core::ops::$assign::$assigned(&mut self.0, other.0);
            }
        }
    };
}

pub(super) use {operator, operators};
