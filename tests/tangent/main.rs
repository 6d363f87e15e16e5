//! `emit(tangent)`: variational equations against dual numbers, differences of motions, and closed forms.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod roots;
mod variations;
