//! From a kinetic energy to Hamilton's equations; never sees tokens. One file per step.

pub mod asked;
pub mod balance;
pub mod brackets;
pub mod carried;
pub mod charts;
pub mod conserved;
pub mod constraint;
pub mod custom;
pub mod describe;
pub mod direction;
pub mod dissipation;
pub mod equations;
mod flow;
pub mod forces;
pub mod form;
mod group_point;
pub mod hamiltonian;
pub mod hessian;
pub mod kinetic;
pub mod kinetics;
pub mod loads;
pub mod metric;
pub mod metrics;
pub mod mixed;
pub mod momentum_side;
pub mod notation;
pub mod potential;

pub mod reduce;
pub mod second_order;
pub mod separation;
pub mod shared;
pub mod splitting;
pub mod symmetry;
pub mod term;
pub mod two_polar;
pub mod weight;
