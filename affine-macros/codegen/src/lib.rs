//! Symbolic mechanics behind `#[affine_model(...)]`.

pub mod algebra;
pub mod ir;
pub mod mechanics;
pub mod optimise;
