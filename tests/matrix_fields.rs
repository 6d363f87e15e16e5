//! Matrices that are known when the model is prepared: fields of matrix type as inertias, tensors and metrics.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "matrix_fields/literals.rs"]
mod literals;
#[path = "matrix_fields/metrics.rs"]
mod metrics;
#[path = "matrix_fields/prepare.rs"]
mod prepare;
