//! Singular values with their vectors.

use nalgebra::{ComplexField, DMatrix, DVector, Dyn, SVD};

/// Sweeps over all pairs of columns: a dozen are usual.
const MOST_SWEEPS: usize = 64;

/// The decomposition of a finite matrix that is not empty, by rotations of its columns until they are orthogonal (M. Hestenes, J. SIAM
/// 6 (1958) 51): as exact as the matrix, which the bidiagonal one of nalgebra 0.35 is not where values coincide or vanish (its issue
/// 1172).
pub(super) fn singular<T: ComplexField<RealField = f64>>(matrix: DMatrix<T>) -> SVD<T, Dyn, Dyn> {
    if matrix.nrows() >= matrix.ncols() {
        return of_columns(matrix);
    }
    let SVD { u, v_t, singular_values } = of_columns(matrix.adjoint());
    SVD { u: v_t.map(|v| v.adjoint()), v_t: u.map(|u| u.adjoint()), singular_values }
}

fn of_columns<T: ComplexField<RealField = f64>>(mut columns: DMatrix<T>) -> SVD<T, Dyn, Dyn> {
    let (count, unit) = (columns.ncols(), columns.camax().max(f64::MIN_POSITIVE));
    columns.unscale_mut(unit);
    let mut turned = DMatrix::<T>::identity(count, count);
    for _ in 0..MOST_SWEEPS {
        let mut are_orthogonal = true;
        for (p, q) in (0..count).flat_map(|p| (p + 1..count).map(move |q| (p, q))) {
            if let Some(turn) = turn(&columns, (p, q)) {
                [&mut columns, &mut turned].into_iter().for_each(|matrix| rotate(matrix, (p, q), &turn));
                are_orthogonal = false;
            }
        }
        if are_orthogonal {
            break;
        }
    }
    // From the largest on.
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|a, b| columns.column(*b).norm().total_cmp(&columns.column(*a).norm()));
    let [mut columns, turned] = [columns, turned].map(|matrix| matrix.select_columns(&order));
    let lengths: Vec<f64> = columns.column_iter().map(|column| column.norm()).collect();
    for k in 0..count {
        match lengths[k] > 0.0 {
            true => columns.column_mut(k).unscale_mut(lengths[k]),
            false => complete(&mut columns, k),
        }
    }
    let singular_values = DVector::from_iterator(count, lengths.iter().map(|length| length * unit));
    SVD { u: Some(columns), v_t: Some(turned.adjoint()), singular_values }
}

/// Two columns, the first before the second.
type Pair = (usize, usize);
/// Cosine and sine of the angle by which two columns are turned, and the phase of the second.
type Turn<T> = (f64, f64, T);

/// What makes two columns orthogonal; none where they are.
fn turn<T: ComplexField<RealField = f64>>(columns: &DMatrix<T>, (p, q): Pair) -> Option<Turn<T>> {
    let (rows, all) = (columns.nrows(), columns.as_slice());
    let (mut product, mut squares) = (T::zero(), [0.0; 2]);
    for (first, second) in all[p * rows..][..rows].iter().zip(&all[q * rows..][..rows]) {
        product += first.clone().conjugate() * second.clone();
        squares[0] += first.clone().modulus_squared();
        squares[1] += second.clone().modulus_squared();
    }
    let size = product.clone().modulus();
    let rounding = f64::EPSILON * (rows as f64).sqrt();
    if size <= rounding * squares[0].sqrt() * squares[1].sqrt() {
        return None;
    }
    let cotangent = (squares[1] - squares[0]) / (2.0 * size);
    let tangent = 1.0_f64.copysign(cotangent) / (cotangent.abs() + cotangent.hypot(1.0));
    let cosine = 1.0 / tangent.hypot(1.0);
    Some((cosine, cosine * tangent, product.unscale(size).conjugate()))
}

