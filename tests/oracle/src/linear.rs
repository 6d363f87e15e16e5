//! Exact linear algebra for mass matrices: fraction-free elimination and Sylvester's law of inertia.

use num_bigint::{BigInt, Sign};
use num_rational::BigRational;
use num_traits::{One, Zero};

use crate::error::Error;
use crate::matrix::Matrix;

/// Numbers of positive, negative and zero squares of a quadratic form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Signature {
    /// Positive directions.
    pub positive: usize,
    /// Negative directions.
    pub negative: usize,
    /// Dimension of the kernel.
    pub zero: usize,
}

/// Integer matrix under elimination, row by row.
type Rows = Vec<Vec<BigInt>>;

fn rows(matrix: &Matrix) -> Rows {
    let columns = matrix.shape().1.max(1);
    matrix.numerators().chunks(columns).map(<[BigInt]>::to_vec).collect()
}

/// One fraction-free elimination step in the row `target` with pivot `rows[k][k]`:
/// `a_j <- (a_kk a_j - a_k a_kj)/previous`, where the division leaves no rest, since every entry is a minor
/// (Bareiss, Math. Comp. 22 (1968) 565).
fn eliminate(rows: &mut Rows, target: usize, k: usize, previous: &BigInt) {
    let factor = rows[target][k].clone();
    let pivot_row = rows[k].clone();
    for (entry, above) in rows[target].iter_mut().zip(&pivot_row) {
        let crossed = &*entry * &pivot_row[k] - &factor * above;
        *entry = crossed / previous;
    }
}

/// Gauss-Jordan elimination to `determinant * [1 | X]`; answers the determinant of the leading square block, up to the
/// sign of the row exchanges, and that sign. `None` where the block is singular.
///
/// The pivot is the shortest nonzero number of its column. In exact arithmetic any nonzero pivot is as good as
/// another, and a column without one proves singularity, so columns need not be exchanged.
fn reduce(rows: &mut Rows) -> Option<(BigInt, bool)> {
    let mut previous = BigInt::one();
    let mut odd = false;
    for k in 0..rows.len() {
        let candidates = (k..rows.len()).filter(|&i| !rows[i][k].is_zero());
        let pivot = candidates.min_by_key(|&i| rows[i][k].bits())?;
        odd ^= pivot != k;
        rows.swap(k, pivot);
        for target in (0..rows.len()).filter(|&target| target != k) {
            eliminate(rows, target, k, &previous);
        }
        previous = rows[k][k].clone();
    }
    Some((previous, odd))
}

/// The solution of `matrix X = right` for a square `matrix`; `None` where it is singular.
pub(crate) fn solve(matrix: &Matrix, right: &Matrix) -> Option<Matrix> {
    let n = matrix.shape().0;
    let width = right.shape().1;
    let mut augmented = rows(matrix);
    for (row, extra) in augmented.iter_mut().zip(rows(right)) {
        row.extend(extra);
    }
    let (mut determinant, _) = reduce(&mut augmented)?;
    // With numerators N, R over denominators d, r: X = N^-1 R d/r, and the elimination leaves det(N) N^-1 R.
    let mut scale = matrix.denominator().clone();
    if determinant.sign() == Sign::Minus {
        determinant = -determinant;
        scale = -scale;
    }
    let numerators = augmented.iter().flat_map(|row| row[n..].iter().map(|entry| entry * &scale)).collect();
    // The determinant is far larger than the denominator that remains.
    Some(Matrix::new(n, width, numerators, determinant * right.denominator()).reduced())
}

impl Matrix {
    /// `X^-1` by elimination, for matrices of any size.
    ///
    /// # Errors
    /// [`Error::SingularMass`].
    pub fn eliminated_inverse(&self) -> Result<Matrix, Error> {
        solve(self, &Matrix::identity(self.shape().0)).ok_or(Error::SingularMass)
    }

    /// The determinant of a square matrix.
    pub fn determinant(&self) -> BigRational {
        let size = self.shape().0;
        match reduce(&mut rows(self)) {
            None => BigRational::zero(),
            Some((determinant, odd)) => {
                let numerator = if odd { -determinant } else { determinant };
                let denominator = (0..size).fold(BigInt::one(), |power, _| power * self.denominator());
                BigRational::new(numerator, denominator)
            }
        }
    }

    /// The signature of a symmetric matrix, by congruences `C^T M C` (Sylvester's law of inertia).
    pub fn signature(&self) -> Signature {
        let mut form = rows(self);
        let size = form.len();
        let mut previous = BigInt::one();
        let mut signature = Signature { positive: 0, negative: 0, zero: 0 };
        for k in 0..size {
            if !bring_pivot(&mut form, k) {
                signature.zero = size - k;
                break;
            }
            // The square belonging to this pivot has the coefficient (this minor)/(previous minor).
            if form[k][k].sign() == previous.sign() {
                signature.positive += 1;
            } else {
                signature.negative += 1;
            }
            for target in k + 1..size {
                eliminate(&mut form, target, k, &previous);
            }
            previous = form[k][k].clone();
        }
        signature
    }
}

/// Brings a nonzero number to the diagonal place `k` of the remaining symmetric block by congruences; `false` where
/// the block is 0. Where the whole diagonal vanishes, `x_i -> x_i + x_j` turns `2 a_ij x_i x_j` into a square.
fn bring_pivot(form: &mut Rows, k: usize) -> bool {
    let size = form.len();
    let diagonal = (k..size).filter(|&i| !form[i][i].is_zero()).min_by_key(|&i| form[i][i].bits());
    let place = diagonal.or_else(|| {
        let pairs = (k..size).flat_map(|i| (k..i).map(move |j| (i, j)));
        let (i, j) = pairs.into_iter().find(|&(i, j)| !form[i][j].is_zero())?;
        let added = form[j].clone();
        for (entry, more) in form[i].iter_mut().zip(&added) {
            *entry += more;
        }
        for row in form.iter_mut() {
            let more = row[j].clone();
            row[i] += more;
        }
        Some(i)
    });
    let Some(place) = place else { return false };
    form.swap(k, place);
    for row in form.iter_mut() {
        row.swap(k, place);
    }
    true
}
