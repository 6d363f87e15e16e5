//! What has to be integrated: commuting pieces of `H` with exact flows are split off, conserved momenta leave the
//! state, space is turned so that `p` has one component.

use crate::algebra::{Arena, Expr, Polynomial, Rational};

use super::brackets::poisson;
use super::carried::{Carried, carrying_the_dilatation};
use super::charts::{Chart, Coordinate, Linear, Momentum};
use super::conserved::Candidate;
use super::equations::{Form, Load, System};
use super::forces::Forces;
use super::hamiltonian::{Hamiltonian, spatial_or_own};
use super::kinetics::Kinetics;
use super::loads::{loads, of_potential};
use super::potential::Potential;
use super::separation::{Separation, shear_system};
use super::term::Frame;
use crate::symbol::Quantity;

/// A piece of `H` that commutes with the rest and whose flow is known.
#[derive(Clone, Debug)]
pub enum Commuting {
    /// `|Vort|^2/(2 mu)`: `phi -> phi exp(-t Vort/mu)`.
    Vorticity(Polynomial),
    /// `|S|^2/(2 mu)`: `phi -> exp(-t S/mu) phi`.
    Spin(Polynomial),
    /// `|p|^2/(2 m)`: `x -> x + t p/m`.
    Drift(Polynomial),
}

/// How the affine momentum of the reduced chart enters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// All of it is conserved: a constant of the trajectory.
    Constant,
    /// All entries are state.
    Entries,
}

/// A reduced system.
#[derive(Clone, Debug)]
pub struct Reduction {
    /// Its chart.
    pub chart: Chart,
    /// What was split off.
    pub commuting: Vec<Commuting>,
    /// Space is turned so that `p = (|p|, 0, 0)`, and `I(O)_13 = 0` where `I(O)` is constant.
    pub turned: bool,
    /// How the affine momentum enters.
    pub layout: Layout,
    /// Components of the affine momentum that are conserved while others are state, in turned space.
    pub fixed: Vec<Expr>,
    /// The dilatation, where it is taken out of the state: the system is then that of `Psi` and `sigma/alpha`.
    pub separation: Option<Separation>,
    /// `1/D = (det phi)^(-1/n)` and `q` where they are state, so that no right-hand side takes a root or a logarithm.
    pub carried: Vec<Carried>,
    /// The equations of the state variables.
    pub system: System,
    /// State variables: group name and symbols.
    pub states: Vec<(Quantity, Vec<Expr>)>,
}

/// Closed-form motions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ClosedForm {
    /// `phi0 exp(tX) exp(tW)`
    Body,
    /// `exp(tW) exp(tX) phi0`
    Space,
    /// `phi0 + t phi_dot0`
    Straight,
}

/// The closed form of the geodesics, and whether it needs `p = 0`; `moving` is what can be split off.
#[must_use]
pub fn closed_form(h: &Hamiltonian, moving: &[Commuting]) -> Option<(ClosedForm, bool)> {
    // The translational energy is quadratic in p: at p = 0 its flow stands still.
    let at_rest = h.translation.is_some() && !moving.iter().any(|c| matches!(c, Commuting::Drift(_)));
    let form = match h.frame {
        // The multiplier of a constraint bends the line.
        Frame::Flat => h.constraint.is_none().then_some(ClosedForm::Straight)?,
        // The Casimirs commute with the rotation that the skew part of the energy makes.
        Frame::Body => h.isotropic.as_ref().map(|_| ClosedForm::Body)?,
        Frame::Space => h.isotropic.as_ref().map(|_| ClosedForm::Space)?,
    };
    Some((form, at_rest))
}

/// The chart of the model's own frame, `p` spatial.
pub fn own_chart(arena: &mut Arena, h: &Hamiltonian) -> Chart {
    let linear = h.translation.as_ref().map(|_| Linear::Space);
    Chart::new(arena, h.dim, Momentum::of(h.frame), linear).under(h.confined())
}

/// `H` in the chart of the model's own frame.
#[must_use]
pub fn own_hamiltonian(h: &Hamiltonian, chart: &Chart) -> Polynomial {
    let mut sum = h.internal();
    sum.add_scaled(&h.translation_in(chart), &Rational::ONE);
    sum
}

