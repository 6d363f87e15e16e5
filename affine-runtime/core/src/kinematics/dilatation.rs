//! Log-determinant, mean log-stretch, dilatation and isochoric part of a placement.
//!
//! `det phi` of a 3 by 3 placement leaves the range of `f64` where entries reach `1e103` or fall to `1e-110`;
//! its logarithm does not. Powers of two are taken out exactly before the elimination and put back after it, so
//! that `q` and `D` keep their digits over the whole range of the number type.

use crate::frames::Matrix;
use crate::scalar::Real;

/// `ln 2`: the nearest double, and the double nearest to the rest.
const LN_2: (f64, f64) = (core::f64::consts::LN_2, 2.319_046_813_846_299_6e-17);

/// Entries of `phi - 1` up to which the elimination keeps `phi - 1` apart from `1`: rows of `phi` are then
/// diagonally dominant for `N <= 3`, so that no pivoting is needed.
const NEARLY_UNDEFORMED: f64 = 0.0625;

/// Mean log-stretch `q = ln(det phi)/n`, the mean of the logarithms of the stretches.
///
/// Minus infinity where `det phi = 0`, NaN where it is negative or an entry is not finite. Error: a few
/// epsilons, relative where `|q| > 1` and absolute below, times the condition number that `phi` has after its
/// rows and columns are scaled; `phi = 1 + H` with a small `H` has the absolute error `epsilon |H|` instead.
/// (Slawianowski et al., section 5.)
pub fn mean_log_stretch<const N: usize, T: Real>(phi: &Matrix<N, T>) -> T {
    LogDeterminant::of(phi).mean()
}

/// Dilatation `D = exp(q) = (det phi)^(1/n)`, the geometric mean of the stretches.
///
/// Zero where `det phi = 0`, NaN where it is negative or an entry is not finite; the relative error is that of
/// [`mean_log_stretch`] for `|q| < 1`, however large `q` is.
pub fn dilatation<const N: usize, T: Real>(phi: &Matrix<N, T>) -> T {
    LogDeterminant::of(phi).root()
}

/// Isochoric part `Psi = exp(-q) phi` of a placement, with `det Psi = 1`: itself a placement.
///
/// Not finite where `det phi <= 0`.
pub fn isochoric_part<const N: usize, T: Real>(phi: &Matrix<N, T>) -> Matrix<N, T> {
    let dilatation = dilatation(phi);
    phi.map(|entry| entry / dilatation)
}

/// Is an entry of `phi` above 2, or `D` below 1/2? Elsewhere the stretches are between 1/288 and 6, and numbers counted
/// from their values at `phi = 1` are as good as any.
pub fn far_from_undeformed<const N: usize, T: Real>(phi: &Matrix<N, T>) -> bool {
    let two = T::one() + T::one();
    if phi.iter().any(|entry| entry.abs() > two) {
        return true;
    }
    // A few products say it of most: they are off by less than 1e-13 where no entry is above 2.
    let lowest = (0..N).fold(T::from_f64(1.001), |lowest, _| lowest / two);
    let is_clearly_near = determinant_by_products(phi).is_some_and(|determinant| determinant > lowest);
    !is_clearly_near && dilatation(phi) * two < T::one()
}

/// The determinant where it is no difference of numbers that are much larger: above `|matrix|^3/16`, a third of what it is at
/// most.
fn well_conditioned_determinant<const N: usize, T: Real>(matrix: &Matrix<N, T>) -> Option<T> {
    let determinant = determinant_by_products(matrix).filter(|_| N == 3)?;
    let squares = matrix.iter().fold(T::zero(), |sum, entry| sum + *entry * *entry);
    let size = squares * squares * squares;
    let is_plain = determinant > T::zero()
        && determinant * determinant * T::from_f64(256.0) > size
        && size > T::from_f64(1e-200);
    is_plain.then_some(determinant)
}

/// The determinant of two or three rows, where products stay in the range of numbers.
fn determinant_by_products<const N: usize, T: Real>(phi: &Matrix<N, T>) -> Option<T> {
    let minor = |a: usize, b: usize| phi[(N - 2, a)] * phi[(N - 1, b)] - phi[(N - 2, b)] * phi[(N - 1, a)];
    match N {
        2 => Some(minor(0, 1)),
        3 => Some(phi[(0, 0)] * minor(1, 2) - phi[(0, 1)] * minor(0, 2) + phi[(0, 2)] * minor(0, 1)),
        _ => None,
    }
}

/// `det phi = sign exp(mantissa) 2^(N exponent)`.
#[derive(Clone, Copy, Debug)]
pub struct LogDeterminant<const N: usize, T> {
    /// 1, 0, -1, or NaN where an entry is not finite.
    sign: T,
    /// Logarithm of a number between `2^-N` and `2^N`, so that nothing cancels against `exponent`; minus
    /// infinity where the determinant vanishes.
    mantissa: T,
    exponent: i32,
}

