//! Increments of exponential flows: `exp(A) - 1` without cancellation, and what it does to matrices.

use affine_core::scalar::Real;

/// Entries of a matrix up to which the series of its exponential is summed as it stands.
const RADIUS: f64 = 0.5;
/// Terms of the series, at most: for a full 3 by 3 matrix of such entries the next one is below `1.5^27/27! = 6e-24`;
/// it ends where terms do not count any more.
const MOST_TERMS: usize = 26;

/// `exp(A) - 1` of an `N` by `N` matrix, `N` = 2 or 3, to a few roundings of its largest entry where those of `A` are
/// at most 1/2; larger ones are halved, and `g -> 2g + g^2` doubles the error with the time.
///
/// `A = m 1 + B` with `tr B = 0`. By Cayley and Hamilton `B^3 = s B + d 1`, `s = tr(B^2)/2`, `d = det B` (0 for
/// `N` = 2): powers of `B` have three coefficients, and the series is summed on these.
#[inline]
#[must_use]
pub fn growth<const N: usize, T: Real>(a: [[T; N]; N]) -> [[T; N]; N] {
    const { assert!(N == 2 || N == 3, "the Cayley-Hamilton recurrence is for n = 2 and n = 3") };
    let mut largest = T::zero();
    for entry in a.iter().flatten() {
        let size = entry.abs();
        // A NaN stays in the result.
        largest = if size > largest { size } else { largest };
    }
    if largest <= T::from_f64(RADIUS) {
        return series(a);
    }
    let mut halvings: i32 = 0;
    let (mut scale, half) = (T::one(), T::from_f64(0.5));
    while largest * scale > T::from_f64(RADIUS) && halvings < 1100 {
        scale *= half;
        halvings += 1;
    }
    let mut g = series(a.map(|row| row.map(|entry| entry * scale)));
    for _ in 0..halvings {
        let square = product(&g, &g);
        g = core::array::from_fn(|i| core::array::from_fn(|j| (g[i][j] + g[i][j]) + square[i][j]));
    }
    g
}

#[inline]
fn series<const N: usize, T: Real>(a: [[T; N]; N]) -> [[T; N]; N] {
    let nth = T::one() / T::from_f64(N as f64);
    let mut mean = T::zero();
    for i in 0..N {
        mean += a[i][i] * nth;
    }
    let mut b = a;
    for i in 0..N {
        b[i][i] -= mean;
    }
    let square = product(&b, &b);
    let half = T::from_f64(0.5);
    let mut s = T::zero();
    for i in 0..N {
        s += square[i][i] * half;
    }
    let d = if N == 3 { determinant(&b) } else { T::zero() };
    let [f0, f1, f2] = coefficients(s, d);
    // exp(m) exp(B) - 1 = (e^m - 1) + e^m (exp(B) - 1).
    let (excess, factor) = if mean == T::zero() {
        (T::zero(), T::one())
    } else {
        let excess = mean.exp_m1();
        (excess, T::one() + excess)
    };
    core::array::from_fn(|i| {
        core::array::from_fn(|j| {
            let mut sum = square[i][j].fma(f2, b[i][j] * f1);
            if i == j {
                sum += f0;
            }
            let grown = sum * factor;
            if i == j { grown + excess } else { grown }
        })
    })
}

/// `f0, f1, f2` with `exp(B) - 1 = f0 + f1 B + f2 B^2`.
#[inline]
fn coefficients<T: Real>(s: T, d: T) -> [T; 3] {
    // B^k/k! = x + y B + z B^2; multiplied by B: d z + (x + s z) B + y B^2.
    let (mut x, mut y, mut z) = (T::zero(), T::one(), T::zero());
    let mut sum = [x, y, z];
    let mut k = T::one();
    for _ in 1..MOST_TERMS {
        k += T::one();
        let inverse = T::one() / k;
        (x, y, z) = (d * z * inverse, z.fma(s, x) * inverse, y * inverse);
        let next = [sum[0] + x, sum[1] + y, sum[2] + z];
        if next == sum {
            break;
        }
        sum = next;
    }
    sum
}