/// The pieces of `H` that can be split off, each proved to commute with the rest.
pub fn commuting(
    arena: &mut Arena,
    h: &Hamiltonian,
    potential: Option<&Potential>,
    forces: &Forces,
) -> Vec<Commuting> {
    let keeps = |candidate| potential.is_none_or(|u| u.keeps(candidate));
    let chart = own_chart(arena, h);
    let translation = h.translation_in(&chart);
    let mut found = Vec::new();
    if let Some(iso) = h.isotropic.as_ref().filter(|iso| !iso.skew.is_zero()) {
        let spin = spatial_or_own(&chart);
        let mut rest = iso.casimirs(&spin);
        rest.add_scaled(&translation, &Rational::ONE);
        let norm = match h.frame {
            Frame::Body => Candidate::Vorticity,
            _ => Candidate::Spin,
        };
        if poisson(&chart, &iso.skew_norm(&spin), &rest).is_zero()
            && keeps(norm)
            && forces.commute_with_rotation(&chart, h, iso)
        {
            found.push(match h.frame {
                Frame::Body => Commuting::Vorticity(iso.skew.clone()),
                _ => Commuting::Spin(iso.skew.clone()),
            });
        }
    }
    // |p|^2 commutes with all that holds neither x nor p, as the internal energy does not.
    if let Some((Frame::Space, inverse_mass)) = &h.translation
        && potential.is_none_or(|u| !u.moves_the_centre())
        && forces.leave_the_centre()
    {
        found.push(Commuting::Drift(inverse_mass.clone()));
    }
    found
}

/// Every chart in which the rest of `H` is a polynomial, reduced; `rotations` tells whether those of space leave `H`
/// unchanged, `halves` asks of an energy that has no other chart than its own for a momentum for each position, `pieces`
/// for one whose pieces have flows.
pub fn candidates(
    arena: &mut Arena,
    h: &Hamiltonian,
    potential: Option<&Potential>,
    forces: &Forces,
    (rotations, halves, pieces): (bool, bool, bool),
) -> Vec<Reduction> {
    let commuting = commuting(arena, h, potential, forces);
    let drift = commuting.iter().any(|c| matches!(c, Commuting::Drift(_)));
    let without_skew = commuting.iter().any(|c| !matches!(c, Commuting::Drift(_)));
    let linear = (h.translation.is_some() && !drift).then_some(Linear::Space);
    let turn = |linear| linear == Some(Linear::Space) && rotations;
    let mut momenta = vec![Momentum::of(h.frame)];
    for other in [Momentum::Body, Momentum::Space, Momentum::Total] {
        if !momenta.contains(&other) && (other != Momentum::Total || linear.is_some()) {
            momenta.push(other);
        }
    }
    // Proved of potentials that are formulas alone: forces couple the dilatation to the rest, or are unknown.
    let separated = match forces.is_empty() {
        true => separated(arena, h, (potential, forces), &commuting),
        false => Vec::new(),
    };
    let mut charts: Vec<(Momentum, Option<Linear>)> =
        momenta.into_iter().map(|momentum| (momentum, linear)).collect();
    // Where a force moves `p` anyway: a constant is worth more than short equations. Splitting and Nystrom steps want `p`.
    let comoving = matches!(&h.translation, Some((Frame::Body, _))) && h.frame == Frame::Body;
    if comoving && !pieces && pushes_the_centre(arena, h, potential, forces) {
        charts.push((Momentum::Body, Some(Linear::Body)));
    }
    let entire: Vec<Reduction> = charts
        .into_iter()
        .flat_map(|(momentum, linear)| {
            let chart = Chart::new(arena, h.dim, momentum, linear).under(h.confined());
            let Some(mut main) = h.internal_in(&chart, without_skew) else { return Vec::new() };
            if linear.is_some() {
                main.add_scaled(&h.translation_in(&chart), &Rational::ONE);
            }
            let loads = loads(arena, &chart, h, potential, forces);
            let multiplier = h.constraint.is_some() && h.confined().is_none();
            let turn = turn(linear);
            let plan = Plan { chart, commuting: commuting.clone(), turn, loads, multiplier, halves };
            plan.reduced(arena, &main, h.is_tensor())
        })
        .collect();
    separated.into_iter().chain(entire).collect()
}

/// Does a force act on `p`, which the kinetic energy conserves?
fn pushes_the_centre(
    arena: &mut Arena,
    h: &Hamiltonian,
    potential: Option<&Potential>,
    forces: &Forces,
) -> bool {
    let chart = own_chart(arena, h);
    let loads = loads(arena, &chart, h, potential, forces);
    let mut all = loads.iter().flat_map(|load| &load.forces);
    all.any(|(z, force)| matches!(z, Coordinate::P(_)) && !force.is_zero())
}

