//! Inertias and tensors of prepared models, from the user's bases to orthonormal ones.

use crate::error::{Error, IllPosed, Result, UnitVelocity};
use crate::frames::Matrix;
use crate::scalar::{Real, Scalar};

/// `R J R^T`, `J` with upper indices and `R` the change of the basis that they belong to: `A` in space, `B` in the body.
pub fn rebased_inertia<const N: usize, T: Scalar>(
    change: &Matrix<N, T>,
    inertia: [[T; N]; N],
) -> [[T; N]; N] {
    let given = Matrix::<N, T>::from_fn(|a, b| inertia[a][b]);
    let carried = change * given * change.transpose();
    // Symmetric to the last bit.
    core::array::from_fn(|a| core::array::from_fn(|b| carried[(a.min(b), a.max(b))]))
}

/// `K'[(a,b),(c,d)] = K[(A,B),(C,D)] L[A][a] R[b][B] L[C][c] R[d][D]`, which with `O = L O' R` leaves
/// `K[(A,B),(C,D)] O[A][B] O[C][D]` as it is. `M = N^2`.
pub fn rebased_tensor<const N: usize, const M: usize, T: Scalar>(
    left: &Matrix<N, T>,
    right: &Matrix<N, T>,
    tensor: [[T; M]; M],
) -> [[T; M]; M] {
    let weight =
        |entry: usize, carried: usize| left[(entry / N, carried / N)] * right[(carried % N, entry % N)];
    let half: [[T; M]; M] = core::array::from_fn(|k| {
        core::array::from_fn(|carried| {
            (0..M).fold(T::zero(), |sum, l| sum + tensor[k][l] * weight(l, carried))
        })
    });
    let entry = |k: usize, l: usize| (0..M).fold(T::zero(), |sum, m| sum + weight(m, k) * half[m][l]);
    core::array::from_fn(|k| core::array::from_fn(|l| entry(k.min(l), k.max(l))))
}

/// A velocity `O'` in an error as `O = L O' R`, of unit size.
///
/// # Errors
/// That of `result`.
pub fn told_in_given_bases<const N: usize, T: Real, R>(
    left: &Matrix<N, T>,
    right: &Matrix<N, T>,
    result: Result<R>,
) -> Result<R> {
    let [left, right] = [left, right].map(|matrix| matrix.map(Real::to_f64));
    result.map_err(|error| match error {
        Error::IllPosed(defect @ IllPosed { velocity: Some(velocity), .. }) => {
            let mut carried = Matrix::<N>::zeros();
            for (a, row) in velocity.rows().enumerate() {
                row.iter().enumerate().for_each(|(b, entry)| carried[(a, b)] = f64::from(*entry));
            }
            let told = (left * carried * right).normalize();
            let velocity = Some(UnitVelocity::new(N, |entry| told[(entry / N, entry % N)]));
            Error::IllPosed(IllPosed { velocity, ..defect })
        }
        other => other,
    })
}
