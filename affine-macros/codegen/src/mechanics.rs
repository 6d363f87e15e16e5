//! From a kinetic energy to Hamilton's equations; never sees tokens. One file per step.

pub mod brackets;
pub mod charts;
pub mod conserved;
pub mod custom;
pub mod describe;
pub mod dissipation;
pub mod equations;
mod flow;
pub mod forces;
pub mod hamiltonian;
pub mod hessian;
pub mod kinetic;
mod notation;
pub mod potential;
pub mod reduce;
mod shared;
pub mod symmetry;