impl<const N: usize, T: Real> LogDeterminant<N, T> {
    /// The determinant of a matrix.
    pub fn of(matrix: &Matrix<N, T>) -> Self {
        // Neither is said of entries that are not finite.
        let excess = matrix - Matrix::<N, T>::identity();
        if excess.iter().all(|entry| entry.abs() <= T::from_f64(NEARLY_UNDEFORMED)) {
            return Self { sign: T::one(), mantissa: log_determinant_near_identity(excess), exponent: 0 };
        }
        if let Some(determinant) = well_conditioned_determinant(matrix) {
            return Self::from_product(determinant, 0);
        }
        if !matrix.iter().all(|entry| entry.is_finite()) {
            let nan = T::from_f64(f64::NAN);
            return Self { sign: nan, mantissa: nan, exponent: 0 };
        }
        let (scaled, exponent) = equilibrate(matrix);
        Self::from_product(determinant_by_elimination(scaled), exponent)
    }

    /// `product 2^exponent`, with the power of two split so that the logarithm of the rest is small.
    fn from_product(product: T, exponent: i32) -> Self {
        if product == T::zero() {
            return Self { sign: T::zero(), mantissa: T::from_f64(f64::NEG_INFINITY), exponent: 0 };
        }
        let sign = if product > T::zero() { T::one() } else { -T::one() };
        let own = binary_exponent(product);
        let order = i32::try_from(N).unwrap_or(i32::MAX);
        // Rounded to the middle, so that a determinant between 1/2 and 2 keeps the exponent 0.
        let mean = (own + exponent + (order - 1) / 2).div_euclid(order);
        let mantissa = times_power_of_two(product.abs(), exponent - order * mean);
        Self { sign, mantissa: mantissa.ln(), exponent: mean }
    }

    /// The determinant is positive: the matrix keeps orientation.
    pub fn is_positive(&self) -> bool {
        self.sign > T::zero()
    }

    /// The determinant and its inverse are normal doubles.
    #[cfg(feature = "std")]
    pub fn is_normal(&self) -> bool {
        let power = self.exponent.unsigned_abs().saturating_mul(u32::try_from(N).unwrap_or(u32::MAX));
        // The mantissa is a logarithm of at most N ln 2.
        power + u32::try_from(N).unwrap_or(0) < f64::MAX_EXP.unsigned_abs()
    }

    /// The determinant as a double, infinite or zero where it leaves the range.
    pub fn to_f64(self) -> f64 {
        let power = self.exponent.saturating_mul(i32::try_from(N).unwrap_or(i32::MAX));
        self.sign.to_f64() * libm::ldexp(self.mantissa.exp().to_f64(), power)
    }

    /// `ln(det)/N`.
    pub fn mean(self) -> T {
        let ln_2 = T::constant(LN_2.0, LN_2.1);
        let mean = self.mantissa / integer(N) + T::from_f64(f64::from(self.exponent)) * ln_2;
        if self.sign >= T::zero() { mean } else { T::from_f64(f64::NAN) }
    }

    /// `det^2`.
    pub(super) fn squared(self) -> T {
        let order = i32::try_from(N).unwrap_or(i32::MAX);
        times_power_of_two((self.mantissa + self.mantissa).exp(), 2 * order * self.exponent)
    }

    /// `det^(1/N)`.
    fn root(self) -> T {
        let root = times_power_of_two((self.mantissa / integer(N)).exp(), self.exponent);
        if self.sign >= T::zero() { root } else { T::from_f64(f64::NAN) }
    }
}

/// `N` as a number.
pub(crate) fn integer<T: Real>(n: usize) -> T {
    (0..n).fold(T::zero(), |sum, _| sum + T::one())
}

/// `ln det(1 + H)` for a small `H`: elimination on `H` itself, whose pivots are `1 + h`, so that the logarithms
/// are taken as `ln(1 + h)`.
fn log_determinant_near_identity<const N: usize, T: Real>(mut excess: Matrix<N, T>) -> T {
    let mut sum = T::zero();
    for k in 0..N {
        let pivot = excess[(k, k)];
        sum += pivot.ln_1p();
        eliminate(&mut excess, k, T::one() + pivot);
    }
    sum
}

/// A step of Gauss elimination by a pivot, without what becomes zero.
fn eliminate<const N: usize, T: Real>(matrix: &mut Matrix<N, T>, k: usize, pivot: T) {
    for row in k + 1..N {
        let factor = matrix[(row, k)] / pivot;
        for column in k + 1..N {
            let above = matrix[(k, column)];
            matrix[(row, column)] -= factor * above;
        }
    }
}

