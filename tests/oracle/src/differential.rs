//! Numbers in `f64` with a derivative, for potentials: elementary functions have no exact values.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// `value + epsilon slope` in `f64`, `epsilon^2 = 0`: a number together with its derivative in one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Differential {
    /// The number.
    pub value: f64,
    /// Its derivative.
    pub slope: f64,
}

impl Differential {
    /// A number that does not change.
    pub fn constant(value: f64) -> Self {
        Differential { value, slope: 0.0 }
    }

    /// `f(value) + epsilon f'(value) slope`.
    fn chain(self, value: f64, derivative: f64) -> Self {
        Differential { value, slope: derivative * self.slope }
    }

    /// `a^k`, `k >= 1`, by repeated multiplication.
    pub fn power(self, k: u32) -> Self {
        (1..k).fold(self, |power, _| power * self)
    }

    /// Square root.
    pub fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, 0.5 / root)
    }

    /// Exponential function.
    pub fn exp(self) -> Self {
        let value = self.value.exp();
        self.chain(value, value)
    }

    /// Natural logarithm.
    pub fn ln(self) -> Self {
        self.chain(self.value.ln(), self.value.recip())
    }

    /// Cosine.
    pub fn cos(self) -> Self {
        self.chain(self.value.cos(), -self.value.sin())
    }

    /// Hyperbolic sine.
    pub fn sinh(self) -> Self {
        self.chain(self.value.sinh(), self.value.cosh())
    }

    /// Hyperbolic cosine.
    pub fn cosh(self) -> Self {
        self.chain(self.value.cosh(), self.value.sinh())
    }

    /// Hyperbolic tangent.
    pub fn tanh(self) -> Self {
        let tanh = self.value.tanh();
        self.chain(tanh, 1.0 - tanh * tanh)
    }
}

impl Add for Differential {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Differential { value: self.value + other.value, slope: self.slope + other.slope }
    }
}

impl Sub for Differential {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Differential { value: self.value - other.value, slope: self.slope - other.slope }
    }
}

impl Mul for Differential {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let slope = self.slope * other.value + self.value * other.slope;
        Differential { value: self.value * other.value, slope }
    }
}

impl Div for Differential {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        Differential { value, slope: (self.slope - value * other.slope) / other.value }
    }
}

impl Neg for Differential {
    type Output = Self;
    fn neg(self) -> Self {
        Differential { value: -self.value, slope: -self.slope }
    }
}

impl Add<f64> for Differential {
    type Output = Self;
    fn add(self, other: f64) -> Self {
        self + Differential::constant(other)
    }
}

impl Sub<f64> for Differential {
    type Output = Self;
    fn sub(self, other: f64) -> Self {
        self - Differential::constant(other)
    }
}

impl Mul<f64> for Differential {
    type Output = Self;
    fn mul(self, other: f64) -> Self {
        self * Differential::constant(other)
    }
}
