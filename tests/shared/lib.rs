//! What several tests share: charts of generated states, references from the exact oracle, drawn models, scalars that carry
//! derivatives, forces of fields, and the table of tolerances.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test that fails panics")]

pub mod charts;
pub mod drawn;
pub mod dual;
pub mod fields;
pub mod group;
pub mod jet;
pub mod models;
pub mod reference;
pub mod specimens;
pub mod tolerances;

/// The examples of the README of the workspace, compiled.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
mod readme {}

/// That of the attribute.
#[cfg(doctest)]
#[doc = include_str!("../../affine-macros/docs/attribute.md")]
mod attribute {}
