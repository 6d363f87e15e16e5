//! The Hamiltonian in pieces whose flows are known, over the reduced state.
//!
//! A piece is solved exactly where its own equations show one of two forms, both decided on polynomials:
//!
//! ```text
//! z' = f(what the piece leaves alone)                          z -> z + t f               drift, translation, kick
//! phi' = phi Y, M' = [M, Y]  or  phi' = Y phi, M' = [Y, M]     phi -> phi exp(tY), M -> exp(-tY) M exp(tY)
//!              with Y constant along the piece                 or  phi -> exp(tY) phi, M -> exp(tY) M exp(-tY)
//! ```
//!
//! The second one holds for the Casimirs of an isotropic energy, which leave `M` alone, and for the norm of the
//! vorticity or the spin, which turns it; and for the squares that an anisotropic energy is a sum of. A third form
//! is known beforehand: where the potential is `U_dil(q) + W` with a `U_dil` of the right form and any `W`, the dilatation
//! of an isotropic energy under `U_dil` is a motion of one degree of freedom,
//!
//! ```text
//! q' = p/m, p' = -U_dil'(q)          phi -> exp(q(t) - q) phi, M -> M + (p(t) - p)/n 1,    p = tr Sigma
//! ```
//!
//! which commutes with the Casimirs of the traceless momentum and with their rotation: steps need not resolve a
//! stiff dilatation, whatever couples it to the rest, translation or `W`. Forces `dW/dq` kick it as often as a step
//! has kicks, and displace it by `h dW/dq/(m w)`, `w` its frequency; by up to `t dW/dq/(m w)` where whole swings fit
//! between kicks, and those add up (the impulse method of molecular dynamics: Garcia-Archilla, Sanz-Serna, Skeel, SIAM J.
//! Sci. Comput. 20 (1999) 930; Hairer, Lubich, Wanner, Geometric Numerical Integration, XIII.1). Pieces that commute follow
//! one another in one; translation and potential are one piece where their sum has the first form.

mod flows;
mod friction;
mod squares;
mod summand;
mod turns;

use crate::algebra::{Arena, Expr, Polynomial, Rational};

use super::body::Body;
use super::brackets::poisson;
use super::charts::{Coordinate, Momentum};
use super::custom::Custom;
use super::equations::{Form, Load, System};
use super::forces::Forces;
use super::hamiltonian::{Hamiltonian, spatial_or_own};
use super::kinetics::Kinetics;
use super::loads::of_potential;
use super::potential::Potential;
use super::reduction::Reduction;
use super::separation::Separation;
use super::term::Frame;
use crate::symbol::Quantity;
pub use flows::Flow;
use flows::{exact_flow, expanded};
pub use squares::Principal;
use squares::Squares;
use summand::{Summand, joined, over_the_state};

/// Pieces whose flows make up the motion, those of the kinetic energy first.
#[derive(Clone, Debug)]
pub struct Splitting {
    /// One to three of an isotropic energy; up to `n^2 + 1` of any other.
    pub pieces: Vec<Piece>,
    /// Squares that only the fields' values give.
    pub principal: Vec<Principal>,
    /// Are there two, `A` and `B`, with `[B, [B, [B, A]]] = 0`, as for `A` quadratic in the momenta that `B` moves?
    pub nystrom: bool,
}

/// A piece: flows that commute, one after the other.
#[derive(Clone, Debug)]
pub struct Piece {
    /// What it is, as text.
    pub name: String,
    /// Its flows.
    pub flows: Vec<Flow>,
}

