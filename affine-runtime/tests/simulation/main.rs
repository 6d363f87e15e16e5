//! Simulations from start to end, on models written by hand.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod accuracy;
mod constraints;
mod dense;
mod events;
mod gauss;
mod halts;
mod models;
mod outputs;
mod reference;
mod reports;
mod resuming;
mod round_trips;
mod small_motions;
