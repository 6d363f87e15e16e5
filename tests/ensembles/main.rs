//! Emitted models in lanes, as ensembles and on their way to events.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod events;
mod fast;
mod frames;
mod lanes;
mod models;
mod outcomes;
mod read_back;
mod saved;
mod saved_runs;
mod shards;
mod starts;
mod sweeps;
mod tables;
mod watched;
mod written_numbers;
