//! Truncated power series as numbers: the second route to Taylor coefficients. Functions are composed by Taylor's
//! theorem, `f(u_0 + d) = sum_m f^(m)(u_0)/m! d^m`; no differential equation is used.

use core::cmp::Ordering;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use affine_runtime::scalar::{Real, Scalar};
use num_traits::{One, Zero};

/// Number of coefficients.
pub const LENGTH: usize = 9;

/// `sum_k c_k t^k`, terms from `t^LENGTH` on left out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet(pub [f64; LENGTH]);

impl Jet {
    /// A number that does not change.
    pub fn fixed(value: f64) -> Self {
        let mut jet = [0.0; LENGTH];
        jet[0] = value;
        Jet(jet)
    }

    /// `sum_m c_m d^m`, `d = self - self_0`.
    fn composed(self, coefficients: impl Fn(usize) -> f64) -> Self {
        let mut change = self;
        change.0[0] = 0.0;
        let (mut sum, mut power) = (Jet::fixed(0.0), Jet::fixed(1.0));
        for m in 0..LENGTH {
            sum += power * Jet::fixed(coefficients(m));
            power *= change;
        }
        sum
    }

    /// `self^a` by the binomial series.
    fn power(self, a: f64) -> Self {
        let u = self.0[0];
        let binomial = |m: usize| (0..m).map(|i| (a - i as f64) / (i as f64 + 1.0)).product::<f64>();
        self.composed(|m| binomial(m) * u.powf(a) / u.powi(m as i32))
    }

    /// A function whose derivatives at `self_0` repeat: `cycle[m % len]`.
    fn periodic(self, cycle: &[f64]) -> Self {
        let factorial = |m: usize| (1..=m).map(|i| i as f64).product::<f64>();
        self.composed(|m| cycle[m % cycle.len()] / factorial(m))
    }
}

impl Add for Jet {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Jet(core::array::from_fn(|k| self.0[k] + other.0[k]))
    }
}

impl Sub for Jet {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Jet(core::array::from_fn(|k| self.0[k] - other.0[k]))
    }
}

impl Mul for Jet {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Jet(core::array::from_fn(|k| (0..=k).map(|j| self.0[j] * other.0[k - j]).sum()))
    }
}

#[allow(clippy::suspicious_arithmetic_impl, reason = "a quotient is a product with a geometric series")]
impl Div for Jet {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        self * other.power(-1.0)
    }
}

impl Neg for Jet {
    type Output = Self;
    fn neg(self) -> Self {
        Jet(self.0.map(|c| -c))
    }
}

macro_rules! assign {
    ($($trait:ident $method:ident $operator:tt),*) => { $(
        impl $trait for Jet {
            fn $method(&mut self, other: Self) {
                *self = *self $operator other;
            }
        }
    )* };
}

assign!(AddAssign add_assign +, SubAssign sub_assign -, MulAssign mul_assign *, DivAssign div_assign /);

impl Zero for Jet {
    fn zero() -> Self {
        Jet::fixed(0.0)
    }
    fn is_zero(&self) -> bool {
        *self == Self::zero()
    }
}

impl One for Jet {
    fn one() -> Self {
        Jet::fixed(1.0)
    }
}

impl Scalar for Jet {
    fn constant(hi: f64, _lo: f64) -> Self {
        Jet::fixed(hi)
    }
    fn sqrt(self) -> Self {
        self.power(0.5)
    }
    fn cbrt(self) -> Self {
        self.power(1.0 / 3.0)
    }
    fn exp(self) -> Self {
        self.periodic(&[self.0[0].exp()])
    }
    fn exp_m1(self) -> Self {
        self.exp() - Self::one()
    }
    fn ln(self) -> Self {
        let u = self.0[0];
        self.composed(|m| if m == 0 { u.ln() } else { -(-1.0 / u).powi(m as i32) / m as f64 })
    }
    fn ln_1p(self) -> Self {
        (self + Self::one()).ln()
    }
    fn sin(self) -> Self {
        let (s, c) = self.0[0].sin_cos();
        self.periodic(&[s, c, -s, -c])
    }
    fn cos(self) -> Self {
        let (s, c) = self.0[0].sin_cos();
        self.periodic(&[c, -s, -c, s])
    }
    fn tan(self) -> Self {
        self.sin() / self.cos()
    }
    fn sinh(self) -> Self {
        self.periodic(&[self.0[0].sinh(), self.0[0].cosh()])
    }
    fn cosh(self) -> Self {
        self.periodic(&[self.0[0].cosh(), self.0[0].sinh()])
    }
    fn tanh(self) -> Self {
        self.sinh() / self.cosh()
    }
    fn copysign(self, sign: Self) -> Self {
        let flips = self.0[0].is_sign_negative() != sign.0[0].is_sign_negative();
        if flips { -self } else { self }
    }
    fn abs(self) -> Self {
        self * Jet::fixed(self.0[0].signum())
    }
}

impl PartialOrd for Jet {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.0[0].partial_cmp(&other.0[0])
    }
}

impl Real for Jet {
    const EPSILON: Self = {
        let mut epsilon = [0.0; LENGTH];
        epsilon[0] = f64::EPSILON;
        Jet(epsilon)
    };
    fn hypot(self, other: Self) -> Self {
        Jet::fixed(self.0[0].hypot(other.0[0]))
    }
    fn is_finite(self) -> bool {
        self.0.iter().all(|c| c.is_finite())
    }
    fn to_f64(self) -> f64 {
        self.0[0]
    }
}
