//! When the straight line of a free body leaves GL+(n).

use nalgebra::{ComplexField, DimName, Matrix2, Matrix3, Schur};

use super::{Geodesic, Orbit};
use crate::frames::Matrix;
use crate::matrix::inverse;

/// Eigenvalues whose imaginary part is smaller, relative to their size, are real up to rounding: `det phi` comes as near to
/// zero as its rounding.
const REAL: f64 = 4.0 * f64::EPSILON;
/// Sweeps of the QR algorithm; ten are much for a 3 by 3 matrix.
const SWEEPS: usize = 200;

impl<const N: usize> Geodesic<N> {
    /// The first time, from `t0` towards `t_end`, at which `det phi(t) = 0`; `None` where there is none up to `t_end`.
    ///
    /// ```text
    /// det(phi0 + s phi_dot0) = 0   <=>   s = -1/lambda,   lambda a real eigenvalue of phi0^-1 phi_dot0
    /// ```
    ///
    /// Exponentials never collapse. The error is that of the eigenvalue: some roundings times the conditions of `phi0` and of
    /// the eigenvalue, so that where `det phi` touches zero without a change of sign a generic collapse is found
    /// to half the digits, and that of a symmetric `phi0^-1 phi_dot0` to all.
    #[must_use]
    pub fn collapse(&self, t_end: f64, start: &Matrix<N>) -> Option<f64> {
        let Orbit::Straight { velocity } = &self.motion else { return None };
        let rate = inverse(start) * velocity;
        if !rate.iter().all(|entry| entry.is_finite()) {
            return None;
        }
        let eigenvalues: [Option<f64>; 3] = match N {
            2 => real_in_the_plane(&Matrix2::from_fn(|i, j| rate[(i, j)])),
            3 => real_in_space(&Matrix3::from_fn(|i, j| rate[(i, j)])),
            _ => [None; 3],
        };
        let span = t_end - self.t0;
        let elapsed = eigenvalues.into_iter().flatten().map(|lambda| -1.0 / lambda);
        let within = elapsed.filter(|s| s * span > 0.0 && s.abs() <= span.abs());
        let first = within.fold(None, |first: Option<f64>, s| match first {
            Some(first) if first.abs() <= s.abs() => Some(first),
            _ => Some(s),
        });
        first.map(|s| self.t0 + s)
    }
}

/// Not generic: the QR algorithm is compiled with this crate, and not with every one that states a model.
fn real_in_the_plane(matrix: &Matrix2<f64>) -> [Option<f64>; 3] {
    real_parts(*matrix)
}

fn real_in_space(matrix: &Matrix3<f64>) -> [Option<f64>; 3] {
    real_parts(*matrix)
}

/// The real eigenvalues of a small matrix.
fn real_parts<D>(matrix: nalgebra::OMatrix<f64, D, D>) -> [Option<f64>; 3]
where
    D: DimName + nalgebra::DimSub<nalgebra::U1>,
    nalgebra::DefaultAllocator: nalgebra::allocator::Allocator<D, nalgebra::DimDiff<D, nalgebra::U1>>
        + nalgebra::allocator::Allocator<nalgebra::DimDiff<D, nalgebra::U1>>
        + nalgebra::allocator::Allocator<D, D>
        + nalgebra::allocator::Allocator<D>,
{
    let mut real = [None; 3];
    if let Some(schur) = Schur::try_new(matrix, f64::EPSILON, SWEEPS) {
        for (real, value) in real.iter_mut().zip(schur.complex_eigenvalues().iter()) {
            *real = (value.im.abs() <= REAL * value.modulus()).then_some(value.re);
        }
    }
    real
}
