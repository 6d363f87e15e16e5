//! The flow of a dilatation that has a closed form.

use affine_core::__private::Breathing;
use affine_core::decompose::mean_log_stretch;
use affine_core::frames::Matrix;
use affine_core::scalar::Real;

/// `(e^(q1 - q) - 1, (p1 - p)/N)`, by which a placement grows and the diagonal of its affine momentum rises, from `q` of
/// the placement and `p` the sum of the affine spin's `diagonal` along their `motion`, a function of its start, for the time `h`.
#[inline]
#[must_use]
pub fn dilated<const N: usize, T: Real>(
    phi: [[T; N]; N],
    diagonal: [T; N],
    h: T,
    motion: impl FnOnce(T, T, T) -> Breathing<T>,
) -> (T, T) {
    let q = mean_log_stretch(&Matrix::<N, T>::from_fn(|i, j| phi[i][j]));
    let mut p = T::zero();
    for entry in diagonal {
        p += entry;
    }
    let (q1, p1) = motion(T::zero(), q, p).at(h);
    ((q1 - q).exp_m1(), (p1 - p) / T::from_f64(N as f64))
}
