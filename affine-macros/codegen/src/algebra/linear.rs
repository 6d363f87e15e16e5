//! Small matrices over exact rationals: inverse, inertia, kernel.
//!
//! Elimination works on whole numbers over one denominator and stays free of fractions (Bareiss, Math. Comp. 22
//! (1968) 565): greatest common divisors are what exact arithmetic spends its time on.

use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

use super::rational::Rational;

/// A square matrix, row after row.
pub type Square = Vec<Vec<Rational>>;

/// Sylvester's inertia of a symmetric form.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Inertia {
    /// Number of positive squares.
    pub positive: usize,
    /// Number of negative squares.
    pub negative: usize,
    /// A vector of the kernel, if the form is degenerate.
    pub kernel: Option<Vec<Rational>>,
}

/// Whole numbers, row after row.
type Whole = Vec<Vec<BigInt>>;

/// The matrix as whole numbers over one positive denominator.
fn whole(matrix: &Square) -> (Whole, BigInt) {
    let mut denominator = BigInt::one();
    for value in matrix.iter().flatten() {
        let (_, below) = value.parts();
        if !(&denominator % &below).is_zero() {
            denominator *= below;
        }
    }
    let over = |value: &Rational| {
        let (above, below) = value.parts();
        above * (&denominator / below)
    };
    (matrix.iter().map(|row| row.iter().map(over).collect()).collect(), denominator)
}

/// `row <- (pivot row - row[k] pivot_row)/previous`, exactly: every entry is a minor of the matrix.
fn eliminate(rows: &mut Whole, target: usize, k: usize, previous: &BigInt) {
    let pivot_row = rows[k].clone();
    let factor = rows[target][k].clone();
    for (value, above) in rows[target].iter_mut().zip(&pivot_row) {
        *value = (&*value * &pivot_row[k] - &factor * above) / previous;
    }
}

/// Inverse by Gauss-Jordan elimination; `None` where the matrix is singular.
pub fn inverse(matrix: &Square) -> Option<Square> {
    let n = matrix.len();
    let (mut rows, denominator) = whole(matrix);
    for (i, row) in rows.iter_mut().enumerate() {
        row.extend((0..n).map(|j| if i == j { denominator.clone() } else { BigInt::zero() }));
    }
    let mut previous = BigInt::one();
    for k in 0..n {
        let pivot = (k..n).find(|r| !rows[*r][k].is_zero())?;
        rows.swap(k, pivot);
        for target in (0..n).filter(|target| *target != k) {
            eliminate(&mut rows, target, k, &previous);
        }
        previous = rows[k][k].clone();
    }
    // [det 1 | det M^-1 d]
    let entry = |value: &BigInt| Rational::quotient(value.clone(), previous.clone());
    rows.iter().map(|row| row[n..].iter().map(entry).collect()).collect()
}

/// Sylvester's inertia of a symmetric matrix by exact congruences, with a kernel vector where it is degenerate.
pub fn inertia(matrix: &Square) -> Inertia {
    let n = matrix.len();
    let (mut form, _) = whole(matrix);
    let mut result = Inertia { positive: 0, negative: 0, kernel: None };
    let mut previous = BigInt::one();
    for k in 0..n {
        if !bring_pivot(&mut form, k) {
            result.kernel = kernel(matrix);
            return result;
        }
        // The square of this pivot has the sign of the quotient of two leading minors.
        if form[k][k].is_negative() == previous.is_negative() {
            result.positive += 1;
        } else {
            result.negative += 1;
        }
        for target in k + 1..n {
            eliminate(&mut form, target, k, &previous);
        }
        previous = form[k][k].clone();
    }
    result
}

/// Brings a nonzero square to place `k` by congruences; `false` where the rest of the form vanishes.
fn bring_pivot(form: &mut Whole, k: usize) -> bool {
    let n = form.len();
    let square = (k..n).find(|d| !form[*d][*d].is_zero());
    let mixed =
        || (k..n).flat_map(|i| (i + 1..n).map(move |j| (i, j))).find(|(i, j)| !form[*i][*j].is_zero());
    let place = match (square, square.is_none().then(mixed).flatten()) {
        (Some(d), _) => d,
        // Only mixed products are left: x y is made a square by x -> x + y.
        (None, Some((i, j))) => {
            let row = form[j].clone();
            form[i].iter_mut().zip(&row).for_each(|(value, more)| *value += more);
            for row in form.iter_mut() {
                let more = row[j].clone();
                row[i] += more;
            }
            i
        }
        (None, None) => return false,
    };
    form.swap(k, place);
    form.iter_mut().for_each(|row| row.swap(k, place));
    true
}

/// A vector on which a symmetric form is negative; `None` where the form is positive semidefinite. Congruences by
/// positive squares, whose basis vectors are followed along.
pub fn negative_direction(matrix: &Square) -> Option<Vec<Rational>> {
    let n = matrix.len();
    let mut form = matrix.clone();
    let unit = |i: usize| (0..n).map(|j| if i == j { Rational::ONE } else { Rational::ZERO }).collect();
    let mut basis: Vec<Vec<Rational>> = (0..n).map(unit).collect();
    let mut open: Vec<usize> = (0..n).collect();
    loop {
        if let Some(k) = open.iter().find(|k| form[**k][**k].is_negative()) {
            return Some(basis[*k].clone());
        }
        let Some(k) = open.iter().copied().find(|k| !form[*k][*k].is_zero()) else { break };
        open.retain(|other| *other != k);
        let reciprocal = form[k][k].recip()?;
        for &j in &open {
            let factor = &form[k][j] * &reciprocal;
            if factor.is_zero() {
                continue;
            }
            basis[j] = combined(&basis[j], &-&factor, &basis[k]);
            let pivot_row = form[k].clone();
            for &l in &open {
                form[j][l] = &form[j][l] - &(&factor * &pivot_row[l]);
            }
        }
    }
    // No squares are left: along e_i - a_ij e_j the form is -2 a_ij^2.
    for &i in &open {
        for &j in &open {
            if !form[i][j].is_zero() {
                return Some(combined(&basis[i], &-&form[i][j], &basis[j]));
            }
        }
    }
    None
}

/// `a + weight b`.
fn combined(a: &[Rational], weight: &Rational, b: &[Rational]) -> Vec<Rational> {
    a.iter().zip(b).map(|(a, b)| a + &(weight * b)).collect()
}

/// A vector that a singular matrix maps to zero.
fn kernel(matrix: &Square) -> Option<Vec<Rational>> {
    let n = matrix.len();
    let mut rows = matrix.clone();
    let mut pivots: Vec<usize> = Vec::new();
    for column in 0..n {
        let top = pivots.len();
        let Some(pivot) = (top..n).find(|r| !rows[*r][column].is_zero()) else {
            // The first column that depends on those before it.
            let mut vector = vec![Rational::ZERO; n];
            vector[column] = Rational::ONE;
            pivots.iter().zip(&rows).for_each(|(p, row)| vector[*p] = -&row[column]);
            return Some(vector);
        };
        rows.swap(top, pivot);
        let scale = rows[top][column].recip()?;
        rows[top].iter_mut().for_each(|value| *value = &*value * &scale);
        let pivot_row = rows[top].clone();
        for (_, row) in rows.iter_mut().enumerate().filter(|(r, _)| *r != top) {
            let factor = row[column].clone();
            for (value, above) in row.iter_mut().zip(&pivot_row) {
                *value = &*value - &(&factor * above);
            }
        }
        pivots.push(column);
    }
    None
}