/// The reductions that take the dilatation out of the state as well.
fn separated(
    arena: &mut Arena,
    h: &Hamiltonian,
    (potential, forces): (Option<&Potential>, &Forces),
    commuting: &[Commuting],
) -> Vec<Reduction> {
    let drifts = commuting.iter().any(|c| matches!(c, Commuting::Drift(_)));
    let turns = commuting.iter().any(|c| !matches!(c, Commuting::Drift(_)));
    let (Some(iso), Some(u)) = (&h.isotropic, potential) else { return Vec::new() };
    // With C(3) the velocity is no multiple of the traceless momentum.
    if h.constraint.is_some() {
        return Vec::new();
    }
    if (h.translation.is_some() && !drifts) || !(turns || iso.skew.is_zero()) || !iso.casimir3.is_zero() {
        return Vec::new();
    }
    let Some(slope) = u.dilatational_slope(arena) else { return Vec::new() };
    let inverse_mass = iso.inverse_dilatational_mass(h.dim);
    let charts = [Momentum::Body, Momentum::Space].map(|momentum| Chart::new(arena, h.dim, momentum, None));
    charts
        .into_iter()
        .filter_map(|chart| {
            let load = of_potential(arena, &chart, u, forces);
            let mut system = shear_system(arena, &chart, iso, &load)?;
            let fixed = take_constants(&mut system);
            let states = states(
                arena,
                Quantity::IsochoricPlacement,
                [Quantity::LinearMomentum, Quantity::IsochoricVelocity],
                &system,
            );
            let separation = Some(Separation { slope: slope.clone(), inverse_mass: inverse_mass.clone() });
            let (commuting, layout) = (commuting.to_vec(), Layout::Entries);
            Some(Reduction {
                chart,
                commuting,
                turned: false,
                layout,
                fixed,
                separation,
                carried: Vec::new(),
                system,
                states,
            })
        })
        .collect()
}

/// Takes components of the affine momentum that are conserved out of a system.
fn take_constants(system: &mut System) -> Vec<Expr> {
    let mut fixed = Vec::new();
    system.rates.retain(|(z, symbol, rate)| {
        let still = matches!(z, Coordinate::M(..)) && rate.is_zero();
        if still {
            fixed.push(*symbol);
        }
        !still
    });
    fixed
}

/// A system whose affine momentum is state, reduced: `p` leaves it where it is conserved, and space is turned on
/// demand.
pub fn reduced(
    arena: &Arena,
    chart: Chart,
    commuting: Vec<Commuting>,
    turn: bool,
    system: System,
) -> Reduction {
    Plan { chart, commuting, turn, loads: Vec::new(), multiplier: false, halves: false }.state_only(
        arena,
        system,
        Layout::Entries,
    )
}

/// What is known about a reduction before its equations are.
struct Plan {
    chart: Chart,
    commuting: Vec<Commuting>,
    turn: bool,
    /// The forces.
    loads: Vec<Load>,
    /// Does the multiplier of a constraint act besides? Then no affine momentum is taken for conserved.
    multiplier: bool,
    /// Is there to be a momentum for each position, conserved or not?
    halves: bool,
}

impl Plan {
    /// Takes the conserved momenta out of the state. Where the affine momentum stays in it, its equations are
    /// written in both forms; those of a tensor, in which nothing cancels, only through the velocity.
    fn reduced(self, arena: &mut Arena, h: &Polynomial, tensor: bool) -> Vec<Reduction> {
        let kinetics = Kinetics::polynomial(arena, &self.chart, h);
        let mut layout = Layout::Entries;
        let mut systems = Vec::new();
        if !tensor {
            let expanded = self.loaded(kinetics.system(Form::Expanded));
            if !self.multiplier && !self.halves {
                layout = conserved_layout(&expanded);
            }
            systems.push(expanded);
        }
        if layout == Layout::Entries {
            systems.push(self.loaded(kinetics.system(Form::ThroughVelocity)));
        }
        let mut reductions = Vec::new();
        for system in systems {
            let free = !self.multiplier && self.chart.confined.is_none();
            let rootless = free.then(|| carrying_the_dilatation(arena, &self.chart, &system)).flatten();
            // Forces with phi^-1 must not form det phi, however short their equations were with it.
            let alone = rootless.as_ref().is_some_and(|rootless| rootless.inverts);
            reductions.extend(rootless.map(|rootless| self.state_only(arena, rootless.system, layout)));
            if !alone {
                reductions.push(self.state_only(arena, system, layout));
            }
        }
        reductions
    }

    /// The equations with the forces.
    fn loaded(&self, mut system: System) -> System {
        self.loads.iter().for_each(|load| system.add(load));
        system
    }

