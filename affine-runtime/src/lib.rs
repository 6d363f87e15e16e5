//! Phase points, kinematics, integrators and reports for affinely-rigid bodies.
#![cfg_attr(not(feature = "std"), no_std)]

pub mod conserved;
pub mod error;
pub mod frames;
pub mod geodesic;
pub mod integrate;
pub mod kinematics;
pub mod model;
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
