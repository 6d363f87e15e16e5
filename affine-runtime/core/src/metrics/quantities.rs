//! The configuration metric in the user's bases.

use super::Bases;
use crate::frames::Matrix;

/// The entry of `(x_dot', phi_dot')` at row `k` that `x_dot` and `phi_dot` at column `l` give, `x_dot' = A x_dot`,
/// `phi_dot' = A phi_dot B^-1`; rows and columns are those of the metric, with or without `x_dot`.
fn carried<const N: usize, const K: usize>(bases: &Bases<N>, k: usize, l: usize) -> f64 {
    let centre = K - N * N;
    match (k.checked_sub(centre), l.checked_sub(centre)) {
        (None, None) => bases.space[(k, l)],
        (Some(k), Some(l)) => bases.space[(k / N, l / N)] * bases.body_inverse[(l % N, k % N)],
        _ => 0.0,
    }
}

/// `M^T Gamma' M`, `M` from velocities in the user's bases to those in orthonormal ones.
pub fn form_in_given_bases<const N: usize, const K: usize>(bases: &Bases<N>, form: Matrix<K>) -> Matrix<K> {
    let change = Matrix::<K>::from_fn(|k, l| carried::<N, K>(bases, k, l));
    change.transpose() * form * change
}

/// `M^-1 Gamma'^-1 M^-T`.
pub fn inverse_in_given_bases<const N: usize, const K: usize>(
    bases: &Bases<N>,
    inverse: Matrix<K>,
) -> Matrix<K> {
    let back = Matrix::<K>::from_fn(|k, l| carried::<N, K>(&bases.reversed(), k, l));
    back * inverse * back.transpose()
}
