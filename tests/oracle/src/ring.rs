//! The numbers: integers, integers with an infinitesimal part, and the way between them and `f64`.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

use crate::matrix::Matrix;

/// Numerators of exact matrices: integers, or dual integers that carry a derivative along.
///
/// Denominators stay plain integers, common to a whole matrix; this saves the greatest common divisors that
/// rational arithmetic would take after every operation.
pub trait Ring: Clone {
    /// The integer `value`, with derivative 0.
    fn constant(value: BigInt) -> Self;
    /// `self + other`.
    fn plus(&self, other: &Self) -> Self;
    /// `self - other`.
    fn minus(&self, other: &Self) -> Self;
    /// `self * other`.
    fn times(&self, other: &Self) -> Self;
    /// `self * factor`.
    fn scaled(&self, factor: &BigInt) -> Self;
    /// `1/self` as numerator and positive denominator; `None` where the value is 0.
    fn reciprocal(&self) -> Option<(Self, BigInt)>;
    /// The largest `k` such that `2^k` divides the number; `None` for 0.
    fn twos(&self) -> Option<u64>;
    /// `self / 2^k`, for `k` at most [`Ring::twos`].
    fn halved(&self, k: u64) -> Self;
    /// The solution `X` of `matrix X = right`; `None` where `matrix` is singular.
    fn solve(matrix: &Matrix<Self>, right: &Matrix<Self>) -> Option<Matrix<Self>>;
}

impl Ring for BigInt {
    fn constant(value: BigInt) -> Self {
        value
    }
    fn plus(&self, other: &Self) -> Self {
        self + other
    }
    fn minus(&self, other: &Self) -> Self {
        self - other
    }
    fn times(&self, other: &Self) -> Self {
        self * other
    }
    fn scaled(&self, factor: &BigInt) -> Self {
        self * factor
    }
    fn reciprocal(&self) -> Option<(Self, BigInt)> {
        (!self.is_zero()).then(|| (self.signum(), self.abs()))
    }
    fn twos(&self) -> Option<u64> {
        self.trailing_zeros()
    }
    fn halved(&self, k: u64) -> Self {
        self >> k
    }
    fn solve(matrix: &Matrix<Self>, right: &Matrix<Self>) -> Option<Matrix<Self>> {
        crate::linear::solve(matrix, right)
    }
}

/// `value + epsilon slope` with `epsilon^2 = 0`: a number together with its derivative in one direction.
#[derive(Clone, Debug)]
pub struct Dual {
    pub(crate) value: BigInt,
    pub(crate) slope: BigInt,
}

impl Ring for Dual {
    fn constant(value: BigInt) -> Self {
        Dual { value, slope: BigInt::zero() }
    }
    fn plus(&self, other: &Self) -> Self {
        Dual { value: &self.value + &other.value, slope: &self.slope + &other.slope }
    }
    fn minus(&self, other: &Self) -> Self {
        Dual { value: &self.value - &other.value, slope: &self.slope - &other.slope }
    }
    fn times(&self, other: &Self) -> Self {
        Dual {
            value: &self.value * &other.value,
            slope: &self.value * &other.slope + &self.slope * &other.value,
        }
    }
    fn scaled(&self, factor: &BigInt) -> Self {
        Dual { value: &self.value * factor, slope: &self.slope * factor }
    }
    /// `1/(v + epsilon s) = (v - epsilon s)/v^2`.
    fn reciprocal(&self) -> Option<(Self, BigInt)> {
        let conjugate = Dual { value: self.value.clone(), slope: -&self.slope };
        (!self.value.is_zero()).then(|| (conjugate, &self.value * &self.value))
    }
    fn twos(&self) -> Option<u64> {
        match (self.value.trailing_zeros(), self.slope.trailing_zeros()) {
            (Some(value), Some(slope)) => Some(value.min(slope)),
            (value, slope) => value.or(slope),
        }
    }
    fn halved(&self, k: u64) -> Self {
        Dual { value: &self.value >> k, slope: &self.slope >> k }
    }
    /// `(M + epsilon M')(X + epsilon X') = R + epsilon R'`: `M X = R`, then `M X' = R' - M' X`.
    fn solve(matrix: &Matrix<Self>, right: &Matrix<Self>) -> Option<Matrix<Self>> {
        let plain = matrix.value();
        let value = crate::linear::solve(&plain, &right.value())?;
        let slope = crate::linear::solve(&plain, &(&right.slope() - &(&matrix.slope() * &value)))?;
        Some(Matrix::along(&value, &slope))
    }
}

/// The rational number `numerator/denominator`.
///
/// # Panics
/// Where `denominator` is 0.
pub fn rational(numerator: i64, denominator: i64) -> BigRational {
    BigRational::new(numerator.into(), denominator.into())
}

/// The rational number that a finite `f64` is; `None` for infinities and NaN.
pub fn exact(value: f64) -> Option<BigRational> {
    BigRational::from_float(value)
}

/// The `f64` nearest to `value`, ties to even; infinite beyond the range of `f64`.
pub fn rounded(value: &BigRational) -> f64 {
    // `Ratio<BigInt>::to_f64` always answers; NaN would show up as a failed comparison.
    value.to_f64().unwrap_or(f64::NAN)
}

/// Greatest common divisor by Euclid's algorithm, with the sign left open.
pub(crate) fn gcd(a: &BigInt, b: &BigInt) -> BigInt {
    let (mut a, mut b) = (a.clone(), b.clone());
    while !b.is_zero() {
        let rest = &a % &b;
        a = b;
        b = rest;
    }
    a
}

/// The least common multiple of positive integers.
pub(crate) fn common_multiple<'a>(numbers: impl Iterator<Item = &'a BigInt>) -> BigInt {
    numbers.fold(BigInt::one(), |multiple, number| {
        if (&multiple % number).is_zero() {
            return multiple;
        }
        let divisor = gcd(&multiple, number);
        // The sign of Euclid's divisor follows the operands, which are positive here.
        multiple / divisor * number
    })
}
