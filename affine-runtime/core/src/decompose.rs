//! Factorisations and functions of `2x2` and `3x3` matrices, which `affine_runtime` has as methods.

pub(crate) mod exponential;
mod jacobi;
mod stretches;
mod two_polar;

pub use crate::kinematics::deformation::characteristic_invariants;
pub use crate::kinematics::dilatation::{dilatation, isochoric_part, mean_log_stretch};
pub use crate::matrix::inverse;
pub use exponential::{exponential, skew_exponential};
pub use stretches::{log_stretches, principal_log_stretches, principal_stretches};
pub use two_polar::{Polar, TwoPolar};
