//! `emit(nystrom)`: motions by Runge-Kutta-Nystrom steps.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
// The lint takes products in emitted arrays, whose tokens share one place in the source, for forgotten commas.
#![allow(clippy::possible_missing_comma)]

mod motions;
