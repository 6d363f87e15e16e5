//! Carlson's integrals, and `self_gravity`, the energy of a homogeneous ellipsoid in its own gravity.
#![cfg(feature = "double-double")]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod energy;
mod integrals;
