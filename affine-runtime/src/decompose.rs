//! Factorisations and functions of `2x2` and `3x3` matrices.

mod exponential;
mod stretches;

pub use exponential::{exponential, skew_exponential};
pub use stretches::{log_stretches, principal_stretches};
