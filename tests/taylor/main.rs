//! `emit(taylor)`: coefficients against truncated power series, motions against reference solutions.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod coefficients;
mod gaps;
mod motions;
