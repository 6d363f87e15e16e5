//! Bad and extreme input, for every method: a typed refusal that names the quantity and its value, a documented clamp, or the
//! right answer. Never a panic, and never a hang: every run has a limit of steps, and every sweep a watch.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![allow(clippy::result_large_err, reason = "a stop carries the last good state")]

mod checkpoints;
mod ensembles;
mod events;
mod fields;
mod integrators;
mod intervals;
mod lattices;
mod points;
mod settings;
mod starts;
mod sweep;
