//! The mechanics of generated code, through its public interface alone: against the exact oracle, against closed
//! forms, against the reference solution of the drunk missile.
//!
//! One test program for all of it, so that the models of [`families`] are expanded once.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod charts;
#[macro_use]
mod families;
mod dual;
mod integrate;
#[allow(dead_code, reason = "the tests of constraints compare with more")]
mod reference;
mod stated;
#[allow(dead_code, reason = "one table for the tests of constraints as well")]
mod tolerances;

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
