//! Velocities of a body.

use crate::matrix::{Matrix, Vector};
use crate::scalar::Real;

/// Velocities of centre of mass and placement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Velocity<const N: usize, T: Real = f64> {
    /// `x_dot`; zero for a model without translation.
    pub x_dot: Vector<N, T>,
    /// `phi_dot`.
    pub phi_dot: Matrix<N, T>,
}
