//! Small matrices over exact rationals: inverse, inertia, kernel.

use super::rational::Rational;

/// A square matrix, row after row.
pub type Square = Vec<Vec<Rational>>;

/// A congruence `L D L^T` of a symmetric matrix with pairs of equal rows swapped: what it says about the form.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Inertia {
    /// Number of positive squares.
    pub positive: usize,
    /// Number of negative squares.
    pub negative: usize,
    /// A vector of the kernel, if the form is degenerate.
    pub kernel: Option<Vec<Rational>>,
}

/// Inverse by Gauss-Jordan elimination; `None` where the matrix is singular.
#[must_use]
pub fn inverse(matrix: &Square) -> Option<Square> {
    let n = matrix.len();
    let mut rows: Square = matrix
        .iter()
        .enumerate()
        .map(|(i, row)| {
            let unit = (0..n).map(|j| if i == j { Rational::ONE } else { Rational::ZERO });
            row.iter().cloned().chain(unit).collect()
        })
        .collect();
    for column in 0..n {
        let pivot = (column..n).find(|r| !rows[*r][column].is_zero())?;
        rows.swap(column, pivot);
        let scale = rows[column][column].recip()?;
        rows[column].iter_mut().for_each(|v| *v = &*v * &scale);
        for r in 0..n {
            if r != column && !rows[r][column].is_zero() {
                let factor = rows[r][column].clone();
                for k in column..2 * n {
                    rows[r][k] = &rows[r][k] - &(&factor * &rows[column][k]);
                }
            }
        }
    }
    Some(rows.into_iter().map(|row| row[n..].to_vec()).collect())
}

/// Sylvester's inertia of a symmetric matrix by exact congruence, with a kernel vector where it is degenerate.
#[must_use]
pub fn inertia(matrix: &Square) -> Inertia {
    let n = matrix.len();
    let mut form = matrix.clone();
    // Rows of `basis` are the vectors in which the form has been diagonalised so far.
    let mut basis: Square = (0..n)
        .map(|i| (0..n).map(|j| if i == j { Rational::ONE } else { Rational::ZERO }).collect())
        .collect();
    let mut result = Inertia { positive: 0, negative: 0, kernel: None };
    for k in 0..n {
        let Some(pivot) = choose_pivot(&mut form, &mut basis, k) else {
            result.kernel = Some(basis[k].clone());
            return result;
        };
        if pivot.is_negative() {
            result.negative += 1
        } else {
            result.positive += 1
        }
        let Some(scale) = pivot.recip() else { return result };
        for r in k + 1..n {
            let factor = &form[r][k] * &scale;
            if !factor.is_zero() {
                let minus = -&factor;
                combine(&mut form, r, k, &minus);
                for c in 0..n {
                    basis[r][c] = &basis[r][c] + &(&minus * &basis[k][c]);
                }
            }
        }
    }
    result
}

/// Brings a nonzero square to place `k`; `None` where the rest of the form vanishes.
fn choose_pivot(form: &mut Square, basis: &mut Square, k: usize) -> Option<Rational> {
    let n = form.len();
    if let Some(d) = (k..n).find(|d| !form[*d][*d].is_zero()) {
        swap(form, basis, k, d);
        return Some(form[k][k].clone());
    }
    // Only mixed products are left: x y = ((x + y)^2 - (x - y)^2)/4.
    let (i, j) =
        (k..n).flat_map(|i| (i + 1..n).map(move |j| (i, j))).find(|(i, j)| !form[*i][*j].is_zero())?;
    combine(form, i, j, &Rational::ONE);
    for c in 0..n {
        basis[i][c] = &basis[i][c] + &basis[j][c];
    }
    swap(form, basis, k, i);
    Some(form[k][k].clone())
}

fn swap(form: &mut Square, basis: &mut Square, i: usize, j: usize) {
    form.swap(i, j);
    form.iter_mut().for_each(|row| row.swap(i, j));
    basis.swap(i, j);
}

/// Congruence: adds `weight` times row and column `source` to row and column `target`.
fn combine(form: &mut Square, target: usize, source: usize, weight: &Rational) {
    let n = form.len();
    for c in 0..n {
        form[target][c] = &form[target][c] + &(weight * &form[source][c]);
    }
    for row in form.iter_mut() {
        row[target] = &row[target] + &(weight * &row[source]);
    }
}
