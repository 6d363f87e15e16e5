//! Generated code of constrained models against the oracle's multipliers, with and without forces.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "../physics/charts.rs"]
mod charts;
#[path = "../physics/dual.rs"]
mod dual;
#[allow(dead_code, reason = "the tests of physics have more of them")]
#[path = "../physics/forces/fields.rs"]
mod fields;
#[allow(dead_code, reason = "the tests of physics compare with more")]
#[path = "../physics/reference.rs"]
mod reference;
#[allow(dead_code, reason = "the table of all tests of physics")]
#[path = "../physics/tolerances.rs"]
mod tolerances;

mod confined;
#[macro_use]
mod drawn;
mod driven;
mod group;
mod metric;
mod stated;
