//! What the equations of a model are derived from: the kinetic energy as a quadratic form, the potential, the forces.

use crate::algebra::Arena;

use super::asked::Asked;
use super::forces::Forces;
use super::hessian::{Block, Hessian};
use super::kinetic::Kinetic;
use super::metrics::{Metrics, Rebased};
use super::mixed::Mixed;
use super::momentum_side::Stated;
use super::potential::Potential;
use super::symmetry::Group;

/// A kinetic energy with what acts beside it.
pub enum Energy {
    /// Its mass matrix is constant in one frame.
    Constant(Box<Form>),
    /// Its mass matrix depends on the placement.
    Mixed(Box<MixedForm>),
}

impl From<Form> for Energy {
    fn from(form: Form) -> Self {
        Self::Constant(Box::new(form))
    }
}

/// A kinetic energy whose mass matrix is constant in one frame.
pub struct Form {
    /// Owner of its expressions.
    pub arena: Arena,
    /// The energy.
    pub kinetic: Kinetic,
    /// The Hamiltonian, where it is what the user stated; `kinetic` follows from it.
    pub stated: Option<Stated>,
    /// Its Hessian on the affine velocities.
    pub hessian: Hessian,
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

impl Form {
    /// The numbers of positive and negative squares of a numeric self.
    #[must_use]
    pub fn signature(&self) -> Option<(usize, usize)> {
        // With a cubic term the metric depends on the momentum.
        if self.stated.as_ref().is_some_and(Stated::is_cubic) {
            return None;
        }
        let mut count = (0, 0);
        for inertia in self.hessian.blocks.iter().map(|b: &Block| b.inertia(self.kinetic.dim)) {
            let inertia = inertia?;
            count.0 += inertia.positive;
            count.1 += inertia.negative;
        }
        if let Some(t) = self.kinetic.translation {
            let mass = self.arena.as_constant(t.mass)?;
            match mass.is_negative() {
                true => count.1 += self.kinetic.dim,
                false => count.0 += self.kinetic.dim,
            }
        }
        Some(count)
    }
}

/// A sum of energies of different frames.
pub struct MixedForm {
    /// Owner of its expressions.
    pub arena: Arena,
    /// The energy.
    pub mixed: Mixed,
    /// Hessian of the internal energy, where all of that has one frame.
    pub hessian: Option<Hessian>,
    /// Where it is positive whatever the placement.
    pub positive: Positive,
    /// The largest of GL(n), O(n) that acts on space without changing the energy.
    pub space_group: Group,
    /// Likewise for the body.
    pub body_group: Group,
    /// The potential energy.
    pub potential: Option<Potential>,
    /// The forces that no potential has, and the potentials that fields compute.
    pub forces: Forces,
    /// What is asked for besides its equations.
    pub asked: Asked,
}

/// What is positive definite whatever the placement; undecided counts as not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Positive {
    /// The internal energy.
    pub internal: bool,
    /// The translational energy; one that does not exist is.
    pub centre: bool,
}
