//! Kernels and singular values.

use nalgebra::{ComplexField, DMatrix, DVector, Dyn, SVD};

/// Singular values below this part of the largest are taken for zero.
pub(super) const RANK: f64 = 1e-9;
/// Sweeps of a decomposition.
pub(super) const MOST_SWEEPS: usize = 10_000;

/// Singular values of a matrix that is not empty, with its vectors; `None` for numbers that are not finite.
pub(super) fn decomposed<T: ComplexField<RealField = f64>>(matrix: DMatrix<T>) -> Option<SVD<T, Dyn, Dyn>> {
    let is_finite = !matrix.is_empty() && matrix.iter().all(|entry| entry.clone().is_finite());
    if is_finite { matrix.try_svd(true, true, f64::EPSILON, MOST_SWEEPS) } else { None }
}

/// An orthonormal basis of what a matrix maps to zero: singular values below a part of the largest are none. Empty where
/// there is no decomposition.
pub(super) fn kernel(matrix: &DMatrix<f64>, tolerance: f64) -> DMatrix<f64> {
    let columns = matrix.ncols();
    if matrix.nrows() == 0 || columns == 0 {
        return DMatrix::identity(columns, columns);
    }
    // Rows of zeros give the decomposition all of the right singular vectors.
    let rows = matrix.nrows().max(columns);
    let Some(SVD { v_t: Some(v_t), singular_values, .. }) =
        decomposed(matrix.clone().resize(rows, columns, 0.0))
    else {
        return DMatrix::zeros(columns, 0);
    };
    let largest = singular_values.max();
    let none = (0..columns).filter(|k| singular_values[*k] <= tolerance * largest);
    let vectors: Vec<DVector<f64>> = none.map(|k| v_t.row(k).transpose()).collect();
    if vectors.is_empty() { DMatrix::zeros(columns, 0) } else { DMatrix::from_columns(&vectors) }
}

/// An orthonormal basis of the columns' span.
pub(super) fn span(matrix: &DMatrix<f64>, tolerance: f64) -> DMatrix<f64> {
    kernel(&kernel(&matrix.transpose(), tolerance).transpose(), tolerance)
}

/// What a matrix maps to less than a number.
pub(super) fn absolute_kernel(matrix: &DMatrix<f64>, threshold: f64) -> DMatrix<f64> {
    let largest = decomposed(matrix.clone()).map_or(0.0, |svd| svd.singular_values.max());
    if largest <= threshold {
        DMatrix::identity(matrix.ncols(), matrix.ncols())
    } else {
        kernel(matrix, threshold / largest)
    }
}
