//! Integrators of `y' = f(t, y)` for fixed-size state vectors. They know nothing of bodies, and do not allocate.

mod error_norm;
pub mod runge_kutta;
mod step_size;

pub use error_norm::ErrorNorm;
pub(crate) use error_norm::norm;
pub use runge_kutta::RungeKutta8;

use core::fmt;

/// Why an integrator cannot go on. Its last accepted state stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Failure {
    /// The right-hand side, or a step however short, gives numbers that are not finite.
    NotFinite,
    /// The error stays above the tolerance however short the step: a singularity, or a tolerance that rounding
    /// does not allow.
    StepUnderflow,
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Failure::NotFinite => "the equations of motion give numbers that are not finite",
            Failure::StepUnderflow => "the step size fell below the spacing of floating-point times",
        })
    }
}

impl core::error::Error for Failure {}

/// What an integration cost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Statistics {
    /// Accepted steps.
    pub steps: u64,
    /// Rejected steps.
    pub rejected: u64,
    /// Evaluations of the right-hand side.
    pub evaluations: u64,
}
