//! A force of positions alone, seen from the body.

use affine_runtime::decompose::LinearMap;
use affine_runtime::force::{Force, Motion};
use affine_runtime::frames::Body as OnBody;
use affine_runtime::frames::Matrix;
use affine_runtime::scalar::Scalar;

/// `Q_hat_AB = c (phi_1A phi_B2 + delta_AB phi_21)`, without a potential.
#[derive(Clone)]
pub(crate) struct Squeeze {
    /// `c`
    pub(crate) strength: f64,
}

impl<const N: usize> Force<N> for Squeeze {
    type Form = OnBody;
    fn force<T: Scalar>(&self, m: &Motion<N, T>) -> Matrix<N, T> {
        let c = T::constant(self.strength, 0.0);
        Matrix::<N, T>::from_fn(|a, b| {
            let twisted = m.phi[(0, a)] * m.phi[(b, 1)];
            c * if a == b { twisted + m.phi[(1, 0)] } else { twisted }
        })
    }
}

/// The same by numbers, as a force on `Pi`, row by row.
pub(crate) fn squeezed<const N: usize>(strength: f64, phi: &Matrix<N>) -> Matrix<N> {
    let along = phi.row(0).transpose() * phi.column(1).transpose();
    (along + Matrix::<N>::identity() * phi[(1, 0)]) * strength * phi.inverse()
}
