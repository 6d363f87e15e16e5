//! Forces that no potential has: what they add to the equations, and what they leave as it is.

use crate::algebra::{Arena, Expr};
use crate::symbol::Quantity;

use super::charts::Chart;
use super::conserved::{Candidate, Conservation};
use super::custom::{By, Custom, Role};
use super::dissipation::Dissipation;
use super::equations::Load;
use super::hamiltonian::{Hamiltonian, Isotropic};
use super::metric::Definitions;
use super::shared::CentreVelocity;

/// The forces of a model besides those of its potential.
#[derive(Clone, Debug, Default)]
pub struct Forces {
    /// Rayleigh's function.
    pub dissipation: Option<Dissipation>,
    /// What fields of the model compute, forces and potentials.
    pub customs: Vec<Custom>,
    /// Does a potential that depends on the time stand beside them? Its power is part of `dH/dt` then.
    pub driven: bool,
    /// Is the work of that potential part of the motion, as theirs is?
    pub accounted: bool,
}

impl Forces {
    /// Are there none?
    pub fn is_empty(&self) -> bool {
        self.dissipation.is_none() && self.customs.is_empty()
    }

    /// Does any change the energy?
    pub fn do_work(&self) -> bool {
        let works = |custom: &Custom| matches!(custom.role, Role::Force { gyroscopic: false, .. });
        self.dissipation.is_some() || self.customs.iter().any(works)
    }

    /// What they add to Hamilton's equations of a chart.
    pub fn loads(&self, arena: &mut Arena, chart: &Chart, centre: &CentreVelocity) -> Vec<Load> {
        let mut loads: Vec<Load> =
            self.dissipation.iter().map(|dissipation| dissipation.load(arena, chart, centre)).collect();
        loads.extend(self.customs.iter().map(|custom| custom.load(arena, chart, centre)));
        loads
    }

    /// What they leave of what is conserved, for all momenta; `chart` is that of the model's own frame with `p` spatial, and
    /// `shared` defines its velocities. `T` is quadratic in the momenta, the forces are linear: the rates that they and the bracket
    /// with `H` give have different degrees, so that each has to vanish for itself.
    pub fn keep(
        &self,
        arena: &mut Arena,
        chart: &Chart,
        (centre, shared): (&CentreVelocity, &Definitions),
        conservation: &mut Conservation,
    ) {
        self.customs.iter().for_each(|custom| custom.keep(arena, chart, conservation));
        let Some(dissipation) = &self.dissipation else { return };
        // The forces take energy out of every motion that they act on.
        conservation.whole.retain(|candidate| *candidate != Candidate::Energy);
        let load = dissipation.load(arena, chart, centre);
        let shared = Load { shared: shared.clone(), ..Load::default() };
        conservation.under(arena, &[shared, load]);
    }

    /// Those that act where `p = 0`.
    pub fn at_rest(&self) -> Self {
        let dissipation = self.dissipation.as_ref().and_then(Dissipation::at_rest);
        Self { dissipation, ..self.clone() }
    }

    /// Does none act on the centre of mass?
    pub fn leave_the_centre(&self) -> bool {
        self.dissipation.as_ref().is_none_or(|dissipation| !dissipation.slows_the_centre())
            && self.customs.iter().all(Custom::leaves_the_centre)
    }

    /// Can any push a centre of mass that is at rest?
    pub fn push_from_rest(&self) -> bool {
        self.customs.iter().any(Custom::pushes_from_rest)
    }

    /// The time as a symbol, where a field is told it: an input of every program with forces.
    pub fn time(&self, arena: &mut Arena) -> Option<Expr> {
        let asks = self.customs.iter().any(|custom| matches!(custom.by, By::Field));
        asks.then(|| arena.symbol(Quantity::Time))
    }

    /// Do they look the same from every direction of space?
    pub fn are_isotropic_in_space(&self) -> bool {
        self.dissipation.as_ref().is_none_or(Dissipation::is_isotropic_in_space)
            && self.customs.iter().all(Custom::is_isotropic_in_space)
    }

    /// May the squared vorticity or spin of `H` be applied apart from the rest?
    pub fn commute_with_rotation(&self, chart: &Chart, h: &Hamiltonian, iso: &Isotropic) -> bool {
        self.dissipation.as_ref().is_none_or(|dissipation| dissipation.commutes_with_rotation(chart, h, iso))
            && self.customs.iter().all(|custom| custom.commutes_with_rotation(h.frame))
    }
}
