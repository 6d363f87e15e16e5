//! Stretches and principal axes in straight-line code, for any [`Scalar`].
//!
//! One-sided Jacobi rotations (Hestenes, J. SIAM 6 (1958) 51): rotations from the right make the columns of `phi` orthogonal
//! two by two, `phi R = L diag(Q)`. They keep small stretches to the precision that `phi` gives them (Demmel and
//! Veselic, SIAM J. Matrix Anal. Appl. 13 (1992) 1204), which the eigenvalues of `phi^T phi` lose. The number of sweeps is
//! fixed and nothing is compared, so that lanes and other numbers run the same code.

use core::array::from_fn;

use crate::frames::Matrix;
use crate::scalar::Scalar;

/// Sweeps over all pairs of columns: convergence is quadratic, and over ten million placements of conditions up to 1e16
/// these left no cosine between columns above 4e-16. For conditions of 1e32 it is 1e-11 in two of a million.
const fn sweeps(n: usize) -> usize {
    if n == 2 { 2 } else { 4 }
}

/// Added to a sum that vanishes only where the columns are orthogonal already and of one length, in units of their
/// squares: any angle is right there, and this one is zero. Below the rounding of every other sum, for `f32` too.
const NO_ANGLE: f64 = 1e-30;

/// The stretches `Q_a`, in no order, the columns of `phi R`, and the body's principal axes `R`, all as rows of arrays:
/// `phi R = L diag(Q)`, `G = R diag(Q^2) R^T`, `R` a rotation.
///
/// Each stretch has an error of a few units of rounding of the largest one, relative to itself where the columns of `phi`
/// are of different size only. Where stretches coincide any axes are right, and some are returned: sums
/// `R diag(f(Q)) R^T` are what they should be. Not finite where `phi` is not, or has a column of zeros; wrong where squares of its
/// entries leave the range of numbers.
#[inline]
#[must_use]
pub fn principal_stretches<const N: usize, T: Scalar>(
    phi: [[T; N]; N],
) -> ([T; N], [[T; N]; N], [[T; N]; N]) {
    let norm = phi.as_flattened().iter().fold(T::zero(), |sum, entry| entry.fma(*entry, sum)).sqrt();
    let scale = T::one() / norm;
    // Columns as arrays: rotations mix whole columns.
    let mut stretched: [[T; N]; N] = from_fn(|a| from_fn(|i| phi[i][a] * scale));
    let mut axes: [[T; N]; N] = from_fn(|a| from_fn(|b| if a == b { T::one() } else { T::zero() }));
    for _ in 0..sweeps(N) {
        for a in 0..N {
            for b in a + 1..N {
                let angle = Angle::between(&stretched[a], &stretched[b]);
                angle.rotate(&mut stretched, a, b);
                angle.rotate(&mut axes, a, b);
            }
        }
    }
    let stretches = from_fn(|a| dot(&stretched[a], &stretched[a]).sqrt() * norm);
    let stretched = stretched.map(|column| column.map(|entry| entry * norm));
    (stretches, transposed(stretched), transposed(axes))
}

/// The same with the log-stretches `q_a = ln Q_a` as second result, all with the digits that `phi - 1` has: of `phi = 1 + H`
/// with a small `H` the errors of `q_a`, and of sums `R diag(f(q)) R^T` over the steepest `f'`, are a few units of rounding of
/// `|H|`, elsewhere those of [`principal_stretches`].
///
/// The columns of `H R` are rotated beside those of `phi R`. Angles come from `phi^T phi`, and near the undeformed state from
/// `phi^T phi - 1 = H + H^T + H^T H`; both times a weight, since nothing is compared.
#[inline]
#[must_use]
#[expect(clippy::type_complexity, reason = "generated code takes them apart at once")]
pub fn principal_log_stretches<const N: usize, T: Scalar>(
    phi: [[T; N]; N],
) -> ([T; N], [T; N], [[T; N]; N], [[T; N]; N]) {
    let sum_of_squares = |sum: T, entry: &T| entry.fma(*entry, sum);
    let square = phi.as_flattened().iter().fold(T::zero(), sum_of_squares);
    let norm = square.sqrt();
    let scale = T::one() / norm;
    // `phi - 1` is not larger than this unit, small as a body may be.
    let unit = T::one() / (square + T::constant(N as f64, 0.0)).sqrt();
    let mut stretched: [[T; N]; N] = from_fn(|a| from_fn(|i| phi[i][a] * scale));
    let mut axes: [[T; N]; N] = from_fn(|a| from_fn(|b| if a == b { T::one() } else { T::zero() }));
    let mut excess: [[T; N]; N] = from_fn(|a| from_fn(|i| (phi[i][a] - axes[a][i]) * unit));
    let weights = Weights {
        strain: excess.as_flattened().iter().fold(T::zero(), sum_of_squares),
        size: square * (unit * unit),
        unit,
    };
    for _ in 0..sweeps(N) {
        for a in 0..N {
            for b in a + 1..N {
                let angle = weights.angle([&stretched, &axes, &excess], a, b);
                angle.rotate(&mut stretched, a, b);
                angle.rotate(&mut axes, a, b);
                angle.rotate(&mut excess, a, b);
            }
        }
    }
    let stretches = from_fn(|a| dot(&stretched[a], &stretched[a]).sqrt() * norm);
    let logarithms = from_fn(|a| {
        // sinh q = (Q^2 - 1)/(2 Q)
        let below = unit * (unit * stretches[a]);
        (weights.rise(&axes[a], &excess[a]) / (below + below)).asinh()
    });
    let stretched = stretched.map(|column| column.map(|entry| entry * norm));
    (stretches, logarithms, transposed(stretched), transposed(axes))
}

