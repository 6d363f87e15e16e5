//! The matrix exponential, and the rotations it makes of skew matrices.

use crate::frames::Matrix;
use crate::scalar::Real;

/// Column sums below which the Taylor polynomial of [`SERIES`] is cut off at less than an eighth of a
/// rounding: the first term left out, relative to the sum, is `0.7^16/17! = 9e-18`.
const SERIES_RADIUS: f64 = 0.7;

/// `1/k!` for `k = 0..=16`.
pub const SERIES: [f64; 17] = [
    1.0,
    1.0,
    1.0 / 2.0,
    1.0 / 6.0,
    1.0 / 24.0,
    1.0 / 120.0,
    1.0 / 720.0,
    1.0 / 5_040.0,
    1.0 / 40_320.0,
    1.0 / 362_880.0,
    1.0 / 3_628_800.0,
    1.0 / 39_916_800.0,
    1.0 / 479_001_600.0,
    1.0 / 6_227_020_800.0,
    1.0 / 87_178_291_200.0,
    1.0 / 1_307_674_368_000.0,
    1.0 / 20_922_789_888_000.0,
];

/// `ln 2` in two parts; the first has 21 trailing zero bits, so that integers below `2^21` multiply it exactly.
pub const LN2_HIGH: f64 = 6.931_471_803_691_238e-1;
/// What that leaves out of it.
pub const LN2_LOW: f64 = 1.908_214_929_270_587_7e-10;

/// `exp(A) = exp(tr A/n) exp(B)`, `B = A - (tr A/n) 1`, of an `n` by `n` matrix, `n` = 2 or 3.
///
/// `exp(B)` is the Taylor series of the exponential at `B/2^s`, squared `s` times. The series is summed in
/// `f64`: its roundings are as harmless as roundings of the entries of `A`. Those of the squarings are not:
/// powers of a non-normal matrix may swell and shrink again, or be far more sensitive than their end (the hump
/// and the overscaling of Moler and Van Loan, SIAM Rev. 45 (2003) 3, and Al-Mohy and Higham, SIAM J. Matrix
/// Anal. Appl. 31 (2009) 970). So squares carry 25 bits more.
///
/// Error, for Frobenius norms of `A` up to 700: at most `4 eps (1 + kappa)` relative to `exp(A)` in the
/// Frobenius norm, with `kappa = ||L|| ||A|| / ||exp(A)||` the relative condition number and `L` the Fréchet
/// derivative of the exponential at `A` (Higham, Functions of Matrices, 2008, section 3.1).
///
/// Entries beyond the range of `f64` are infinite, with their sign. All entries are NaN if one of `A` is
/// infinite or NaN, or if sums of its entries overflow.
#[must_use]
pub fn exponential<const N: usize>(matrix: &Matrix<N>) -> Matrix<N> {
    let mean = (0..N).map(|i| matrix[(i, i)] / N as f64).sum::<f64>();
    let mut deviator = *matrix;
    for i in 0..N {
        deviator[(i, i)] -= mean;
    }
    let norm = largest_column_sum(&deviator);
    if !(norm.is_finite() && mean.is_finite()) {
        return Matrix::from_element(f64::NAN);
    }
    let squarings = squarings(norm);
    let growth = series(&(deviator * libm::ldexp(1.0, -squarings)));
    let mut power = Extended::new(&Matrix::identity(), &growth, 0);
    for _ in 0..squarings {
        power = power.square();
    }
    scale(&power, mean)
}

/// `max_j sum_i |a_ij|`.
fn largest_column_sum<const N: usize>(matrix: &Matrix<N>) -> f64 {
    let sums = matrix.column_iter().map(|column| column.iter().map(|v| v.abs()).sum::<f64>());
    // `f64::max` would drop a NaN.
    sums.fold(0.0, |largest, sum| if sum > largest || sum.is_nan() { sum } else { largest })
}

/// The smallest `s >= 0` with `norm/2^s <= SERIES_RADIUS`, or one more.
fn squarings(norm: f64) -> i32 {
    libm::frexp(norm / SERIES_RADIUS).1.max(0)
}

/// `exp(B) - 1` by its Taylor polynomial of degree 16, in powers of `B^4` (Paterson and Stockmeyer, 1973).
fn series<const N: usize>(matrix: &Matrix<N>) -> Matrix<N> {
    let second = matrix * matrix;
    let third = second * matrix;
    let fourth = second * second;
    let block = |k: usize| {
        let mut sum = third * SERIES[k + 3] + second * SERIES[k + 2] + matrix * SERIES[k + 1];
        for i in 0..N {
            sum[(i, i)] += SERIES[k];
        }
        sum
    };
    let top = fourth * SERIES[16] + block(12);
    let upper = fourth * (fourth * (fourth * top + block(8)) + block(4));
    // Smallest terms first; `exp(B) - 1` has no constant term.
    upper + third * SERIES[3] + second * SERIES[2] + matrix
}

