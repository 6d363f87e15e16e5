#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used, clippy::panic)]
mod reduced_flow;
#[path = "../lattice/ratios.rs"]
mod ratios;
#[path = "../lattice/splitting.rs"]
mod splitting;
