//! Where motions rest, turn, branch and diverge: `affine_runtime::analysis` against closed forms and reference values.
//!
//! What is known to 30 digits stands in `rows`, and what has an oracle of its own in the other files.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod branches;
mod duals;
mod flows;
mod forces;
mod gravity;
mod jacobian;
mod models;
mod modes;
mod relative;
mod rows;
mod stability;
