//! Where motions rest, turn, branch and diverge: `affine_runtime::analysis` against closed forms and reference values.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod jacobian;
