//! A centre of mass that moves freely: it is where it was, and `t p/m` further.

use crate::algebra::passage::{Constant, Extent, Passage, Statement, Tensor, Word};
use crate::algebra::{Arena, Polynomial};
use crate::mechanics::body::Body;
use crate::symbol::Quantity;

use super::left_out::{LeftOut, Scope};

/// `|p|^2/(2 m)`, which commutes with all that contains neither `x` nor `p`, as the internal energy does not.
#[derive(Clone, Debug)]
pub struct Drift {
    /// `1/m`.
    pub inverse_mass: Polynomial,
}

impl Drift {
    /// That of a motion whose centre of mass nothing acts on.
    pub fn of(arena: &mut Arena, body: &Body) -> Option<Self> {
        let masses = &body.motion.masses;
        let free = masses.body.is_none()
            && body.potential.is_none_or(|u| !u.moves_the_centre())
            && body.forces.leave_the_centre();
        Some(Self { inverse_mass: Polynomial::reciprocal(arena, masses.space.filter(|_| free)?)? })
    }

    /// `x0` and `p/m` are kept.
    pub(super) fn pass(passage: &mut Passage) {
        let velocity =
            Tensor::Scaled(Box::new(Tensor::Variable(Word::LinearMomentum)), Quantity::InverseMass);
        passage.inward.push(Statement::Named(Word::Drift, velocity));
        let start = Constant::new(Word::StartPosition, Extent::Vector, "Centre of mass at the start.");
        passage.constants.extend([
            start.starting(Tensor::OfPoint(Quantity::Position)),
            Constant::new(Word::Drift, Extent::Vector, "Velocity `p/m` of the centre of mass."),
        ]);
        let way = Tensor::Constant(Word::Drift).times(Tensor::Variable(Word::Elapsed));
        let place = Tensor::Constant(Word::StartPosition).plus(way);
        passage.outward.push(Statement::Named(Word::Position, place));
    }

    pub(super) fn left_out() -> LeftOut {
        Scope::Reduction.without("x and p: the centre of mass moves freely, x = x0 + t p/m")
    }
}
