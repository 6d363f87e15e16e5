//! The two-polar form of emitted models: against the full flow, the closed form, and the paper's statements.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod closed_form;
mod models;
mod reduced_flow;