fn determinant<const N: usize, T: Real>(b: &[[T; N]; N]) -> T {
    let minor = |j: usize, k: usize| b[1][j] * b[2][k] - b[1][k] * b[2][j];
    b[0][0] * minor(1, 2) - b[0][1] * minor(0, 2) + b[0][2] * minor(0, 1)
}

#[inline]
fn product<const N: usize, T: Real>(a: &[[T; N]; N], b: &[[T; N]; N]) -> [[T; N]; N] {
    core::array::from_fn(|i| {
        core::array::from_fn(|j| {
            let mut sum = a[i][0] * b[0][j];
            for k in 1..N {
                sum = a[i][k].fma(b[k][j], sum);
            }
            sum
        })
    })
}

/// The increment `phi (exp(hY) - 1)`.
#[inline]
#[must_use]
pub fn right_product<const N: usize, T: Real>(phi: [[T; N]; N], growth: &[[T; N]; N]) -> [[T; N]; N] {
    product(&phi, growth)
}

/// The increment `(exp(hY) - 1) phi`.
#[inline]
#[must_use]
pub fn left_product<const N: usize, T: Real>(phi: [[T; N]; N], growth: &[[T; N]; N]) -> [[T; N]; N] {
    product(growth, &phi)
}

/// The increment `L M R - M` with `L = 1 + left`, `R = 1 + right`: `left M + (M + left M) right`.
#[inline]
#[must_use]
pub fn conjugated<const N: usize, T: Real>(
    m: [[T; N]; N],
    left: &[[T; N]; N],
    right: &[[T; N]; N],
) -> [[T; N]; N] {
    let first = product(left, &m);
    let sum: [[T; N]; N] = core::array::from_fn(|i| core::array::from_fn(|j| m[i][j] + first[i][j]));
    let second = product(&sum, right);
    core::array::from_fn(|i| core::array::from_fn(|j| first[i][j] + second[i][j]))
}

/// `(exp(x s) - 1)/s` and `(exp(-x s) - 1)/s`, that is `x` and `-x` where `s = 0`: the `g` of `exp(x E) = 1 + g E` and of
/// its inverse, where `E^2 = s E`.
#[inline]
#[must_use]
pub fn elongation<T: Real>(x: T, s: T) -> (T, T) {
    let exponent = x * s;
    if exponent == T::zero() {
        return (x, T::zero() - x);
    }
    let rise = exponent.exp_m1();
    let growth = x * (rise / exponent);
    (growth, T::zero() - growth / (T::one() + rise))
}

/// `u = sinh(x r)/r` and `v = (cosh(x r) - 1)/k` with `r = sqrt k`, for `k < 0` by sine and cosine, `x` and `x^2/2` for
/// `k = 0`: where `E^3 = k E`, `exp(x E) = 1 + u E + v E^2`. By halves of the argument nothing cancels.
#[inline]
#[must_use]
pub fn turning<T: Real>(x: T, k: T) -> (T, T) {
    let root = k.abs().sqrt();
    let half = T::from_f64(0.5) * x * root;
    if half == T::zero() {
        return (x, T::from_f64(0.5) * x * x);
    }
    let (sine, cosine) = if k > T::zero() {
        let rise = half.exp_m1();
        let fall = rise / (T::one() + rise);
        (T::from_f64(0.5) * (rise + fall), T::one() + T::from_f64(0.5) * (rise - fall))
    } else {
        half.sin_cos()
    };
    let unit = (sine + sine) / root;
    (unit * cosine, T::from_f64(0.5) * unit * unit)
}

/// Adds to a component and to what rounding left out of it.
#[inline(always)]
pub fn accumulate<T: Real>(value: &mut T, carry: &mut T, rise: T) {
    let rise = *carry + rise;
    let before = *value;
    *value = before + rise;
    *carry = (before - *value) + rise;
}

#[cfg(test)]
mod tests {
    use super::{elongation, growth, turning};
    use affine_core::decompose::exponential;
    use affine_core::frames::Matrix;

