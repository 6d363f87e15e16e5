//! A potential `U`: its derivatives along the group, the forces in every chart, and what it leaves conserved.
//!
//! `U` is an expression in [base functions](Base) whose derivatives along the left and right action are known; the
//! chain rule does the rest. `Q_hat = -(dU/dphi)^T phi`, `Q = -phi (dU/dphi)^T`, `Q_tr = -dU/dx` (section 3).

mod assembly;
mod at_a_point;
mod axes;
mod base;
mod counting;
mod dilatation;
mod domain;
mod excess;
mod invariance;
mod load;
mod principal;
mod pulled_back;
mod restriction;
mod rewriting;
mod scaled;
mod strain;
pub mod stretches;
mod sums;
mod tensors;
mod undeformed;
mod volume;
mod writing;

use crate::algebra::substitute::listed;
use crate::algebra::vanishing::vanishes;
use crate::algebra::{Arena, Expr};
use crate::symbol::Quantity;

use super::charts::{Chart, Linear, Momentum};
use super::conserved::{Candidate, Conservation};
use super::constraint::Constraint;
pub use axes::OnAxes;
pub use base::Base;
pub use domain::{Bound, Guard};
use invariance::Evidence;
use restriction::restricted;
pub use writing::{Way, Writing};

/// A potential.
#[derive(Clone, Debug)]
#[must_use]
pub struct Potential {
    dim: usize,
    /// `U` as an expression in base functions and parameters.
    pub energy: Expr,
    slopes: Vec<(Base, Expr)>,
    /// The slopes of the same energy in another form.
    other_slopes: Option<Vec<(Base, Expr)>>,
    time: Option<Expr>,
    invariance: Evidence,
    domain: Vec<Guard>,
    /// How its forces are written beside a momentum.
    writings: Vec<(Momentum, Way)>,
}

impl Potential {
    /// The potential `energy`, an expression in base functions, parameters and numbers.
    pub fn new(arena: &mut Arena, dim: usize, energy: Expr) -> Self {
        Self::on(arena, dim, energy, None)
    }

    /// The same on the group of a constraint.
    fn on(arena: &mut Arena, dim: usize, energy: Expr, group: Option<Constraint>) -> Self {
        let slopes = Self::slopes(arena, dim, energy);
        let invariance = Evidence::new(arena, dim, &slopes, group);
        let time = arena.symbol(Quantity::Time);
        let time = arena.any_symbol(energy, &mut |symbol| symbol == time).then_some(time);
        let (domain, writings) = (Vec::new(), Vec::new());
        Self { dim, energy, slopes, other_slopes: None, time, invariance, domain, writings }
    }

    /// The same with slopes that are known from how the energy is written, in place of those that its expression has.
    pub fn with_slopes(self, arena: &Arena, slopes: Vec<(Base, Expr)>) -> Self {
        let slopes = slopes.into_iter().filter(|(_, slope)| !vanishes(arena, *slope)).collect();
        Self { slopes, ..self }
    }

    /// The same with the slopes of another expression of the energy as another way to write its forces.
    pub fn or_by(self, arena: &mut Arena, energy: Expr) -> Self {
        let other_slopes = Some(Self::slopes(arena, self.dim, energy));
        Self { other_slopes, ..self }
    }

    /// The potential on the group of a constraint, within its domain; `None` where it has no value there.
    pub fn under(
        arena: &mut Arena,
        dim: usize,
        (energy, domain): (Expr, Vec<Guard>),
        group: Constraint,
    ) -> Option<Self> {
        let energy = restricted(arena, dim, energy, group)?;
        let domain = domain::confined(arena, dim, domain, group)?;
        Some(Self::on(arena, dim, energy, Some(group)).within(domain))
    }

    /// Does it change along no velocity that the constraint leaves free?
    pub fn is_constant(&self) -> bool {
        self.keeps(Candidate::LinearMomentum) && self.keeps(Candidate::AffineSpin)
    }

    fn slopes(arena: &mut Arena, dim: usize, energy: Expr) -> Vec<(Base, Expr)> {
        let bases: Vec<(Expr, Base)> =
            Base::all(dim).into_iter().map(|base| (base.symbol(arena), base)).collect();
        let gradient = arena.gradient(energy, &|found| bases.iter().any(|(symbol, _)| *symbol == found));
        let slope = listed(&gradient);
        let slopes = bases.into_iter().filter_map(|(symbol, base)| Some((base, slope(symbol)?)));
        slopes.filter(|(_, slope)| !vanishes(arena, *slope)).collect()
    }

    /// Does it depend on the time?
    pub fn depends_on_time(&self) -> bool {
        self.time.is_some()
    }

    /// Does it depend on single stretches, through an iteration at run time?
    pub fn has_single_stretches(&self) -> bool {
        self.slopes.iter().any(|(base, _)| matches!(base, Base::LogStretch(_)))
    }

    /// The time as a symbol, where it depends on it: an input of every program with forces.
    pub fn time(&self) -> Option<Expr> {
        self.time
    }

    /// Does it depend on the position of the centre of mass?
    pub fn moves_the_centre(&self) -> bool {
        self.slopes.iter().any(|(base, _)| matches!(base, Base::Position(_)))
    }

    /// Does every motion that conserves the candidate without the potential conserve it with it? The kinetic
    /// energy is quadratic in the momenta, so that its bracket and that of the potential vanish each for itself.
    pub fn keeps(&self, candidate: Candidate) -> bool {
        if candidate == Candidate::Energy {
            return !self.depends_on_time();
        }
        self.invariance.keeps(candidate)
    }

    /// What it leaves of what is conserved: `{J, T}` is of another degree in the momenta than `{J, U}`, so that both vanish
    /// each for itself.
    pub fn keep(&self, arena: &mut Arena, conservation: &mut Conservation) {
        let chart = Chart::new(arena, self.dim, Momentum::Body, Some(Linear::Space));
        let energy = !self.depends_on_time();
        conservation.under_forces(arena, energy, &|seed| self.invariance.at(arena, &chart, seed));
    }

    /// The potential with what keeps the state within its domain.
    pub fn within(self, domain: Vec<Guard>) -> Self {
        Self { domain, ..self }
    }

    /// What keeps the state within the domain of the potential.
    pub fn domain(&self) -> &[Guard] {
        &self.domain
    }
}
