//! Where motions rest, turn, branch and diverge.
//!
//! | you want | call |
//! |---|---|
//! | the derivative of the equations of motion | [`JacobianMatrix`] |
//! | points of rest | [`equilibrium`] |
//! | their small vibrations | [`RelativeEquilibrium::modes`] |
//! | motions that symmetries generate | [`relative_equilibrium`], [`Generator`], [`Condition`] |
//! | whether they are stable | [`RelativeEquilibrium::stability`] |
//! | how motions depend on their start | [`FlowMatrix`], [`lyapunov_spectrum`] |
//! | how they depend on fields, starts and velocities | [`Sensitivities`] |
//! | how they branch | [`Continuation`], and `branch_diagram` with the feature `report` |

mod branch;
mod continuation;
mod error;
mod field;
mod flow_matrix;
mod generator;
mod jacobian;
mod linear;
mod modes;
mod newton;
#[cfg(feature = "report")]
mod pictures;
mod relative;
mod singular;
mod spectrum;
mod stability;
mod symmetry;

pub use branch::{Branch, BranchPoint, Special};
pub use continuation::Continuation;
pub use error::AnalysisError;
pub use flow_matrix::{FlowMatrix, LyapunovSpectrum, Sensitivities, lyapunov_spectrum};
pub use generator::Generator;
pub use jacobian::JacobianMatrix;
pub use modes::{Mode, ModeClass, Modes};
#[cfg(feature = "report")]
pub use pictures::branch_diagram;
pub use relative::{Condition, RelativeEquilibrium, equilibrium, relative_equilibrium};
pub use spectrum::Eigenvalue;
pub use stability::{Doubt, Stability, StabilityVerdict};
