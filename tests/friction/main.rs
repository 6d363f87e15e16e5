//! Stiff friction: the motions of viscous bodies against references of 25 digits, by the method that runs choose.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod models;
mod motions;
mod scenes;
mod splitting;
mod units;
