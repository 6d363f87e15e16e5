//! Generated code of constrained models against the oracle's multipliers, with and without forces.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod confined;
mod driven;
mod metric;
mod one_energy;
mod stated;
