//! Phase points, kinematics, integrators and reports for affinely-rigid bodies.
#![cfg_attr(not(feature = "std"), no_std)]

pub mod conserved;
#[cfg(feature = "std")]
pub mod counting;
pub mod decompose;
pub mod error;
pub mod frames;
pub mod geodesic;
pub mod integrate;
pub mod kinematics;
pub mod model;
mod reduction;
#[cfg(feature = "report")]
pub mod report;
pub mod scalar;
#[cfg(feature = "std")]
pub mod simulate;
pub mod state;

#[doc(hidden)]
#[path = "private.rs"]
pub mod __private;

pub use error::{Error, Result};
pub use model::Model;
#[cfg(feature = "std")]
pub use simulate::{Method, Simulation, Trajectory};

#[cfg(feature = "macros")]
pub use affine_macros::affine_model;

/// What a scene needs.
pub mod prelude {
    pub use crate::frames::{AffineSpin, AffineVelocity, Comoving, Matrix, Spatial, TwoPoint, Vector};
    pub use crate::kinematics::Kinematics;
    pub use crate::model::Model;
    pub use crate::state::Phase;

    #[cfg(feature = "std")]
    pub use crate::simulate::{Method, Simulation, Trajectory};

    #[cfg(feature = "macros")]
    pub use crate::affine_model;
}