    /// Both are good to some roundings; with `2^s` halvings the growth loses as many more.
    fn agree<const N: usize>(a: [[f64; N]; N], roundings: f64) {
        let expected = exponential(&Matrix::<N>::from_fn(|i, j| a[i][j])) - Matrix::<N>::identity();
        let found = growth(a);
        let found = Matrix::<N>::from_fn(|i, j| found[i][j]);
        let size = if expected.norm() > 1.0 { expected.norm() } else { 1.0 };
        assert!((found - expected).norm() <= roundings * f64::EPSILON * size, "{a:?}: {found} {expected}");
    }

    #[test]
    fn it_is_the_exponential_less_one() {
        let (b2, b3) =
            ([[0.3, -0.4], [0.25, 0.1]], [[0.3, -0.4, 0.1], [0.25, 0.1, -0.45], [0.05, 0.4, -0.2]]);
        for (scale, roundings) in
            [(0.0, 0.0), (1e-9, 8.0), (0.1, 8.0), (1.0, 8.0), (4.0, 64.0), (20.0, 512.0)]
        {
            agree(b2.map(|row| row.map(|x| x * scale)), roundings);
            agree(b3.map(|row| row.map(|x| x * scale)), roundings);
        }
        // Nilpotent, skew, and a multiple of the identity.
        agree([[0.0, 0.5, 0.2], [0.0, 0.0, 0.4], [0.0, 0.0, 0.0]], 4.0);
        agree([[0.0, -0.5], [0.5, 0.0]], 4.0);
        agree([[0.4, 0.0], [0.0, 0.4]], 4.0);
    }

    fn matrix(e: impl Fn(usize, usize) -> f64) -> Matrix<3> {
        Matrix::<3>::from_fn(e)
    }

    fn same(found: &Matrix<3>, exponent: &Matrix<3>) {
        let expected = exponential(exponent) - Matrix::<3>::identity();
        let error = (found - expected).norm();
        assert!(error <= 8.0 * f64::EPSILON * (1.0 + expected.norm()), "{exponent}: {error:e}");
    }

    #[test]
    fn along_one_direction_it_is_a_number() {
        // E = r u v^T, E^2 = r (v u) E.
        let (u, v) = ([0.5, -0.25, 1.0], [0.75, 1.5, -0.5]);
        for (r, x) in [(0.5_f64, 0.3), (-2.0, 1.5), (1e-9, 1e-3), (3.0, -0.7), (0.0, 2.0)] {
            let e = matrix(|i, j| r * u[i] * v[j]);
            let (growth, decay) = elongation(x, e.trace());
            same(&(growth * e), &(x * e));
            same(&(decay * e), &(-x * e));
        }
    }

    #[test]
    fn of_a_turn_it_has_two_numbers() {
        let skew = matrix(|i, j| [[0.0, -0.3, 0.4], [0.3, 0.0, 1.2], [-0.4, -1.2, 0.0]][i][j]);
        let pair = matrix(|i, j| [[0.0, 1.0, 0.0], [0.25, 0.0, 0.0], [0.0, 0.0, 0.0]][i][j]);
        let shear = matrix(|i, j| [[0.0, 1.0, 0.5], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]][i][j]);
        for e in [skew, pair, shear] {
            for x in [0.3, -1.5, 1e-9, 4.0, 0.0] {
                let (u, v) = turning(x, 0.5 * (e * e).trace());
                same(&(u * e + v * e * e), &(x * e));
            }
        }
    }

    #[test]
    fn small_growth_keeps_its_digits() {
        let [[diagonal, upper], [lower, _]]: [[f64; 2]; 2] = growth([[1e-20_f64, 3e-17], [-2e-18, -1e-20]]);
        assert!(
            (diagonal - 1e-20).abs() < 1e-33
                && (upper - 3e-17).abs() < 1e-32
                && (lower + 2e-18).abs() < 1e-33
        );
    }

    #[test]
    fn what_is_no_number_stays_none() {
        assert!(growth([[f64::NAN, 0.0], [0.0, 0.0]]).iter().flatten().any(|x| x.is_nan()));
        assert!(!growth([[f64::INFINITY, 0.0], [0.0, 1.0]]).iter().flatten().all(|x| x.is_finite()));
    }
}
