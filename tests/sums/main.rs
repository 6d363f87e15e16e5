//! Sums of energies of different frames beside friction, forces and constraints, and the power of potentials that contain
//! the time.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "../physics/charts.rs"]
mod charts;
#[macro_use]
#[path = "../constraints/drawn.rs"]
mod drawn;
#[path = "../physics/dual.rs"]
mod dual;
#[allow(dead_code, reason = "the tests of physics have more of them")]
#[path = "../physics/forces/fields.rs"]
mod fields;
#[allow(dead_code, reason = "the tests of constraints compare with more")]
#[path = "../constraints/group.rs"]
mod group;
#[allow(dead_code, reason = "the tests of physics compare with more")]
#[path = "../physics/reference.rs"]
mod reference;
#[allow(dead_code, reason = "the table of all tests of physics")]
#[path = "../physics/tolerances.rs"]
mod tolerances;

mod confined;
mod damped;
mod driven;
mod near_degenerate;