/// The matrix with powers of two taken out of its rows, then of its columns, so that the largest entry of each
/// is about 1; and the sum of the exponents taken out.
fn equilibrate<const N: usize, T: Real>(matrix: &Matrix<N, T>) -> (Matrix<N, T>, i32) {
    /// That of zero: smaller than any, also with another exponent taken off.
    const OF_ZERO: i32 = i32::MIN / 2;
    let exponents: [[i32; N]; N] = core::array::from_fn(|row| {
        core::array::from_fn(|column| {
            let entry = matrix[(row, column)];
            if entry == T::zero() { OF_ZERO } else { binary_exponent(entry) }
        })
    });
    let scale = |largest: i32| if largest > OF_ZERO / 2 { largest } else { 0 };
    let rows: [i32; N] = exponents.map(|row| scale(row.into_iter().fold(OF_ZERO, i32::max)));
    let columns: [i32; N] = core::array::from_fn(|column| {
        let left = exponents.iter().zip(rows).map(|(row, scale)| row[column] - scale);
        scale(left.fold(OF_ZERO, i32::max))
    });
    let scaled = Matrix::from_fn(|row, column| {
        times_power_of_two(matrix[(row, column)], -(rows[row] + columns[column]))
    });
    (scaled, rows.iter().chain(&columns).sum())
}

/// Determinant by Gauss elimination with partial pivoting.
fn determinant_by_elimination<const N: usize, T: Real>(mut matrix: Matrix<N, T>) -> T {
    let mut product = T::one();
    for k in 0..N {
        let larger = |pivot, row| if matrix[(row, k)].abs() > matrix[(pivot, k)].abs() { row } else { pivot };
        let pivot = (k + 1..N).fold(k, larger);
        if matrix[(pivot, k)] == T::zero() {
            return T::zero();
        }
        if pivot != k {
            matrix.swap_rows(pivot, k);
            product = -product;
        }
        let head = matrix[(k, k)];
        product *= head;
        eliminate(&mut matrix, k, head);
    }
    product
}

/// `e` with `2^(e-1) <= |value| < 2^e`; the value is neither zero nor infinite.
#[inline]
fn binary_exponent<T: Real>(value: T) -> i32 {
    let value = value.to_f64();
    // The bits of a normal number say it.
    if value.is_normal() { ((value.to_bits() >> 52) & 0x7ff) as i32 - 1022 } else { libm::frexp(value).1 }
}

/// `value 2^exponent`, exact where the result is a normal number. In quarters where the power itself may lie outside the
/// range of `T` where the result does not.
fn times_power_of_two<T: Real>(value: T, exponent: i32) -> T {
    if (-64..=64).contains(&exponent) {
        return value * T::from_f64(power_of_two(exponent));
    }
    let quarter = exponent / 4;
    [quarter, quarter, quarter, exponent - 3 * quarter]
        .into_iter()
        .fold(value, |product, part| product * T::from_f64(power_of_two(part)))
}

/// `2^exponent`: where that is a normal number, from its bits.
#[inline]
fn power_of_two(exponent: i32) -> f64 {
    if (-1022..=1023).contains(&exponent) {
        f64::from_bits(((exponent + 1023) as u64) << 52)
    } else {
        libm::ldexp(1.0, exponent)
    }
}

/// `X - (tr X / n) 1`.
pub(super) fn deviator<const N: usize, T: Real>(matrix: &Matrix<N, T>) -> Matrix<N, T> {
    let mean = matrix.trace() / integer(N);
    matrix - Matrix::<N, T>::identity() * mean
}

#[cfg(test)]
mod tests {
    use super::{LogDeterminant, determinant_by_elimination, equilibrate, well_conditioned_determinant};
    use crate::frames::Matrix;

    #[test]
    fn products_are_as_good_as_an_elimination() {
        let mut taken = 0;
        for k in 0..400_u32 {
            let noise = |i: usize, j: usize| (f64::from(k) * 1.3 + (3 * i + j) as f64 * 2.9).sin();
            let size = [1.0, 1e-25, 1e25, 0.4][k as usize % 4];
            let matrix = Matrix::<3>::from_fn(|i, j| {
                size * (0.4 * noise(i, j) + if (i + k as usize) % 3 == j { 1.3 } else { 0.0 })
            });
            let Some(determinant) = well_conditioned_determinant(&matrix) else { continue };
            taken += 1;
            let (scaled, exponent) = equilibrate(&matrix);
            let other = LogDeterminant::<3, f64>::from_product(determinant_by_elimination(scaled), exponent);
            let found = LogDeterminant::<3, f64>::from_product(determinant, 0);
            let apart = (found.mean() - other.mean()).abs();
            assert!(apart <= 4.0 * f64::EPSILON * (1.0 + other.mean().abs()), "{matrix} {apart}");
        }
        assert!(taken > 100, "{taken}");
    }

    #[test]
    fn flat_and_reflected_bodies_are_left_to_the_elimination() {
        for diagonal in [[1.0, 1.0, 0.1], [1.0, 1.0, -1.0], [1e200, 1e200, 1e200], [1e-80, 1e-80, 1e-80]] {
            let matrix = Matrix::<3>::from_diagonal(&diagonal.into());
            assert_eq!(well_conditioned_determinant(&matrix), None, "{diagonal:?}");
        }
    }
}