/// The pieces of a reduced system; `None` where one of them has no flow in closed form.
pub fn splitting(
    arena: &mut Arena,
    (h, body): (&Hamiltonian, &Body),
    reduction: &Reduction,
) -> Option<Splitting> {
    let (potential, forces) = (body.potential, body.forces);
    let own = own_dilatation(arena, h, potential, reduction);
    let summands = match (&reduction.dilatation, &own) {
        (Some(_), _) => separated(arena, reduction),
        (None, Some(own)) => summands(arena, &own.h, (Some(&own.rest), forces), reduction)?,
        (None, None) => summands(arena, h, (potential, forces), reduction)?,
    };
    let kicks = kicks(arena, body, reduction)?;
    let summands: Vec<Summand> =
        summands.into_iter().chain(kicks).filter(|summand| !summand.system.rates.is_empty()).collect();
    let time = arena.symbol(Quantity::TimeOfFlow);
    let flow = |arena: &Arena, system: &System| exact_flow(arena, &reduction.chart, system, time);
    let Squares { groups: squares, principal } = match (&h.isotropic, h.frame) {
        (None, Frame::Body | Frame::Space) => Squares::of(arena, &reduction.chart, &h.internal())?,
        _ => Squares::default(),
    };
    let squares = squares.iter().map(|group| squares::piece(arena, reduction, group));
    let mut groups: Vec<(Vec<Summand>, Vec<Flow>)> = squares.collect::<Option<_>>()?;
    for summand in summands {
        let commutes = |other: &Summand| match (&other.energy, &summand.energy) {
            (Some(f), Some(g)) => poisson(&reduction.chart, f, g).is_zero(),
            _ => false,
        };
        if let Some((first, flows)) = groups.last_mut() {
            if first.iter().all(commutes) {
                flows.push(flow(arena, &summand.system)?);
                first.push(summand);
                continue;
            }
            if let [Flow::Shift(_)] = flows.as_slice()
                && let Some(one @ Flow::Shift(_)) = flow(arena, &joined(first, &summand))
            {
                *flows = vec![one];
                first.push(summand);
                continue;
            }
        }
        let own = flow(arena, &summand.system)?;
        groups.push((vec![summand], vec![own]));
    }
    if let (Some(own), Some((first, flows))) = (own, groups.first_mut()) {
        flows.push(Flow::Dilatation { separation: own.separation, spin: own.spin });
        first.push(Summand {
            name: "dilatation".into(),
            energy: Some(own.energy),
            system: System::default(),
        });
    }
    groups.extend(friction(arena, (h, body), reduction)?.map(|(summand, flow)| (vec![summand], vec![flow])));
    let nystrom = is_nystrom(reduction, &groups);
    let name = |list: &[Summand]| list.iter().map(|s| s.name.as_str()).collect::<Vec<_>>().join(" + ");
    let pieces = groups.into_iter().map(|(list, flows)| Piece { name: name(&list), flows }).collect();
    Some(Splitting { pieces, principal, nystrom })
}

/// Is there a dilatation with a closed form that stays in the state, among pieces whose flows are all known?
pub fn dilates(arena: &mut Arena, (h, body): (&Hamiltonian, &Body), reduction: &Reduction) -> bool {
    own_dilatation(arena, h, body.potential, reduction).is_some()
        && splitting(arena, (h, body), reduction).is_some()
}

/// A dilatation with a closed form that stays in the state, for translation or the potential couples it to the rest.
struct OwnDilatation {
    separation: Separation,
    /// The diagonal of the affine spin over the reduced state: of the total affine momentum, `x p^T` is no part of it.
    spin: Vec<Polynomial>,
    /// `p^2/(2 m)`.
    energy: Polynomial,
    /// The kinetic energy without it.
    h: Hamiltonian,
    /// The potential without `U_dil`, for its forces: functions of the placement and the position, as it was.
    rest: Potential,
}

/// `None` where there is nothing stiff to gain: the dilatation is out of the state, or moves freely, or has no closed form.
fn own_dilatation(
    arena: &mut Arena,
    h: &Hamiltonian,
    potential: Option<&Potential>,
    reduction: &Reduction,
) -> Option<OwnDilatation> {
    let chart = &reduction.chart;
    let iso = h.isotropic.as_ref()?;
    let moves_itself = chart.momentum != Momentum::Canonical && iso.casimir3.is_zero();
    if reduction.dilatation.is_some() || h.constraint.is_some() || !moves_itself || iso.casimir2.is_zero() {
        return None;
    }
    let states = reduction.symbols();
    if !(0..chart.dim).all(|a| states.contains(&chart.m.0[a][a])) {
        return None;
    }
    let (slope, rest) = potential?.own_dilatation(arena)?;
    let inverse_mass = iso.inverse_dilatational_mass(chart.dim);
    let rows = spatial_or_own(chart).into_iter().enumerate();
    let spin: Vec<Polynomial> = rows.filter_map(|(a, row)| row.into_iter().nth(a)).collect();
    let trace: Polynomial = spin.iter().sum();
    let mut energy = Polynomial::zero();
    energy.add_product(&trace.mul(&trace), &inverse_mass, &Rational::HALF);
    let mut h = h.clone();
    let nth = -&Rational::one_over(chart.dim);
    // tr M^2 - (tr M)^2/n, of the traceless momentum.
    h.isotropic.as_mut()?.casimir1_squared = iso.casimir2.scaled(&nth);
    let gauge = reduction.gauge();
    let spin = spin.iter().map(|entry| entry.substitute(&gauge)).collect();
    Some(OwnDilatation { separation: Separation { slope, inverse_mass }, spin, energy, h, rest })
}