/// `(head + tail) 2^exponent`, the largest entry between 1/2 and 1: entries of `head` are multiples of `2^-25`,
/// so that products of two heads are exact, and `tail` holds the next 53 bits.
struct Extended<const N: usize> {
    head: Matrix<N>,
    tail: Matrix<N>,
    exponent: i64,
}

impl<const N: usize> Extended<N> {
    /// `(large + small) 2^exponent`, `small` being the rest that `large` cannot hold.
    fn new(large: &Matrix<N>, small: &Matrix<N>, exponent: i64) -> Self {
        /// Adding it leaves a multiple of `2^-25` of what is at most 1.
        const GRID: f64 = 1.5 * (1_u64 << 27) as f64;

        let (_, octaves) = libm::frexp((large + small).amax());
        let unit = libm::ldexp(1.0, -octaves);
        let (large, small) = (large * unit, small * unit);
        let head = (large + small).map(|value| (value + GRID) - GRID);
        Self { head, tail: (large - head) + small, exponent: exponent.saturating_add(octaves.into()) }
    }

    /// The square; what is left out is below `2^-75` of the product of the norms.
    fn square(&self) -> Self {
        let rest = self.head * self.tail + self.tail * self.rounded();
        Self::new(&(self.head * self.head), &rest, self.exponent.saturating_mul(2))
    }

    /// `head + tail`.
    fn rounded(&self) -> Matrix<N> {
        self.head + self.tail
    }
}

/// `exp(mean)` times the matrix, without overflow in between.
fn scale<const N: usize>(power: &Extended<N>, mean: f64) -> Matrix<N> {
    let octaves = libm::rint(mean * core::f64::consts::LOG2_E);
    let rest = (mean - octaves * LN2_HIGH) - octaves * LN2_LOW;
    // Only a mean beyond 1e9, where no digit is left, meets the bounds.
    let factor = libm::exp(rest.clamp(-1.0, 1.0));
    let exponent = power.exponent.saturating_add(octaves as i64).clamp(-10_000, 10_000) as i32;
    power.rounded().map(|value| libm::scalbn(value * factor, exponent))
}

/// `exp(W)`, the rotation generated by a skew matrix, `n` = 2 or 3.
///
/// ```text
/// n = 2:  cos(w) 1 + sin(w) [[0, -1], [1, 0]],                w = W_21
/// n = 3:  1 + sin(w) K + 2 sin^2(w/2) K^2,    K = W/w,    w^2 = -tr(W^2)/2
/// ```
///
/// (Rodrigues). Orthogonal to a few roundings for every finite angle; the rotation itself is exact to about
/// `eps (1 + w)`. Only the entries below the diagonal are read. Not finite if one of them is not.
#[must_use]
pub fn skew_exponential<const N: usize, T: Real>(skew: &Matrix<N, T>) -> Matrix<N, T> {
    const { assert!(N == 2 || N == 3, "rotations are in closed form for n = 2 and n = 3") };
    if N == 2 { rotation_in_plane(skew[(1, 0)]) } else { rotation_in_space(skew) }
}

/// `[[cos w, -sin w], [sin w, cos w]]`.
fn rotation_in_plane<const N: usize, T: Real>(angle: T) -> Matrix<N, T> {
    let (sine, cosine) = angle.sin_cos();
    let mut rotation = Matrix::<N, T>::from_diagonal_element(cosine);
    rotation[(1, 0)] = sine;
    rotation[(0, 1)] = -sine;
    rotation
}

/// Rodrigues' formula with a unit axis: no series is needed near zero, and `|axis| = 1` to rounding makes the
/// result orthogonal to rounding whatever the angle.
fn rotation_in_space<const N: usize, T: Real>(skew: &Matrix<N, T>) -> Matrix<N, T> {
    let vector = [skew[(2, 1)], -skew[(2, 0)], skew[(1, 0)]];
    let angle = vector[0].hypot(vector[1]).hypot(vector[2]);
    if angle == T::zero() {
        return Matrix::<N, T>::identity();
    }
    let axis = vector.map(|component| component / angle);
    let (half_sine, half_cosine) = (angle * T::from_f64(0.5)).sin_cos();
    let twice = half_sine + half_sine;
    let (sine, versine) = (twice * half_cosine, twice * half_sine);
    let mut rotation = Matrix::<N, T>::identity();
    for (i, j, k) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
        rotation[(i, i)] -= versine * (axis[j] * axis[j] + axis[k] * axis[k]);
        let (even, odd) = (versine * axis[i] * axis[j], sine * axis[k]);
        rotation[(j, i)] = even + odd;
        rotation[(i, j)] = even - odd;
    }
    rotation
}
