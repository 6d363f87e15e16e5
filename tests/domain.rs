//! Runs that leave the states at which their potential has a value, or lose their energy, end typed.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "domain/centre.rs"]
mod centre;
#[path = "domain/collapse.rs"]
mod collapse;
#[path = "domain/energies.rs"]
mod energies;
#[path = "domain/far_away.rs"]
mod far_away;
#[path = "domain/listed.rs"]
mod listed;
#[path = "domain/singular.rs"]
mod singular;
#[path = "domain/small.rs"]
mod small;
#[path = "domain/stretched.rs"]
mod stretched;
#[path = "domain/time.rs"]
mod time;
#[path = "domain/walls.rs"]
mod walls;