    fn state_only(&self, arena: &Arena, mut system: System, layout: Layout) -> Reduction {
        let chart = self.chart.clone();
        let p_constant =
            system.rates.iter().all(|(z, _, rate)| !matches!(z, Coordinate::P(_)) || rate.is_zero());
        let turned = self.turn && p_constant;
        system.rates.retain(|(z, _, _)| match z {
            Coordinate::X(_) | Coordinate::Phi(..) | Coordinate::Carried(_) => true,
            Coordinate::P(_) => !p_constant,
            Coordinate::M(..) => match layout {
                Layout::Constant => false,
                Layout::Entries => true,
            },
        });
        let gauge = gauge(&chart, turned, layout);
        let value = |atom: Expr| gauge.contains(&atom).then(Polynomial::zero);
        system = system.substitute(&value).tidied(arena);
        let fixed = if self.multiplier || self.halves { Vec::new() } else { take_constants(&mut system) };
        let carried = Carried::of(arena, &system);
        let linear = chart.linear.map_or(Quantity::LinearMomentum, Linear::quantity);
        let states = states(arena, Quantity::Placement, [linear, chart.momentum.quantity()], &system);
        Reduction {
            chart,
            commuting: self.commuting.clone(),
            turned,
            layout,
            fixed,
            separation: None,
            carried,
            system,
            states,
        }
    }
}

/// Does an expanded system conserve the affine momentum?
fn conserved_layout(system: &System) -> Layout {
    let still =
        |(z, _, rate): &(Coordinate, Expr, Polynomial)| !matches!(z, Coordinate::M(..)) || rate.is_zero();
    if system.rates.iter().all(still) { Layout::Constant } else { Layout::Entries }
}

/// State variables, grouped.
fn states(
    arena: &Arena,
    placement: Quantity,
    [linear, momentum]: [Quantity; 2],
    system: &System,
) -> Vec<(Quantity, Vec<Expr>)> {
    let group = |quantity: Quantity, wanted: fn(&Coordinate) -> bool| {
        let symbols: Vec<Expr> =
            system.rates.iter().filter(|(z, _, _)| wanted(z)).map(|(_, s, _)| *s).collect();
        (quantity, symbols)
    };
    let carried = |carried: Carried| {
        let is_it = |z: &Coordinate, s: Expr| {
            matches!(z, Coordinate::Carried(_)) && arena.quantity(s) == Some(carried.quantity())
        };
        let symbols = system.rates.iter().filter(|(z, s, _)| is_it(z, *s)).map(|(_, s, _)| *s).collect();
        (carried.quantity(), symbols)
    };
    [
        group(Quantity::Position, |z| matches!(z, Coordinate::X(_))),
        group(placement, |z| matches!(z, Coordinate::Phi(..))),
        group(linear, |z| matches!(z, Coordinate::P(_))),
        group(momentum, |z| matches!(z, Coordinate::M(..))),
        carried(Carried::InverseDilatation),
        carried(Carried::MeanLogStretch),
        // After all rates.
        (Quantity::Work, system.work.iter().map(|(symbol, _)| *symbol).collect()),
    ]
    .into_iter()
    .filter(|(_, symbols)| !symbols.is_empty())
    .collect()
}

/// Components that vanish once space is turned.
pub(super) fn gauge(chart: &Chart, turned: bool, layout: Layout) -> Vec<Expr> {
    let mut zero = Vec::new();
    if turned {
        zero.extend(chart.p.iter().skip(1));
        if chart.momentum == Momentum::Total && layout == Layout::Constant && chart.dim == 3 {
            zero.push(chart.m.0[0][2]);
        }
    }
    zero
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Turning space makes an entry of `I(O)` vanish, and none of a momentum of another chart.
    #[test]
    fn the_gauge_is_that_of_the_total_momentum() {
        let mut arena = Arena::new();
        let mut entries = |momentum, dim, layout| {
            let chart = Chart::new(&mut arena, dim, momentum, Some(Linear::Space));
            gauge(&chart, true, layout).into_iter().filter(|zero| !chart.p.contains(zero)).count()
        };
        for momentum in [Momentum::Body, Momentum::Space, Momentum::Canonical] {
            assert_eq!(entries(momentum, 3, Layout::Constant), 0);
        }
        assert_eq!(entries(Momentum::Total, 3, Layout::Constant), 1);
        assert_eq!(entries(Momentum::Total, 3, Layout::Entries), 0);
        assert_eq!(entries(Momentum::Total, 2, Layout::Constant), 0);
    }
}
