//! RATTLE: orders, constraints, momentum maps, symplecticity, refusals; self-gravitating ellipsoids.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod body;
mod ellipsoids;
mod gravity;
mod invariants;
mod order;
mod refusals;
