//! Every pair that the table accepts: one model with all that may be emitted, with numbers of its own, and the values of each
//! capability against the oracle, which has the energy stated a second time.
#![allow(
    missing_docs,
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::cast_possible_truncation
)]

mod body;
mod canonical;
mod capabilities;
mod case;
mod forms;
mod lattice;
mod law;
mod lists;
mod runs;
mod squeeze;
mod stretched;
mod subject;

use subject::Subject;

include!(concat!(env!("OUT_DIR"), "/subjects.rs"));
