//! Kinematic quantities of a phase point.

mod dilatation;

pub(crate) use dilatation::LogDeterminant;
pub use dilatation::{dilatation, isochoric_part, mean_log_stretch};
