//! Kernels and singular values.

use nalgebra::{ComplexField, DMatrix, DVector, Dyn, SVD};

use super::error::AnalysisError;
use super::singular::singular;

/// Vectors and matrices.
pub(super) type Column = DVector<f64>;
pub(super) type Dense = DMatrix<f64>;

/// Singular values below this part of the largest are taken for zero.
pub(super) const RANK: f64 = 1e-9;
/// Sweeps of a decomposition: two for each of some twenty eigenvalues are usual.
pub(super) const MOST_SWEEPS: usize = 1000;

/// A matrix of so many rows from its columns, of which there may be none.
pub(super) fn from_columns(rows: usize, columns: &[Column]) -> Dense {
    if columns.is_empty() { DMatrix::zeros(rows, 0) } else { DMatrix::from_columns(columns) }
}

/// Singular values of a matrix that is not empty, with its vectors; `None` for numbers that are not finite.
pub(super) fn decomposed<T: ComplexField<RealField = f64>>(matrix: DMatrix<T>) -> Option<SVD<T, Dyn, Dyn>> {
    let is_finite = !matrix.is_empty() && matrix.iter().all(|entry| entry.clone().is_finite());
    is_finite.then(|| singular(matrix))
}

/// An orthonormal basis of what a matrix maps to zero: singular values below a part of the largest are none. Empty where
/// there is no decomposition.
pub(super) fn kernel(matrix: &Dense, tolerance: f64) -> Dense {
    mapped_below(matrix, |largest| tolerance * largest)
}

/// What a matrix maps to less than a number.
pub(super) fn absolute_kernel(matrix: &Dense, threshold: f64) -> Dense {
    mapped_below(matrix, |_| threshold)
}

fn mapped_below(matrix: &Dense, bound: impl Fn(f64) -> f64) -> Dense {
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
    let bound = bound(singular_values.max());
    let none = (0..columns).filter(|k| singular_values[*k] <= bound);
    let vectors: Vec<Column> = none.map(|k| v_t.row(k).transpose()).collect();
    from_columns(columns, &vectors)
}

/// An orthonormal basis of the columns' span, as far as they are above a number.
pub(super) fn span(matrix: &Dense, threshold: f64) -> Dense {
    kernel(&absolute_kernel(&matrix.transpose(), threshold).transpose(), RANK)
}

/// The least-norm solution of linear equations, as nearly as they have one.
pub(super) fn solved(matrix: &Dense, right: &Column) -> Result<Column, AnalysisError> {
    if matrix.is_empty() {
        return Ok(Column::zeros(matrix.ncols()));
    }
    let svd = decomposed(matrix.clone()).ok_or(AnalysisError::NoDecomposition)?;
    let none = RANK * svd.singular_values.max();
    svd.solve(right, none).map_err(|_| AnalysisError::NoDecomposition)
}
