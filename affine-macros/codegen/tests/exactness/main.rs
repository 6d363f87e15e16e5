//! Everything between a specification and its programs, in exact rational arithmetic or modulo a prime: nothing here has a
//! tolerance.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod brackets;
mod components;
mod conservation;
mod derivation;
mod expansion;
mod expressions;
mod fields;
mod in_vectors;
mod inertia;
mod kernels;
mod linear;
mod metrics;
mod mixed;
mod models;
mod packed;
mod passes;
mod points;
mod polynomials;
mod potentials;
mod rational;
mod reduction;
mod rounding;
mod sharing;
mod singular;
mod symmetry;
mod tensors;
