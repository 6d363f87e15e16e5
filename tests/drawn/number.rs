//! Numbers of 31 digits with a bound of what rounding does to them, and with derivatives in all directions at once.

use affine_codegen::algebra::evaluate::Field;
use affine_codegen::algebra::{Function, Rational};
use affine_runtime::scalar::Scalar;
use qd::Quad;

/// The field in which programs are run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Number(pub(crate) Quad);

impl Field for Number {
    fn from_rational(value: &Rational) -> Self {
        let (high, low) = value.to_doubles();
        Self(Scalar::constant(high, low))
    }
    fn add(&self, other: &Self) -> Self {
        Self(self.0 + other.0)
    }
    fn mul(&self, other: &Self) -> Self {
        Self(self.0 * other.0)
    }
    fn recip(&self) -> Option<Self> {
        (self.0 != Quad::ZERO).then(|| Self(Quad::ONE / self.0))
    }
    fn apply(&self, function: Function) -> Option<Self> {
        Some(Self(match function {
            Function::ExpM1 => self.0.exp_m1(),
            Function::Asinh => Scalar::asinh(self.0),
            Function::Cbrt => Scalar::cbrt(self.0),
            Function::InverseCbrt => Quad::ONE / Scalar::cbrt(self.0),
            Function::Sign => Scalar::copysign(Quad::ONE, self.0),
            plain => taylor(plain, self.0)[0],
        }))
    }
}

/// `f(u), f'(u), f''(u)`.
fn taylor(function: Function, u: Quad) -> [Quad; 3] {
    let (one, two) = (Quad::ONE, Quad::from(2.0));
    match function {
        Function::Exp => [Scalar::exp(u); 3],
        Function::Ln => [Scalar::ln(u), one / u, -one / (u * u)],
        Function::Sqrt => {
            let root = Scalar::sqrt(u);
            let slope = one / (two * root);
            [root, slope, -slope / (two * u)]
        }
        Function::Abs => [Scalar::abs(u), Scalar::copysign(one, u), Quad::ZERO],
        Function::Sin => [Scalar::sin(u), Scalar::cos(u), -Scalar::sin(u)],
        Function::Cos => [Scalar::cos(u), -Scalar::sin(u), -Scalar::cos(u)],
        Function::Tan => {
            let tan = Scalar::tan(u);
            let slope = one + tan * tan;
            [tan, slope, two * tan * slope]
        }
        Function::Sinh => [Scalar::sinh(u), Scalar::cosh(u), Scalar::sinh(u)],
        Function::Cosh => [Scalar::cosh(u), Scalar::sinh(u), Scalar::cosh(u)],
        Function::Tanh => {
            let tanh = Scalar::tanh(u);
            let slope = one - tanh * tanh;
            [tanh, slope, -two * tanh * slope]
        }
        other => panic!("{other:?} is no function of potentials"),
    }
}

/// A number, and what one rounding in every operand and every operation so far does to it at most, in units of the rounding.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rounded {
    pub(crate) value: Quad,
    pub(crate) error: f64,
}

impl Rounded {
    pub(crate) const ZERO: Self = Self { value: Quad::ZERO, error: 0.0 };

    /// A number that is stored.
    pub(crate) fn stored(value: Quad) -> Self {
        Self { value, error: size(value) }
    }

    pub(crate) fn plus(self, other: Self) -> Self {
        let value = self.value + other.value;
        Self { value, error: self.error + other.error + size(value) }
    }

    pub(crate) fn times(self, other: Self) -> Self {
        let value = self.value * other.value;
        let error = size(self.value) * other.error + size(other.value) * self.error + size(value);
        Self { value, error }
    }

    pub(crate) fn negated(self) -> Self {
        Self { value: -self.value, ..self }
    }
}

/// The size of a number, in double precision.
pub(crate) fn size(value: Quad) -> f64 {
    value.0.abs()
}

/// Time, the position of the centre, the placement row by row.
pub(crate) const DIRECTIONS: usize = 1 + 3 + 9;

/// A number with its derivatives in every direction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Dual {
    pub(crate) value: Rounded,
    pub(crate) slopes: [Rounded; DIRECTIONS],
}

impl Dual {
    pub(crate) fn constant(value: Quad) -> Self {
        Self { value: Rounded::stored(value), slopes: [Rounded::ZERO; DIRECTIONS] }
    }

    /// The coordinate of a direction.
    pub(crate) fn coordinate(value: Quad, direction: usize) -> Self {
        let mut coordinate = Self::constant(value);
        coordinate.slopes[direction] = Rounded { value: Quad::ONE, error: 0.0 };
        coordinate
    }

    pub(crate) fn plus(&self, other: &Self) -> Self {
        let slopes = std::array::from_fn(|k| self.slopes[k].plus(other.slopes[k]));
        Self { value: self.value.plus(other.value), slopes }
    }

    pub(crate) fn negated(&self) -> Self {
        Self { value: self.value.negated(), slopes: self.slopes.map(Rounded::negated) }
    }

    pub(crate) fn times(&self, other: &Self) -> Self {
        let slope = |k: usize| {
            let (left, right) = (self.slopes[k], other.slopes[k]);
            left.times(other.value).plus(right.times(self.value))
        };
        Self { value: self.value.times(other.value), slopes: std::array::from_fn(slope) }
    }

    pub(crate) fn apply(&self, function: Function) -> Self {
        let series = taylor(function, self.value.value);
        let terms = match function {
            // The terms of the slope, 1 and the square.
            Function::Tan | Function::Tanh => 1.0 + size(series[0] * series[0]),
            _ => 0.0,
        };
        self.chain(series, terms)
    }

    /// `u^(k/l)`, of positive numbers where `l` is not 1.
    pub(crate) fn power(&self, k: i32, l: u32) -> Self {
        let u = self.value.value;
        let exponent = Quad::from(f64::from(k)) / Quad::from(f64::from(l));
        let power = match l {
            1 => whole(u, k),
            _ => Scalar::exp(Scalar::ln(u) * exponent),
        };
        if u == Quad::ZERO {
            // Of zero only whole powers above zero have a value.
            let first = if k == 1 { Quad::ONE } else { Quad::ZERO };
            let second = if k == 2 { Quad::from(2.0) } else { Quad::ZERO };
            return self.chain([power, first, second], 0.0);
        }
        let slope = exponent * power / u;
        self.chain([power, slope, (exponent - Quad::ONE) * slope / u], 0.0)
    }

    /// `f(u)` by `f(u), f'(u), f''(u)`, and the size of terms that the slope is the difference of.
    fn chain(&self, [value, slope, curvature]: [Quad; 3], terms: f64) -> Self {
        let moved =
            |value: Quad, slope: Quad| Rounded { value, error: size(value) + size(slope) * self.value.error };
        let mut outer = moved(slope, curvature);
        outer.error += terms;
        Self { value: moved(value, slope), slopes: self.slopes.map(|inner| outer.times(inner)) }
    }
}

fn whole(u: Quad, k: i32) -> Quad {
    let power = (0..k.unsigned_abs()).fold(Quad::ONE, |power, _| power * u);
    if k < 0 { Quad::ONE / power } else { power }
}
