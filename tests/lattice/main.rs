//! The two-polar form of emitted models: against the full flow, the closed form, and the paper's statements.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod classification;
mod closed_form;
mod confinement;
mod far_away;
#[allow(
    dead_code,
    reason = "every model has constructors for momenta and for velocities; not all are called"
)]
mod models;
mod ratios;
mod reduced_flow;
mod splitting;
mod sutherland;
mod unitary;
