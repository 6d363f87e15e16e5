//! From a kinetic energy to Hamilton's equations; never sees tokens. One file per step.

pub mod brackets;
pub mod carried;
pub mod charts;
pub mod conserved;
pub mod constraint;
pub mod custom;
pub mod describe;
pub mod dissipation;
pub mod equations;
mod flow;
pub mod forces;
mod group_point;
pub mod hamiltonian;
pub mod hessian;
pub mod kinetic;
pub mod metric;
pub mod metrics;
pub mod mixed;
pub mod momentum_side;
mod notation;
pub mod potential;
pub mod reduce;
pub mod separation;
mod shared;
pub mod splitting;
pub mod symmetry;
pub mod two_polar;
