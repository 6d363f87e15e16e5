//! Potentials of a type of your own, see [`Potential`]; [`check_potential`](crate::sampling::check_potential) tells whether they are
//! what they say.

pub use affine_core::potential::*;
