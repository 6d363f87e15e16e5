//! Affine and translational velocities between the frames, and their dilatation and shear.

use super::dilatation::{deviator, integer};
use crate::frames::{AffineVelocity, Comoving, Matrix, Spatial, TwoPoint, Vector};
use crate::matrix::inverse;
use crate::scalar::Real;

/// Translational velocity: `x_dot` in space, `v_hat = phi^-1 x_dot` in the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearVelocity<const N: usize, T = f64>(pub Vector<N, T>);

impl<const N: usize, T: Real> TwoPoint<AffineVelocity<N, T>> {
    /// `Omega = phi_dot phi^-1`.
    pub fn spatial(&self, phi: &Matrix<N, T>) -> Spatial<AffineVelocity<N, T>> {
        Spatial(AffineVelocity(self.0.0 * inverse(phi)))
    }
    /// `Omega_hat = phi^-1 phi_dot`.
    pub fn comoving(&self, phi: &Matrix<N, T>) -> Comoving<AffineVelocity<N, T>> {
        Comoving(AffineVelocity(inverse(phi) * self.0.0))
    }
}

impl<const N: usize, T: Real> Spatial<AffineVelocity<N, T>> {
    /// `Omega_hat = phi^-1 Omega phi`.
    pub fn comoving(&self, phi: &Matrix<N, T>) -> Comoving<AffineVelocity<N, T>> {
        Comoving(AffineVelocity(inverse(phi) * self.0.0 * phi))
    }
    /// `phi_dot = Omega phi`.
    pub fn two_point(&self, phi: &Matrix<N, T>) -> TwoPoint<AffineVelocity<N, T>> {
        TwoPoint(AffineVelocity(self.0.0 * phi))
    }
}

impl<const N: usize, T: Real> Comoving<AffineVelocity<N, T>> {
    /// `Omega = phi Omega_hat phi^-1`.
    pub fn spatial(&self, phi: &Matrix<N, T>) -> Spatial<AffineVelocity<N, T>> {
        Spatial(AffineVelocity(phi * self.0.0 * inverse(phi)))
    }
    /// `phi_dot = phi Omega_hat`.
    pub fn two_point(&self, phi: &Matrix<N, T>) -> TwoPoint<AffineVelocity<N, T>> {
        TwoPoint(AffineVelocity(phi * self.0.0))
    }
}

impl<const N: usize, T: Real> Spatial<LinearVelocity<N, T>> {
    /// `v_hat = phi^-1 x_dot`.
    pub fn comoving(&self, phi: &Matrix<N, T>) -> Comoving<LinearVelocity<N, T>> {
        Comoving(LinearVelocity(inverse(phi) * self.0.0))
    }
}

impl<const N: usize, T: Real> Comoving<LinearVelocity<N, T>> {
    /// `x_dot = phi v_hat`.
    pub fn spatial(&self, phi: &Matrix<N, T>) -> Spatial<LinearVelocity<N, T>> {
        Spatial(LinearVelocity(phi * self.0.0))
    }
}

/// Dilatation and shear exist in space and in the body; `phi_dot` has no trace.
macro_rules! dilatation_and_shear {
    ($frame:ident) => {
        impl<const N: usize, T: Real> $frame<AffineVelocity<N, T>> {
            /// Rate of the mean log-stretch `q_dot = tr Omega / n = tr Omega_hat / n`.
            pub fn dilatation_rate(&self) -> T {
                self.0.0.trace() / integer(N)
            }
            /// Shear velocity, the traceless part `omega = Omega - q_dot 1` in the same frame.
            #[must_use]
            pub fn deviator(&self) -> Self {
                $frame(AffineVelocity(deviator(&self.0.0)))
            }
        }
    };
}

dilatation_and_shear!(Spatial);
dilatation_and_shear!(Comoving);
