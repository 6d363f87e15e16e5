//! `emit(nystrom)`: motions by Runge-Kutta-Nystrom steps.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod motions;
