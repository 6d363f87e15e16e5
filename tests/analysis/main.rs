//! Where motions rest, turn, branch and diverge: `affine_runtime::analysis` against closed forms and reference values.
//!
//! Where a number has a comment "row", it stands in the reference values that were computed in 60 digits by two routes, closed
//! forms or Hessian blocks on one side and spectra of Jacobians on the other.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod branches;
mod flows;
mod jacobian;
mod models;
mod modes;
mod relative;
mod stability;
