//! The mechanics of generated code, through its public interface alone: against the exact oracle, against closed
//! forms, against the reference solution of the drunk missile.
//!
//! One test program for all of it, so that the models of [`families`] are expanded once.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[macro_use]
mod families;
mod integrate;
mod stated;

mod benchmarks;
mod canonical;
mod conserved;
mod driven;
mod drunk_missile;
mod forces;
mod geodesics;
mod laws;
mod mixed;
mod momentum_side;
#[macro_use]
mod potentials;
mod prepare;
mod quantities;
mod stretches;
mod undeformed;