/// Kinetic energy, translation and potential in the chart of the reduction; the potential with `dU/dt` where that is accounted
/// for.
fn summands(
    arena: &mut Arena,
    h: &Hamiltonian,
    (potential, forces): (Option<&Potential>, &Forces),
    reduction: &Reduction,
) -> Option<Vec<Summand>> {
    let chart = &reduction.chart;
    let mut energies: Vec<(&'static str, Polynomial)> = Vec::new();
    match &h.isotropic {
        Some(iso) => {
            let spin = spatial_or_own(chart);
            energies.push(("Casimirs", iso.casimirs(&spin)));
            if reduction.commuting.rotation.is_none() && !iso.skew.is_zero() {
                let name = if h.frame == Frame::Body { "vorticity" } else { "spin" };
                energies.push((name, iso.skew_norm(&spin)));
            }
        }
        None if h.frame == Frame::Flat => energies.push(("T(Pi)", h.internal())),
        // Its squares are pieces of their own.
        None => {}
    }
    if chart.linear.is_some() {
        energies.push(("translation", h.translation_in(chart)));
    }
    let mut summands = Vec::new();
    for (name, energy) in energies {
        let system = expanded(Kinetics::polynomial(arena, chart, &energy).system(Form::Expanded));
        summands.push(Summand {
            name: name.to_owned(),
            energy: Some(energy),
            system: over_the_state(arena, reduction, system)?,
        });
    }
    if let Some(u) = potential {
        let load = of_potential(arena, chart, u, forces);
        let system = over_the_state(arena, reduction, load.alone(chart))?;
        summands.push(Summand { name: "potential".into(), energy: None, system });
    }
    Some(summands)
}

/// What the fields of the model add, each by itself: forces and slopes that depend on positions, and the work of the forces.
fn kicks(arena: &mut Arena, body: &Body, reduction: &Reduction) -> Option<Vec<Summand>> {
    let centre = body.motion.centre_velocity(arena);
    let kick = |custom: &Custom| {
        let load = custom.load(arena, &reduction.chart, &centre);
        let system = acting(arena, body, reduction, load)?;
        Some(Summand { name: format!("`{}`", custom.name), energy: None, system })
    };
    body.forces.customs.iter().map(kick).collect()
}

/// The friction, with its flow.
fn friction(
    arena: &mut Arena,
    (h, body): (&Hamiltonian, &Body),
    reduction: &Reduction,
) -> Option<Option<(Summand, Flow)>> {
    let Some(dissipation) = &body.forces.dissipation else { return Some(None) };
    let centre = body.motion.centre_velocity(arena);
    let load = dissipation.load(arena, &reduction.chart, &centre);
    let system = acting(arena, body, reduction, load)?;
    let flow = friction::flow(arena, h, reduction, &system)?;
    Some(Some((Summand { name: "friction".to_owned(), energy: None, system }, flow)))
}

/// What a load moves of the state by itself.
fn acting(arena: &mut Arena, body: &Body, reduction: &Reduction, mut load: Load) -> Option<System> {
    let chart = &reduction.chart;
    // Its work, and friction all of it, read velocities.
    if load.work.is_some() {
        let skew = reduction.commuting.rotation.is_some();
        let (kinetics, _) = body.motion.kinetics_without(arena, chart, skew).into_iter().next()?;
        load.shared.splice(0..0, kinetics.shared);
    }
    let system = load.confined(arena, chart).alone(chart);
    over_the_state(arena, reduction, system)
}

/// `Psi' = Psi O` and `O' = ` the forces, where the dilatation is out of the state.
fn separated(arena: &Arena, reduction: &Reduction) -> Vec<Summand> {
    let system = &reduction.system;
    let part = |name: &str, placement: bool| {
        let mut part = system.clone();
        part.rates.retain(|(z, _, rate)| matches!(z, Coordinate::Phi(..)) == placement && !rate.is_zero());
        Summand { name: name.to_owned(), energy: None, system: part.tidied(arena) }
    };
    let mut kinetic = part("Casimirs", true);
    kinetic.system = expanded(kinetic.system);
    vec![kinetic, part("potential", false)]
}

/// `ad_B` lowers the degree in what `B` moves by one, for it gives that rates which it does not change: of a first
/// piece of degree two nothing is left after three times. (The Runge-Kutta-Nystrom case.)
fn is_nystrom(reduction: &Reduction, groups: &[(Vec<Summand>, Vec<Flow>)]) -> bool {
    let [(first, _), (_, flows)] = groups else { return false };
    let [Flow::Shift(kick)] = flows.as_slice() else { return false };
    // The rate of the work is linear in the momenta.
    if kick.rates.iter().any(|(z, ..)| matches!(z, Coordinate::Carried(_))) {
        return false;
    }
    if reduction.dilatation.is_some() {
        // tr sigma^2/(2 alpha), see `separated` in the reduction.
        return true;
    }
    let moved = |atom: &&Expr| kick.rates.iter().any(|(_, symbol, _)| symbol == *atom);
    let quadratic =
        |energy: &Polynomial| energy.terms().all(|(monomial, _)| monomial.iter().filter(moved).count() <= 2);
    first.iter().all(|summand| summand.energy.as_ref().is_some_and(quadratic))
}
