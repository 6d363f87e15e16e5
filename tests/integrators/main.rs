//! Integrators at the edges of what they are for: what rounding leaves, starts without a rate, forces that change faster
//! than steps, and what all that costs.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod collocation;
mod counts;
mod frames;
mod rest;
