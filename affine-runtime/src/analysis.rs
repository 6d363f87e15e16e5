//! Where motions rest, turn, branch and diverge.
//!
//! | you want | call |
//! |---|---|
//! | the derivative of the equations of motion | [`JacobianMatrix`] |
//! | points of rest | [`equilibrium`] |
//! | motions that symmetries generate | [`relative_equilibrium`], [`Generator`], [`Condition`] |
//! | whether they are stable | [`RelativeEquilibrium::stability`] |

mod elimination;
mod error;
mod field;
mod generator;
mod jacobian;
mod linear;
mod newton;
mod rates;
mod relative;
mod spectrum;
mod stability;
mod tape;

pub use error::AnalysisError;
pub use generator::Generator;
pub use jacobian::JacobianMatrix;
pub use relative::{Condition, RelativeEquilibrium, equilibrium, relative_equilibrium};
pub use spectrum::Eigenvalue;
pub use stability::{Doubt, Stability, StabilityVerdict};
