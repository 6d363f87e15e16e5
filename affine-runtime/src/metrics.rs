//! Constant metrics of space and body: bases in which they are the identity.

use crate::frames::Matrix;
use crate::model::Velocity;
use crate::scalar::Real;

/// A change of the bases of space and body, `x' = A x`, `phi' = A phi B^-1`.
///
/// With `g = A^T A` and `eta = B^T B` the metrics are the identity in the new bases: `phi^T g phi` is
/// `B^T phi'^T phi' B`. Momenta follow: `p' = A^-T p`, `Sigma' = A Sigma A^-1`, `Sigma_hat' = B Sigma_hat B^-1`,
/// `Pi' = B Pi A^-1`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bases<const N: usize, T: Real = f64> {
    /// `A`.
    pub space: Matrix<N, T>,
    /// `A^-1`.
    pub space_inverse: Matrix<N, T>,
    /// `B`.
    pub body: Matrix<N, T>,
    /// `B^-1`.
    pub body_inverse: Matrix<N, T>,
}

impl<const N: usize, T: Real> Bases<N, T> {
    /// The way back.
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self {
            space: self.space_inverse,
            space_inverse: self.space,
            body: self.body_inverse,
            body_inverse: self.body,
        }
    }

    /// `phi' = A phi B^-1`.
    #[must_use]
    pub fn placement(&self, phi: &Matrix<N, T>) -> Matrix<N, T> {
        self.space * phi * self.body_inverse
    }

    /// `x_dot' = A x_dot`, `phi_dot' = A phi_dot B^-1`.
    #[must_use]
    pub fn velocity(&self, velocity: &Velocity<N, T>) -> Velocity<N, T> {
        Velocity { x_dot: self.space * velocity.x_dot, phi_dot: self.placement(&velocity.phi_dot) }
    }
}
