//! Numbers with a derivative.

use core::cmp::Ordering;
use core::ops::{Add, Div, Mul, Neg, Sub};

use num_traits::{One, Zero};

#[cfg(feature = "analysis")]
use crate::model::StateVector;
use crate::scalar::{Real, Scalar};

/// Squares of stretches that differ by this part of their sum coincide, for derivatives: these err by about as much then, and
/// by the rounding of numbers over the difference otherwise. It is the root of that rounding, by which `3 (4/3 - 1)` is not 1.
fn coincident<T: Scalar>() -> T {
    let [three, four] = [3.0, 4.0].map(|number| T::constant(number, 0.0));
    (three * (four / three - T::one()) - T::one()).abs().sqrt()
}

/// `value + epsilon slope` with `epsilon^2 = 0`: what is computed with it is differentiated.
///
/// Equal are numbers with the same slope as well; the order is that of the values. A function that has no derivative at
/// the value gives a slope that is not finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<T> {
    /// The number.
    pub value: T,
    /// Its derivative.
    pub slope: T,
}

impl<T: Scalar> Dual<T> {
    /// A number that does not change.
    pub fn fixed(value: T) -> Self {
        Self { value, slope: T::zero() }
    }

    /// `f(value) + epsilon f'(value) slope`.
    fn chain(self, value: T, derivative: T) -> Self {
        Self { value, slope: derivative * self.slope }
    }

    /// The same of a root, whose derivative at zero is infinite: what does not change has a root that does not.
    fn chain_of_root(self, root: T, derivative: T) -> Self {
        Self { value: root, slope: self.slope.times_any(derivative) }
    }
}

/// A state that does not change.
#[cfg(feature = "analysis")]
pub(crate) fn fixed<T: Scalar, S: StateVector<Dual<T>>>(values: &[T]) -> S {
    let mut state = S::zeros();
    state.as_mut().iter_mut().zip(values).for_each(|(both, value)| *both = Dual::fixed(*value));
    state
}

impl<T: Scalar> Add for Dual<T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, slope: self.slope + other.slope }
    }
}

impl<T: Scalar> Sub for Dual<T> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { value: self.value - other.value, slope: self.slope - other.slope }
    }
}

impl<T: Scalar> Mul for Dual<T> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self { value: self.value * other.value, slope: self.slope * other.value + self.value * other.slope }
    }
}

impl<T: Scalar> Div for Dual<T> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        Self { value, slope: (self.slope - value * other.slope) / other.value }
    }
}

impl<T: Scalar> Neg for Dual<T> {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, slope: -self.slope }
    }
}

/// `+=` and its like of a type of numbers, by its `+` and its like.
macro_rules! assigning {
    (@each [$($parameter:ident)?] $number:ty, $trait:ident $method:ident $operator:tt) => {
        impl$(<$parameter: $crate::scalar::Scalar>)? core::ops::$trait for $number {
            fn $method(&mut self, other: Self) {
                *self = *self $operator other;
            }
        }
    };
    ([$($parameter:ident)?] $number:ty) => {
        $crate::dual::assigning!(@each [$($parameter)?] $number, AddAssign add_assign +);
        $crate::dual::assigning!(@each [$($parameter)?] $number, SubAssign sub_assign -);
        $crate::dual::assigning!(@each [$($parameter)?] $number, MulAssign mul_assign *);
        $crate::dual::assigning!(@each [$($parameter)?] $number, DivAssign div_assign /);
    };
}
pub(crate) use assigning;

assigning!([T] Dual<T>);

impl<T: Scalar> Zero for Dual<T> {
    fn zero() -> Self {
        Self::fixed(T::zero())
    }
    fn is_zero(&self) -> bool {
        *self == Self::zero()
    }
}

impl<T: Scalar> One for Dual<T> {
    fn one() -> Self {
        Self::fixed(T::one())
    }
}

impl<T: Scalar + PartialOrd> PartialOrd for Dual<T> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

impl<T: Scalar> Scalar for Dual<T> {
    fn constant(hi: f64, lo: f64) -> Self {
        Self::fixed(T::constant(hi, lo))
    }
    fn told_apart([a, b]: [Self; 2], size: Self) -> [Self; 2] {
        let excess = size.value * coincident() - a.value.abs().max(b.value.abs());
        // 1 where both vanish and 0 elsewhere, which lanes may do at once.
        let vanish = (T::one() + excess.signum()) * T::constant(0.5, 0.0);
        let apart = T::one() - vanish;
        [a, b].map(|own| Self {
            value: vanish.times_any(own.slope) + apart.times_any(own.value),
            slope: apart.times_any(own.slope),
        })
    }
    fn times_any(self, other: Self) -> Self {
        let slope = self.slope.times_any(other.value) + self.value.times_any(other.slope);
        Self { value: self.value.times_any(other.value), slope }
    }
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain_of_root(root, T::one() / (root + root))
    }
    fn cbrt(self) -> Self {
        let root = self.value.cbrt();
        self.chain_of_root(root, T::one() / (T::constant(3.0, 0.0) * root * root))
    }
    fn exp(self) -> Self {
        let value = self.value.exp();
        self.chain(value, value)
    }
    fn exp_m1(self) -> Self {
        self.chain(self.value.exp_m1(), self.value.exp())
    }
    fn ln(self) -> Self {
        self.chain(self.value.ln(), T::one() / self.value)
    }
    fn ln_1p(self) -> Self {
        self.chain(self.value.ln_1p(), T::one() / (T::one() + self.value))
    }
    fn sin(self) -> Self {
        self.chain(self.value.sin(), self.value.cos())
    }
    fn cos(self) -> Self {
        self.chain(self.value.cos(), -self.value.sin())
    }
    fn tan(self) -> Self {
        let tan = self.value.tan();
        self.chain(tan, T::one() + tan * tan)
    }
    fn sinh(self) -> Self {
        self.chain(self.value.sinh(), self.value.cosh())
    }
    fn cosh(self) -> Self {
        self.chain(self.value.cosh(), self.value.sinh())
    }
    fn tanh(self) -> Self {
        let tanh = self.value.tanh();
        self.chain(tanh, T::one() - tanh * tanh)
    }
    fn asinh(self) -> Self {
        let value = self.value.asinh();
        self.chain(value, T::one() / value.cosh())
    }
    fn abs(self) -> Self {
        self.chain(self.value.abs(), T::one().copysign(self.value))
    }
    fn copysign(self, sign: Self) -> Self {
        let value = self.value.copysign(sign.value);
        self.chain(value, T::one().copysign(self.value) * T::one().copysign(value))
    }
    fn max(self, other: Self) -> Self {
        let part = (T::one() + (self.value - other.value).signum()) * T::constant(0.5, 0.0);
        let slope = self.slope * part + other.slope * (T::one() - part);
        Self { value: self.value.max(other.value), slope }
    }
}

impl<T: Real> Real for Dual<T> {
    /// A number is resolved to this, whatever its slope.
    const EPSILON: Self = Self { value: T::EPSILON, slope: T::EPSILON };

    fn hypot(self, other: Self) -> Self {
        let value = self.value.hypot(other.value);
        let slope = if self.slope == T::zero() && other.slope == T::zero() {
            T::zero()
        } else {
            (self.value * self.slope + other.value * other.slope) / value
        };
        Self { value, slope }
    }
    fn is_finite(self) -> bool {
        self.value.is_finite() && self.slope.is_finite()
    }
    fn to_f64(self) -> f64 {
        self.value.to_f64()
    }
}
