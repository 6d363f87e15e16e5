//! What the code of `#[affine_model(...)]` consists of: phase points, kinematics, the trait of models, and what a model may
//! have beyond it. It evaluates models, and integrates none. Users name `affine_runtime`, which has all of it.
#![cfg_attr(not(feature = "std"), no_std)]

pub mod balance;
mod breathing;
pub mod capability;
mod coefficients;
mod condition;
mod confined;
pub mod conserved;
mod constraint;
mod custom;
pub mod decompose;
mod description;
mod dissipation;
mod divisor;
mod elliptic;
pub mod error;
pub mod force;
pub mod frames;
pub mod geodesic;
mod interned;
pub mod kinematics;
pub mod lanes;
mod matrix;
mod matrix_field;
pub mod metrics;
pub mod model;
mod norm;
mod packed;
pub mod parametric;
mod parts;
pub mod potential;
mod private;
mod quantity;
mod reduction;
mod regularity;
pub mod scalar;
pub mod state;
pub mod system;
mod unprepared;
mod vectors;
mod velocity;

/// What emitted code uses besides the public traits. No stable interface: it changes with the macro.
#[doc(hidden)]
pub mod __private {
    pub use crate::private::*;
}

pub use error::{Error, Result};
pub use model::Model;
