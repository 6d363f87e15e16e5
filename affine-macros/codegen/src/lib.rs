//! Symbolic mechanics behind `#[affine_model(...)]`.

pub mod algebra;
