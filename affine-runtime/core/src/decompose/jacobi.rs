//! Singular values and vectors of `2x2` and `3x3` matrices, with high relative accuracy where the matrix has it.

use crate::frames::{Matrix, Vector};

/// `A = L diag(values) R^T`, `R` in SO(n), values not negative and in descending order.
pub(super) struct Factors<const N: usize> {
    pub(super) left: Matrix<N>,
    pub(super) values: Vector<N>,
    pub(super) right: Matrix<N>,
    /// Is `L` in SO(n) too?
    pub(super) proper: bool,
}

/// Columns with a cosine between them below this are orthogonal: what rounding leaves of a product of unit vectors.
const ORTHOGONAL: f64 = 2.0 * f64::EPSILON;
/// Numbers of order 1 and less are squared above this without loss.
const SQUARES: f64 = 1e-140;
/// Sweeps converge quadratically: five are usual, and as many more as here would be needed by nothing known.
const SWEEPS: usize = 30;

/// The factors, for finite entries; `None` for others, and where a column of `L` is not determined since the matrix is
/// singular.
pub(super) fn factors<const N: usize>(matrix: &Matrix<N>) -> Option<Factors<N>> {
    let largest = matrix
        .iter()
        .fold(0.0, |most: f64, entry| if entry.is_nan() { f64::NAN } else { most.max(entry.abs()) });
    if !(largest.is_finite() && largest > 0.0) || matrix.iter().any(|entry| entry.is_nan()) {
        return None;
    }
    // A power of two: entries of order 1 without a rounding.
    let (_, octaves) = libm::frexp(largest);
    let scaled = matrix.map(|entry| libm::ldexp(entry, -octaves));
    let mut found = match N {
        2 => planar(&scaled),
        _ => rotated(&scaled)?,
    };
    found.values.iter_mut().for_each(|value| *value = libm::ldexp(*value, octaves));
    Some(found)
}

/// Half sums and differences are the rotating parts of the matrix: with `a + ib = ((A_11 + A_22) + i(A_21 - A_12))/2` and
/// `c + id = ((A_11 - A_22) + i(A_21 + A_12))/2` the larger value is `|a + ib| + |c + id|`, and the angles of the frames
/// are half the sum and half the difference of the arguments. The smaller value is the determinant over the larger one.
fn planar<const N: usize>(m: &Matrix<N>) -> Factors<N> {
    let (a, b) = (m[(0, 0)] + m[(1, 1)], m[(1, 0)] - m[(0, 1)]);
    let (c, d) = (m[(0, 0)] - m[(1, 1)], m[(1, 0)] + m[(0, 1)]);
    let larger = 0.5 * (libm::hypot(a, b) + libm::hypot(c, d));
    let determinant = difference_of_products(m[(0, 0)], m[(1, 1)], m[(0, 1)], m[(1, 0)]);
    let (whirl, axis) = (libm::atan2(b, a), libm::atan2(d, c));
    let frame = |angle: f64| {
        let (sine, cosine) = libm::sincos(angle);
        let mut frame = Matrix::<N>::from_diagonal_element(cosine);
        frame[(1, 0)] = sine;
        frame[(0, 1)] = -sine;
        frame
    };
    let mut values = Vector::<N>::from_element(larger);
    values[1] = (determinant / larger).abs();
    Factors {
        left: frame(0.5 * (axis + whirl)),
        values,
        right: frame(0.5 * (axis - whirl)),
        proper: determinant > 0.0,
    }
}

/// `a b - c d` with an error below two units of rounding (Kahan; Jeannerod, Louvet, Muller, Math. Comp. 82 (2013) 2245).
fn difference_of_products(a: f64, b: f64, c: f64, d: f64) -> f64 {
    let product = c * d;
    libm::fma(a, b, -product) + libm::fma(-c, d, product)
}

