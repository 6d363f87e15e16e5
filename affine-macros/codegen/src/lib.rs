//! Symbolic mechanics behind `#[affine_model(...)]`.