/// How much `phi^T phi - 1` has a say in an angle, and how much `phi^T phi`: in the units of the latter, and their ratio is
/// that of what rounding does to both.
struct Weights<T> {
    /// `|phi - 1|^2`, in units of `unit`.
    strain: T,
    /// `|phi|^2`, likewise.
    size: T,
    unit: T,
}

impl<T: Scalar> Weights<T> {
    /// `Q_a^2 - 1` of a column, in units of `unit`.
    fn rise<const N: usize>(&self, axis: &[T; N], excess: &[T; N]) -> T {
        let along = dot(axis, excess) * self.unit;
        dot(excess, excess) + (along + along)
    }

    /// The smaller angle that makes two columns orthogonal.
    fn angle<const N: usize>(
        &self,
        [stretched, axes, excess]: [&[[T; N]; N]; 3],
        a: usize,
        b: usize,
    ) -> Angle<T> {
        let (first, second) = (dot(&stretched[a], &stretched[a]), dot(&stretched[b], &stretched[b]));
        let (left, right) = (self.rise(&axes[a], &excess[a]), self.rise(&axes[b], &excess[b]));
        let both = first * second * self.size;
        let share = T::one() / both.fma(self.size, self.strain);
        let (far, near) = (self.strain * share, both * share);
        let product = dot(&stretched[a], &stretched[b]);
        let across = dot(&axes[a], &excess[b]) + dot(&axes[b], &excess[a]);
        let across = across.fma(self.unit, dot(&excess[a], &excess[b]));
        let half = far.fma(product, near * across);
        Angle::diagonalising(
            far.fma(second - first, near * (right - left)),
            half + half,
            far.fma(first + second, near * (left.abs() + right.abs())) + T::constant(NO_STRAIN, 0.0),
        )
    }
}

/// Added to the sizes of strains, of which all may vanish: without a part in any other, for `f32` too.
const NO_STRAIN: f64 = 1e-6;

/// Log-stretches `q_a = ln Q_a` of a placement, in no order, with the errors of [`principal_log_stretches`].
#[must_use]
pub fn log_stretches<const N: usize, T: Scalar>(phi: &Matrix<N, T>) -> [T; N] {
    principal_log_stretches(from_fn(|i| from_fn(|a| phi[(i, a)]))).1
}

/// Cosine and sine of a rotation of two columns.
#[derive(Clone, Copy)]
struct Angle<T> {
    cosine: T,
    sine: T,
}

impl<T: Scalar> Angle<T> {
    /// The smaller angle that makes two columns orthogonal.
    fn between<const N: usize>(left: &[T; N], right: &[T; N]) -> Self {
        let (first, second) = (dot(left, left), dot(right, right));
        let product = dot(left, right);
        Self::diagonalising(second - first, product + product, first + second)
    }

    /// The smaller angle that makes `[[u, w], [w, v]]` diagonal, from `v - u` and `2 w`; all of the order of `size` at most.
    /// `tan = sign(v - u) 2w/(|v - u| + sqrt((v - u)^2 + (2w)^2))` (Rutishauser, Numer. Math. 9 (1966) 1).
    ///
    /// Numbers with a derivative choose among the axes of stretches that coincide those along which the derivative is diagonal,
    /// as perturbations of degenerate eigenvalues do: sums `R diag(f(Q)) R^T` then have theirs without that of the axes, which
    /// has no bound there.
    fn diagonalising(difference: T, double: T, size: T) -> Self {
        let [difference, double] = T::told_apart([difference, double], size);
        let length = difference.fma(difference, double * double).sqrt();
        let below = size.fma(T::constant(NO_ANGLE, 0.0), difference.abs() + length);
        let tangent = T::one().copysign(difference) * double / below;
        let cosine = T::one() / tangent.fma(tangent, T::one()).sqrt();
        Self { cosine, sine: cosine * tangent }
    }

    fn rotate<const N: usize>(self, columns: &mut [[T; N]; N], a: usize, b: usize) {
        for i in 0..N {
            let (left, right) = (columns[a][i], columns[b][i]);
            columns[a][i] = self.cosine.fma(left, -(self.sine * right));
            columns[b][i] = self.sine.fma(left, self.cosine * right);
        }
    }
}

fn dot<const N: usize, T: Scalar>(left: &[T; N], right: &[T; N]) -> T {
    let mut sum = left[0] * right[0];
    for i in 1..N {
        sum = left[i].fma(right[i], sum);
    }
    sum
}

fn transposed<const N: usize, T: Copy>(rows: [[T; N]; N]) -> [[T; N]; N] {
    from_fn(|i| from_fn(|j| rows[j][i]))
}
