//! Forces of a type of your own, see [`Force`]; [`check_force`](crate::sampling::check_force) tells whether they are what they say.

mod at_point;

pub use affine_core::force::*;
pub use at_point::{AtPoint, PointForce};
