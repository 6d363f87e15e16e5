//! What emitted code uses besides the public traits. No stable interface: it changes with the macro.

pub use core::primitive::f64;

pub use crate::custom::{
    comoving_force, potential_energy, potential_slopes, spatial_force, translational_force,
};
pub use crate::decompose::{log_stretches, principal_stretches, skew_exponential};
pub use crate::dissipation::{semidefinite, semidefinite_form};
pub use crate::error::Result;
pub use crate::frames::{
    Body, Canonical, Comoving, Matrix, Momentum, Space, Spatial, TwoPoint, Vector, inverse,
};
pub use crate::geodesic::{Geodesic, Motion};
pub use crate::kinematics::mean_log_stretch;
pub use crate::model::{Conserved, Description, Formula, Group, Model, Operations, Velocity};
pub use crate::reduction::{
    Condition, finite, inverse_form, total_affine_momentum, total_size, turn, well_posed,
};
pub use crate::scalar::{Real, Scalar};
pub use crate::state::{Centre, Phase, PhasePoint, Pinned};

use crate::frames::Frame;
use crate::state::Translation;

/// The phase point with placement `phi`, a momentum given in any frame, and `centre`.
///
/// # Errors
/// [`Error::Placement`](crate::Error::Placement) unless `phi` is finite and `det phi > 0`;
/// [`Error::NotFinite`](crate::Error::NotFinite) with the name of the momentum, `x` or `p` that is not finite.
pub fn phase_point<const N: usize, F: Frame, C: Translation<N, T>, T: Real>(
    phi: Matrix<N, T>,
    momentum: impl Momentum<N, T>,
    centre: C,
) -> Result<PhasePoint<N, F, C, T>> {
    PhasePoint::checked(phi, momentum, centre)
}

/// The same point, unchecked: integrators watch over their states themselves.
pub fn point<const N: usize, F: Frame, C: Translation<N, T>, T: Real>(
    phi: Matrix<N, T>,
    momentum: impl Momentum<N, T>,
    centre: C,
) -> PhasePoint<N, F, C, T> {
    PhasePoint::with_momentum(phi, momentum, centre)
}

/// The rows of a matrix.
pub fn rows<const N: usize, T: Real>(matrix: &Matrix<N, T>) -> [[T; N]; N] {
    core::array::from_fn(|i| core::array::from_fn(|j| matrix[(i, j)]))
}

/// The matrix with the given rows.
pub fn matrix<const N: usize, T: Real>(rows: [[T; N]; N]) -> Matrix<N, T> {
    Matrix::from_fn(|i, j| rows[i][j])
}

/// The components of a vector.
pub fn components<const N: usize, T: Real>(vector: &Vector<N, T>) -> [T; N] {
    core::array::from_fn(|i| vector[i])
}

/// The vector with the given components.
pub fn vector<const N: usize, T: Real>(components: [T; N]) -> Vector<N, T> {
    Vector::from(components)
}
