//! Factorisations and functions of `2x2` and `3x3` matrices.

mod exponential;

pub use exponential::{exponential, skew_exponential};
