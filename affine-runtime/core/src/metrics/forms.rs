//! Inertias and tensors of prepared models, from the user's bases to orthonormal ones.

use crate::error::{Direction, Error, IllPosed, Result};
use crate::frames::Matrix;

/// `R J R^T`, `J` with upper indices and `R` the change of the basis that they belong to: `A` in space, `B` in the body.
pub fn rebased_inertia<const N: usize>(change: &Matrix<N>, inertia: [[f64; N]; N]) -> [[f64; N]; N] {
    let given = Matrix::<N>::from_fn(|a, b| inertia[a][b]);
    let carried = change * given * change.transpose();
    // Symmetric to the last bit.
    core::array::from_fn(|a| core::array::from_fn(|b| carried[(a.min(b), a.max(b))]))
}

/// `K'[(a,b),(c,d)] = K[(A,B),(C,D)] L[A][a] R[b][B] L[C][c] R[d][D]`, which with `O = L O' R` leaves
/// `K[(A,B),(C,D)] O[A][B] O[C][D]` as it is. `M = N^2`.
pub fn rebased_tensor<const N: usize, const M: usize>(
    left: &Matrix<N>,
    right: &Matrix<N>,
    tensor: [[f64; M]; M],
) -> [[f64; M]; M] {
    let weight =
        |entry: usize, carried: usize| left[(entry / N, carried / N)] * right[(carried % N, entry % N)];
    let half: [[f64; M]; M] = core::array::from_fn(|k| {
        core::array::from_fn(|carried| (0..M).map(|l| tensor[k][l] * weight(l, carried)).sum())
    });
    let entry = |k: usize, l: usize| (0..M).map(|whole| weight(whole, k) * half[whole][l]).sum();
    core::array::from_fn(|k| core::array::from_fn(|l| entry(k.min(l), k.max(l))))
}

/// A velocity `O'` in an error as `O = L O' R`, of unit size.
///
/// # Errors
/// That of `result`.
pub fn told_in_given_bases<const N: usize, T>(
    left: &Matrix<N>,
    right: &Matrix<N>,
    result: Result<T>,
) -> Result<T> {
    result.map_err(|error| match error {
        Error::IllPosed(defect @ IllPosed { velocity: Some(velocity), .. }) => {
            let mut carried = Matrix::<N>::zeros();
            for (a, row) in velocity.rows().enumerate() {
                row.iter().enumerate().for_each(|(b, entry)| carried[(a, b)] = f64::from(*entry));
            }
            let told = (left * carried * right).normalize();
            let velocity = Some(Direction::new(N, |entry| told[(entry / N, entry % N)]));
            Error::IllPosed(IllPosed { velocity, ..defect })
        }
        other => other,
    })
}