/// Rotates columns of the matrix, or of its transpose, until they are orthogonal.
fn rotated<const N: usize>(matrix: &Matrix<N>) -> Option<Factors<N>> {
    let columns = product_of_column_norms(matrix);
    let rows = product_of_column_norms(&matrix.transpose());
    // The determinant being the same, the smaller product is nearer to it: Hadamard's inequality.
    let transposed = rows < columns;
    let mut work = if transposed { matrix.transpose() } else { *matrix };
    let mut turned = Matrix::<N>::identity();
    for _ in 0..SWEEPS {
        let mut moved = false;
        for (a, b) in [(0, 1), (0, 2), (1, 2)] {
            moved |= rotate(&mut work, &mut turned, a, b)?;
        }
        if !moved {
            break;
        }
    }
    order(&mut work, &mut turned);
    let values = Vector::<N>::from_fn(|a, _| norm(&work, a));
    if values.iter().any(|value| *value == 0.0) {
        return None;
    }
    for a in 0..N {
        work.column_mut(a).iter_mut().for_each(|entry| *entry /= values[a]);
    }
    let (mut left, mut right) = if transposed { (turned, work) } else { (work, turned) };
    if determinant(&right) < 0.0 {
        left.column_mut(N - 1).neg_mut();
        right.column_mut(N - 1).neg_mut();
    }
    let proper = determinant(&left) > 0.0;
    Some(Factors { left, values, right, proper })
}

/// Makes columns `a` and `b` orthogonal, the longer one first; did they have to move? `None` for a column of zeros.
fn rotate<const N: usize>(work: &mut Matrix<N>, turned: &mut Matrix<N>, a: usize, b: usize) -> Option<bool> {
    let (mut first, mut second) = (norm(work, a), norm(work, b));
    if first == 0.0 || second == 0.0 {
        return None;
    }
    if second > first {
        exchange(work, turned, a, b);
        core::mem::swap(&mut first, &mut second);
    }
    let cosine: f64 = if second > SQUARES {
        (0..N).map(|i| work[(i, a)] * work[(i, b)]).sum::<f64>() / (first * second)
    } else {
        (0..N).map(|i| (work[(i, a)] / first) * (work[(i, b)] / second)).sum()
    };
    if cosine.abs() <= ORTHOGONAL {
        return Some(false);
    }
    // The root of smaller size of t^2 + 2 zeta t - 1 = 0, zeta = (|b|^2 - |a|^2)/(2 a.b).
    let zeta = (second / first - first / second) / (2.0 * cosine);
    let size = zeta.abs();
    // Beyond 1e8 the square is all there is, and later leaves the range of doubles.
    let root = if size < 1e8 { libm::sqrt(1.0 + size * size) } else { size };
    let tangent = (1.0 / (size + root)).copysign(zeta);
    let c = 1.0 / libm::sqrt(1.0 + tangent * tangent);
    let s = c * tangent;
    for matrix in [work, turned] {
        for i in 0..N {
            let (x, y) = (matrix[(i, a)], matrix[(i, b)]);
            matrix[(i, a)] = c * x - s * y;
            matrix[(i, b)] = s * x + c * y;
        }
    }
    Some(true)
}

/// Exchanges two columns, one with the opposite sign: a rotation.
fn exchange<const N: usize>(work: &mut Matrix<N>, turned: &mut Matrix<N>, a: usize, b: usize) {
    for matrix in [work, turned] {
        matrix.swap_columns(a, b);
        matrix.column_mut(b).neg_mut();
    }
}

/// Columns of descending length.
fn order<const N: usize>(work: &mut Matrix<N>, turned: &mut Matrix<N>) {
    for (a, b) in [(0, 1), (0, 2), (1, 2)] {
        if norm(work, b) > norm(work, a) {
            exchange(work, turned, a, b);
        }
    }
}

/// Length of a column, without underflow of its squares.
fn norm<const N: usize>(matrix: &Matrix<N>, column: usize) -> f64 {
    let largest = matrix.column(column).iter().fold(0.0, |most: f64, entry| most.max(entry.abs()));
    if largest == 0.0 {
        return 0.0;
    }
    if largest > SQUARES {
        return libm::sqrt(matrix.column(column).iter().map(|entry| entry * entry).sum::<f64>());
    }
    let sum: f64 = matrix.column(column).iter().map(|entry| (entry / largest) * (entry / largest)).sum();
    largest * libm::sqrt(sum)
}

/// As logarithms, which do not underflow.
fn product_of_column_norms<const N: usize>(matrix: &Matrix<N>) -> f64 {
    (0..N).map(|column| libm::log(norm(matrix, column))).sum()
}

/// The determinant of a nearly orthogonal matrix.
fn determinant<const N: usize>(m: &Matrix<N>) -> f64 {
    let minor = |j: usize, k: usize| m[(1, j)] * m[(2, k)] - m[(1, k)] * m[(2, j)];
    m[(0, 0)] * minor(1, 2) - m[(0, 1)] * minor(0, 2) + m[(0, 2)] * minor(0, 1)
}
