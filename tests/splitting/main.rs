//! `emit(splitting)`: flows of pieces against the equations of motion, motions against reference solutions.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod adaptive;
mod anisotropic;
mod confined;
mod fields;
mod models;
mod motions;
mod not_emitted;
mod pieces;
mod together;
