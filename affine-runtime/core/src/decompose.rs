//! Factorisations and functions of `2x2` and `3x3` matrices.

pub(crate) mod exponential;
mod jacobi;
mod stretches;
mod two_polar;

pub use exponential::{exponential, skew_exponential};
pub use stretches::{log_stretches, principal_log_stretches, principal_stretches};
pub use two_polar::{Polar, TwoPolar, polar, two_polar};