fn rotate<T: ComplexField<RealField = f64>>(matrix: &mut DMatrix<T>, (p, q): Pair, by: &Turn<T>) {
    let (cosine, sine, phase) = by;
    let rows = matrix.nrows();
    let (before, after) = matrix.as_mut_slice().split_at_mut(q * rows);
    for (first, second) in before[p * rows..][..rows].iter_mut().zip(&mut after[..rows]) {
        let (x, y) = (first.clone(), second.clone() * phase.clone());
        *first = x.clone().scale(*cosine) - y.clone().scale(*sine);
        *second = x.scale(*sine) + y.scale(*cosine);
    }
}

/// Replaces a column of zeros by a unit vector that is orthogonal to all other columns but those of zeros: what these leave of one axis,
/// that of which they contain least.
fn complete<T: ComplexField<RealField = f64>>(columns: &mut DMatrix<T>, k: usize) {
    let (rows, others) = (columns.nrows(), columns.column_iter().filter(|column| column.norm() > 0.0));
    let others: Vec<DVector<T>> = others.map(|column| column.normalize()).collect();
    let contained =
        |axis: &usize| -> f64 { others.iter().map(|other| other[*axis].clone().modulus_squared()).sum() };
    let Some(axis) = (0..rows).min_by(|a, b| contained(a).total_cmp(&contained(b))) else { return };
    let mut rest = DVector::<T>::zeros(rows);
    rest[axis] = T::one();
    // The second time takes away what rounding has left of the others.
    for other in others.iter().chain(&others) {
        let part = other.dotc(&rest);
        rest -= other * part;
    }
    columns.set_column(k, &rest.normalize());
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Complex;

    /// Whether there are vectors, which are to make up the matrix with the values.
    fn is_made_up<T: ComplexField<RealField = f64>>(matrix: &DMatrix<T>) -> Option<bool> {
        let SVD { u, v_t, singular_values } = singular(matrix.clone());
        let (u, v_t) = (u?, v_t?);
        let values = DMatrix::from_diagonal(&singular_values.map(T::from_real));
        let off = (&u * values * &v_t - matrix).norm();
        let unit = DMatrix::<T>::identity(u.ncols(), u.ncols());
        let are_orthonormal =
            (u.adjoint() * &u - &unit).norm() < 1e-13 && (&v_t * v_t.adjoint() - unit).norm() < 1e-13;
        Some(off <= 1e-14 * matrix.norm() && are_orthonormal)
    }

    fn check<T: ComplexField<RealField = f64>>(matrix: &DMatrix<T>) {
        assert_eq!(is_made_up(matrix), Some(true), "{matrix}");
    }

    fn noise(k: usize) -> f64 {
        (k as f64 * 12.9898).sin()
    }

    #[test]
    fn they_make_up_the_matrix_again() {
        for (rows, columns) in [(1, 1), (3, 3), (9, 4), (4, 9), (18, 18)] {
            let any = DMatrix::from_fn(rows, columns, |i, j| noise(1 + i + 31 * j));
            check(&any);
            check(&DMatrix::from_fn(rows, columns, |i, j| {
                Complex::new(noise(2 + i + 17 * j), noise(5 * i + j))
            }));
            // Of no rank, of rank one, with columns alike, of large and of small columns.
            check(&DMatrix::<f64>::zeros(rows, columns));
            check(&DMatrix::from_fn(rows, columns, |i, j| noise(i + 1) * noise(j + 7)));
            check(&DMatrix::from_fn(rows, columns, |i, j| if i % 3 == j % 3 { 1.0 } else { 0.0 }));
            check(&DMatrix::from_fn(rows, columns, |i, j| any[(i, j)] * 1e-9_f64.powi(j as i32 % 4)));
        }
    }

    #[test]
    fn small_values_have_their_digits() {
        // Columns that are orthogonal, and nine powers of ten apart.
        let graded = DMatrix::from_fn(3, 3, |i, j| {
            [[1.0, 2.0, 2.0], [2.0, 1.0, -2.0], [2.0, -2.0, 1.0]][i][j] / 3.0 * 1e-9_f64.powi(j as i32)
        });
        let mut found: Vec<f64> = singular(graded).singular_values.iter().copied().collect();
        found.sort_by(|a, b| b.total_cmp(a));
        for (k, value) in found.iter().enumerate() {
            assert!((value / 1e-9_f64.powi(k as i32) - 1.0).abs() < 1e-14, "{found:?}");
        }
    }
}
