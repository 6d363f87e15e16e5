//! Matrices and vectors of a body's dimension.

use crate::scalar::Real;

/// An `N` by `N` matrix.
pub type Matrix<const N: usize, T = f64> = nalgebra::SMatrix<T, N, N>;
/// An `N`-vector.
pub type Vector<const N: usize, T = f64> = nalgebra::SVector<T, N>;

/// Inverse: the transposed cofactors over the determinant where that is not small beside the entries, so that
/// nothing cancels that counts; elsewhere by Gauss-Jordan elimination with partial pivoting. Not finite where the
/// matrix is singular (phase points are checked for `det phi > 0` when they are made).
pub fn inverse<const N: usize, T: Real>(matrix: &Matrix<N, T>) -> Matrix<N, T> {
    let plain = if N == 3 { by_cofactors(matrix) } else { None };
    plain.unwrap_or_else(|| by_elimination(matrix))
}

/// `(b x c, c x a, a x b)^T/det` of the columns `a`, `b`, `c`, where `det^2 > 2^-12 |matrix|^6`, which is `2^-7.3` times
/// what it is at most, and in the range of numbers.
fn by_cofactors<const N: usize, T: Real>(matrix: &Matrix<N, T>) -> Option<Matrix<N, T>> {
    let of = |i: usize, j: usize| matrix[(i % 3, j % 3)];
    let cofactor =
        |i: usize, j: usize| of(i + 1, j + 1) * of(i + 2, j + 2) - of(i + 1, j + 2) * of(i + 2, j + 1);
    let squares = matrix.iter().fold(T::zero(), |sum, entry| sum + *entry * *entry);
    let cofactors: [[T; 3]; 3] = core::array::from_fn(|i| core::array::from_fn(|j| cofactor(i, j)));
    let determinant = of(0, 0) * cofactors[0][0] + of(0, 1) * cofactors[0][1] + of(0, 2) * cofactors[0][2];
    let (size, least) = (squares * squares * squares, T::from_f64(WELL_CONDITIONED));
    let is_plain = determinant * determinant > least * size && size > T::from_f64(1e-200);
    is_plain.then(|| Matrix::from_fn(|i, j| cofactors[j][i] / determinant))
}

/// Part of `|matrix|^6` above which `det^2` is no difference of numbers that are much larger.
const WELL_CONDITIONED: f64 = 1.0 / 4096.0;

fn by_elimination<const N: usize, T: Real>(matrix: &Matrix<N, T>) -> Matrix<N, T> {
    // In place: columns of the identity take the places of those that are done with. Rows, and places of rows.
    let mut rows: [[T; N]; N] = core::array::from_fn(|i| core::array::from_fn(|j| matrix[(i, j)]));
    let mut places: [usize; N] = core::array::from_fn(|i| i);
    for column in 0..N {
        for row in column + 1..N {
            if rows[row][column].abs() > rows[column][column].abs() {
                rows.swap(row, column);
                places.swap(row, column);
            }
        }
        let scale = T::one() / rows[column][column];
        rows[column][column] = T::one();
        let head = rows[column].map(|entry| entry * scale);
        rows[column] = head;
        for row in 0..N {
            if row != column {
                let factor = rows[row][column];
                rows[row][column] = T::zero();
                for (entry, head) in rows[row].iter_mut().zip(head) {
                    *entry -= factor * head;
                }
            }
        }
    }
    let mut inverse = Matrix::<N, T>::zeros();
    for (row, entries) in rows.into_iter().enumerate() {
        for (place, entry) in places.into_iter().zip(entries) {
            inverse[(row, place)] = entry;
        }
    }
    inverse
}

#[cfg(test)]
mod tests {
    use super::{Matrix, by_cofactors, by_elimination, inverse};

    /// Rows about those of a multiple of the identity, with the digits of a few products for entries.
    fn near_conformal(k: u32, size: f64, spread: f64) -> Matrix<3> {
        let noise = |i: usize, j: usize| (f64::from(k) * 1.7 + (3 * i + j) as f64 * 2.3).sin() * spread;
        Matrix::from_fn(|i, j| size * (if i == j { 1.0 + noise(i, j) } else { noise(i, j) }))
    }

    #[test]
    fn both_ways_invert() {
        let mut taken = 0;
        for k in 0..200 {
            for (size, spread) in [(1.0, 0.1), (1e-20, 0.5), (1e20, 1.0), (3.0, 2.0)] {
                let matrix = near_conformal(k, size, spread);
                let (whole, cofactors) = (inverse(&matrix), by_cofactors(&matrix));
                let defect = |inverse: Matrix<3>| (inverse * matrix - Matrix::<3>::identity()).norm();
                let condition = whole.norm() * matrix.norm();
                taken += u32::from(cofactors.is_some());
                for found in [Some(by_elimination(&matrix)), cofactors, Some(whole)].into_iter().flatten() {
                    assert!(defect(found) < 4.0 * condition * f64::EPSILON, "{matrix} {}", defect(found));
                }
            }
        }
        assert!((200..700).contains(&taken), "each way is taken: {taken}");
    }

    #[test]
    fn what_is_exact_stays_so() {
        let turned = Matrix::<3>::new(0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0);
        assert_eq!(inverse(&turned), turned.transpose());
        let swapped = Matrix::<2>::new(0.0, 2.0, 4.0, 0.0);
        assert_eq!(inverse(&swapped), Matrix::<2>::new(0.0, 0.25, 0.5, 0.0));
        for diagonal in [[3.0, 5.0, 7.0], [1e-200, 1.0, 1e200], [1e150, 1e-140, 49.0], [1e-90, 1e-90, 2e-90]]
        {
            let matrix = Matrix::<3>::from_diagonal(&diagonal.into());
            let exact = Matrix::<3>::from_diagonal(&diagonal.map(|entry| 1.0 / entry).into());
            let found = inverse(&matrix);
            assert!(
                (0..3).all(|i| (found[(i, i)] / exact[(i, i)] - 1.0).abs() <= f64::EPSILON)
                    && (found - Matrix::<3>::from_diagonal(&found.diagonal())).norm() == 0.0,
                "{found}"
            );
        }
    }

    #[test]
    fn a_singular_matrix_has_no_finite_inverse() {
        let flat = Matrix::<3>::new(1.0, 2.0, 3.0, 2.0, 4.0, 6.0, 1.0, 0.0, 1.0);
        assert!(inverse(&flat).iter().any(|entry| !entry.is_finite()));
    }
}
