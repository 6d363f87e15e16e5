//! What the equations of a model are derived from: the kinetic energy as a quadratic form, the potential, the forces.

use crate::algebra::Arena;
use crate::symbol::Asked;

use super::forces::Forces;
use super::hessian::Hessian;
use super::kinetic::Kinetic;
use super::metrics::{Metrics, Rebased};
use super::mixed::Internal;
use super::momentum_side::Stated;
use super::potential::Potential;
use super::symmetry::Group;

/// A kinetic energy with what acts beside it.
pub struct Form {
    /// Owner of its expressions.
    pub arena: Arena,
    /// The energies that it is the sum of, each with constant coefficients in its frame; those of the internal motion first.
    pub parts: Vec<Kinetic>,
    /// The mass matrix of the internal motion.
    pub mass: Mass,
    /// Where the energy is known to be positive.
    pub positive: Positive,
    /// The Hamiltonian, where it is what the user stated; the parts follow from it.
    pub stated: Option<Stated>,
    /// The largest of GL(n), O(n) that acts on space without changing the energy.
    pub space_group: Group,
    /// Likewise for the body.
    pub body_group: Group,
    /// The potential energy.
    pub potential: Option<Potential>,
    /// The forces that no potential has, and the potentials that fields compute.
    pub forces: Forces,
    /// Are the placements those of U(n)?
    pub unitary: bool,
    /// Metrics other than the identity; everything else stands in bases in which they are.
    pub metrics: Option<Metrics>,
    /// Matrices that are carried to these bases when the model is prepared.
    pub rebased: Vec<Rebased>,
    /// What is asked for besides its equations.
    pub asked: Asked,
}

/// A mass matrix on a basis of the admissible velocities.
pub enum Mass {
    /// Constant in one frame, or `D^2` times such a matrix.
    Constant(Hessian),
    /// It depends on the placement, and is factorised.
    Factorised(Box<Internal>),
}

impl Mass {
    /// The constant one.
    pub fn constant(&self) -> Option<&Hessian> {
        match self {
            Self::Constant(hessian) => Some(hessian),
            Self::Factorised(_) => None,
        }
    }
}

/// What is positive definite whatever the placement; undecided counts as not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Positive {
    /// The internal energy.
    pub internal: bool,
    /// The translational energy; one that does not exist is.
    pub centre: bool,
}
