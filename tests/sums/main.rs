//! Sums of energies of different frames beside friction, forces and constraints, and the power of potentials that contain
//! the time.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod confined;
mod damped;
mod driven;
mod near_degenerate;
