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
//! vorticity or the spin, which turns it. A third form is known beforehand: where the potential splits into `U_dil(q)` and
//! what no dilatation changes, the dilatation with its own kinetic energy is a motion of one degree of freedom,
//!
//! ```text
//! q' = p/m, p' = -U_dil'(q)          phi -> exp(q(t) - q) phi, M -> M + (p(t) - p)/n 1,    p = tr M
//! ```
//!
//! which commutes with the Casimirs of the traceless momentum and with their rotation: steps need not resolve a
//! stiff dilatation, even one that translation couples to the rest. Pieces that commute follow one another in one; translation and potential
//! are one piece where their sum has the first form.

use crate::algebra::{Arena, Expr, Kernel, Polynomial, Rational};

use super::brackets::poisson;
use super::charts::{Chart, Coordinate, Momentum};
use super::equations::{Form, System, hamilton};
use super::hamiltonian::{Hamiltonian, spatial_or_own};
use super::kinetic::Frame;
use super::potential::Potential;
use super::reduce::{Commuting, Reduction, gauge};
use super::separation::{Separation, Slope};

/// Pieces whose flows make up the motion, those of the kinetic energy first.
#[derive(Clone, Debug)]
pub struct Splitting {
    /// One to three of them.
    pub pieces: Vec<Piece>,
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

/// A flow in closed form.
#[derive(Clone, Debug)]
pub enum Flow {
    /// `z -> z + t z'`, the rates being constants of the flow.
    Shift(System),
    /// `phi -> phi exp(tY)` or `exp(tY) phi`.
    Exponential {
        /// `Y`.
        generator: Vec<Vec<Polynomial>>,
        /// Does it stand on the right?
        right: bool,
        /// Does the affine momentum turn along?
        turns_momentum: bool,
    },
    /// `q` and `tr M` along the closed form of their motion.
    Dilatation(Separation),
}

/// A summand of `H` with its equations over the reduced state.
struct Summand {
    name: &'static str,
    /// The summand, where it is a polynomial.
    energy: Option<Polynomial>,
    system: System,
}

/// The pieces of a reduced system; `None` where one of them has no flow in closed form.
pub fn splitting(
    arena: &mut Arena,
    h: &Hamiltonian,
    potential: Option<&Potential>,
    reduction: &Reduction,
) -> Option<Splitting> {
    let own = own_dilatation(arena, h, potential, reduction);
    let summands = match (&reduction.separation, &own) {
        (Some(_), _) => separated(arena, reduction),
        (None, Some(own)) => summands(arena, &own.h, Some(&own.rest), reduction)?,
        (None, None) => summands(arena, h, potential, reduction)?,
    };
    let summands: Vec<Summand> =
        summands.into_iter().filter(|summand| !summand.system.rates.is_empty()).collect();
    let flow = |arena: &Arena, summand: &Summand| exact_flow(arena, &reduction.chart, &summand.system);
    let mut groups: Vec<(Vec<Summand>, Vec<Flow>)> = Vec::new();
    for summand in summands {
        let commutes = |other: &Summand| match (&other.energy, &summand.energy) {
            (Some(f), Some(g)) => poisson(&reduction.chart, f, g).is_zero(),
            _ => false,
        };
        if let Some((first, flows)) = groups.last_mut() {
            if first.iter().all(commutes) {
                flows.push(flow(arena, &summand)?);
                first.push(summand);
                continue;
            }
            let merged = joined(first, &summand);
            if let Some(one @ Flow::Shift(_)) = exact_flow(arena, &reduction.chart, &merged) {
                *flows = vec![one];
                first.push(summand);
                continue;
            }
        }
        let own = flow(arena, &summand)?;
        groups.push((vec![summand], vec![own]));
    }
    if let (Some(own), Some((first, flows))) = (own, groups.first_mut()) {
        flows.push(Flow::Dilatation(own.separation));
        first.push(Summand { name: "dilatation", energy: Some(own.energy), system: System::default() });
    }
    let nystrom = is_nystrom(reduction, &groups);
    let name = |list: &[Summand]| list.iter().map(|s| s.name).collect::<Vec<_>>().join(" + ");
    let pieces = groups.into_iter().map(|(list, flows)| Piece { name: name(&list), flows }).collect();
    Some(Splitting { pieces, nystrom })
}

/// A dilatation with a closed form that stays in the state, for translation couples it to the rest.
struct OwnDilatation {
    separation: Separation,
    /// `p^2/(2 m)`.
    energy: Polynomial,
    /// The kinetic energy without it.
    h: Hamiltonian,
    /// The potential without `U_dil`, for its forces.
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
    let moves_itself = matches!(chart.momentum, Momentum::Body | Momentum::Space) && iso.casimir3.is_zero();
    if reduction.separation.is_some() || h.constraint.is_some() || !moves_itself || iso.casimir2.is_zero() {
        return None;
    }
    let states: Vec<Expr> = reduction.states.iter().flat_map(|(_, symbols)| symbols.clone()).collect();
    let diagonal = |a: usize| chart.m.0[a][a];
    if !(0..chart.dim).all(|a| states.contains(&diagonal(a))) {
        return None;
    }
    let potential = potential?;
    let slope = potential.dilatational_slope(arena).filter(|slope| *slope != Slope::Zero)?;
    let rest = potential.beside_dilatation(arena, &slope)?;
    let inverse_mass = iso.inverse_dilatational_mass(chart.dim);
    let mut trace = Polynomial::zero();
    (0..chart.dim).for_each(|a| trace.add_scaled(&Polynomial::atom(diagonal(a)), &Rational::ONE));
    let mut energy = Polynomial::zero();
    energy.add_product(&trace.mul(&trace), &inverse_mass, &Rational::ratio(1, 2)?);
    let mut h = h.clone();
    let nth = Rational::ratio(-1, i64::try_from(chart.dim).ok()?)?;
    // tr M^2 - (tr M)^2/n, of the traceless momentum.
    h.isotropic.as_mut()?.casimir1_squared = iso.casimir2.scaled(&nth);
    Some(OwnDilatation { separation: Separation { slope, inverse_mass }, energy, h, rest })
}

/// Kinetic energy, translation and potential in the chart of the reduction.
fn summands(
    arena: &mut Arena,
    h: &Hamiltonian,
    potential: Option<&Potential>,
    reduction: &Reduction,
) -> Option<Vec<Summand>> {
    let chart = &reduction.chart;
    let mut energies: Vec<(&'static str, Polynomial)> = Vec::new();
    match &h.isotropic {
        Some(iso) => {
            let spin = spatial_or_own(chart);
            energies.push(("Casimirs", iso.casimirs(&spin)));
            let split_off = reduction.commuting.iter().any(|c| !matches!(c, Commuting::Drift(_)));
            if !split_off && !iso.skew.is_zero() {
                let name = if h.frame == Frame::Body { "vorticity" } else { "spin" };
                energies.push((name, iso.skew_norm(&spin)));
            }
        }
        None if h.frame == Frame::Flat => energies.push(("T(Pi)", h.internal())),
        None => return None,
    }
    if chart.linear.is_some() {
        energies.push(("translation", h.translation_in(chart)));
    }
    let mut summands = Vec::new();
    for (name, energy) in energies {
        let system = hamilton(arena, chart, &energy, Form::Expanded);
        let defined = system.shared.clone();
        let value = |atom: Expr| defined.iter().find(|(s, _)| *s == atom).map(|(_, p)| p.clone());
        let mut system = system.substitute(&value);
        system.shared.clear();
        summands.push(Summand {
            name,
            energy: Some(energy),
            system: over_the_state(arena, reduction, system)?,
        });
    }
    if let Some(u) = potential {
        let load = u.load(arena, chart);
        let force =
            |z: &Coordinate| load.forces.iter().find(|(at, _)| at == z).map(|(_, force)| force.clone());
        let rates = chart.coordinates().into_iter().filter_map(|z| Some((z, chart.symbol(z), force(&z)?)));
        let system = System {
            rates: rates.collect(),
            shared: load.shared.clone(),
            kernels: load.kernels.clone(),
            work: None,
        };
        let system = over_the_state(arena, reduction, system)?;
        summands.push(Summand { name: "potential", energy: None, system });
    }
    Some(summands)
}

/// `Psi' = Psi O` and `O' = ` the forces, where the dilatation is out of the state.
fn separated(arena: &Arena, reduction: &Reduction) -> Vec<Summand> {
    let system = &reduction.system;
    let part = |name, placement: bool| {
        let mut part = system.clone();
        part.rates.retain(|(z, _, rate)| matches!(z, Coordinate::Phi(..)) == placement && !rate.is_zero());
        Summand { name, energy: None, system: part.tidied(arena) }
    };
    let mut kinetic = part("Casimirs", true);
    let defined = kinetic.system.shared.clone();
    let value = |atom: Expr| defined.iter().find(|(s, _)| *s == atom).map(|(_, p)| p.clone());
    kinetic.system = kinetic.system.substitute(&value);
    kinetic.system.shared.clear();
    vec![kinetic, part("potential", false)]
}

/// The equations that move components of the reduced state; `None` where they move anything else that is kept as a
/// constant.
fn over_the_state(arena: &Arena, reduction: &Reduction, system: System) -> Option<System> {
    let gauge = gauge(&reduction.chart, reduction.turned, reduction.layout);
    let value = |atom: Expr| gauge.contains(&atom).then(Polynomial::zero);
    let mut system = system.substitute(&value);
    system.rates.retain(|(_, _, rate)| !rate.is_zero());
    let states: Vec<Expr> = reduction.states.iter().flat_map(|(_, symbols)| symbols.clone()).collect();
    let inside = system.rates.iter().all(|(_, symbol, _)| states.contains(symbol));
    inside.then(|| system.tidied(arena))
}

/// The sum of summands.
fn joined(list: &[Summand], last: &Summand) -> System {
    let mut sum = System::default();
    for summand in list.iter().chain([last]) {
        sum.shared.extend(summand.system.shared.iter().cloned());
        sum.kernels.extend(summand.system.kernels.iter().cloned());
        for (z, symbol, rate) in &summand.system.rates {
            match sum.rates.iter_mut().find(|(at, ..)| at == z) {
                Some((.., total)) => total.add_scaled(rate, &Rational::ONE),
                None => sum.rates.push((*z, *symbol, rate.clone())),
            }
        }
    }
    sum
}

/// The flow of a system, where it has one of the two forms.
fn exact_flow(arena: &Arena, chart: &Chart, system: &System) -> Option<Flow> {
    let moved = |s: Expr| system.rates.iter().any(|(_, symbol, _)| *symbol == s);
    let shared = system.shared.iter().map(|(_, p)| p).chain(system.kernels.iter().flat_map(Kernel::inputs));
    let read = shared.chain(system.rates.iter().map(|(_, _, rate)| rate));
    if !read.into_iter().any(|p| p.any_symbol(arena, &mut |s| moved(s))) {
        return Some(Flow::Shift(system.clone()));
    }
    if !(system.shared.is_empty() && system.kernels.is_empty()) {
        return None;
    }
    let (generator, right) = generator(chart, system)?;
    let turns_momentum = system.rates.iter().any(|(z, ..)| matches!(z, Coordinate::M(..)));
    (!turns_momentum || turns_along(chart, system, &generator, right)).then_some(Flow::Exponential {
        generator,
        right,
        turns_momentum,
    })
}

/// `Y` with `phi' = phi Y` or `phi' = Y phi` and `Y' = 0`, and whether it stands on the right. Nothing else moves but
/// an affine momentum.
fn generator(chart: &Chart, system: &System) -> Option<(Vec<Vec<Polynomial>>, bool)> {
    let n = chart.dim;
    if system.rates.iter().any(|(z, ..)| !matches!(z, Coordinate::Phi(..) | Coordinate::M(..))) {
        return None;
    }
    let placement = |i: usize, a: usize| {
        let found = system.rates.iter().find(|(z, ..)| *z == Coordinate::Phi(i, a))?;
        Some((found.1, found.2.clone()))
    };
    let right = match chart.momentum {
        Momentum::Body => true,
        Momentum::Space | Momentum::Total => false,
        Momentum::Canonical => return None,
    };
    // Row and column of phi that meet in d phi'/d phi.
    let place = |k: usize, l: usize| if right { (k, l) } else { (l, k) };
    let entry = |to: usize, from: usize, k: usize| {
        let ((i, a), (j, b)) = (place(k, to), place(k, from));
        Some(placement(i, a)?.1.derivative(placement(j, b)?.0))
    };
    let mut rows = vec![vec![Polynomial::zero(); n]; n];
    for (r, c) in pairs(n) {
        // (phi Y)_kc = phi_kr Y_rc, and (Y phi)_rk = Y_rc phi_ck.
        rows[r][c] = if right { entry(c, r, 0)? } else { entry(r, c, 0)? };
    }
    for (i, a) in pairs(n) {
        let mut product = Polynomial::zero();
        for k in 0..n {
            let ((j, b), y) = if right { ((i, k), &rows[k][a]) } else { ((k, a), &rows[i][k]) };
            product.add_product(&Polynomial::atom(placement(j, b)?.0), y, &Rational::ONE);
        }
        if product != placement(i, a)?.1 {
            return None;
        }
    }
    let still = |y: &Polynomial| {
        let mut rate = Polynomial::zero();
        for (_, symbol, slope) in &system.rates {
            rate.add_product(&y.derivative(*symbol), slope, &Rational::ONE);
        }
        rate.is_zero()
    };
    rows.iter().flatten().all(still).then_some((rows, right))
}

/// `M' = [M, Y]`, or `[Y, M]` on the left.
fn turns_along(chart: &Chart, system: &System, generator: &[Vec<Polynomial>], right: bool) -> bool {
    let n = chart.dim;
    pairs(n).all(|(a, b)| {
        let Some((.., rate)) = system.rates.iter().find(|(z, ..)| *z == Coordinate::M(a, b)) else {
            // A component that keeps still must keep still in the commutator as well.
            return commutator(chart, generator, right, a, b).is_zero();
        };
        commutator(chart, generator, right, a, b) == *rate
    })
}

fn commutator(chart: &Chart, y: &[Vec<Polynomial>], right: bool, a: usize, b: usize) -> Polynomial {
    let (plus, minus) = match right {
        true => (Rational::ONE, Rational::MINUS_ONE),
        false => (Rational::MINUS_ONE, Rational::ONE),
    };
    let mut sum = Polynomial::zero();
    for k in 0..chart.dim {
        sum.add_product(&Polynomial::atom(chart.m.0[a][k]), &y[k][b], &plus);
        sum.add_product(&Polynomial::atom(chart.m.0[k][b]), &y[a][k], &minus);
    }
    sum
}

/// `ad_B` lowers the degree in what `B` moves by one, for it gives that rates which it does not change: of a first
/// piece of degree two nothing is left after three times. (The Runge-Kutta-Nystrom case.)
fn is_nystrom(reduction: &Reduction, groups: &[(Vec<Summand>, Vec<Flow>)]) -> bool {
    let [(first, _), (_, flows)] = groups else { return false };
    let [Flow::Shift(kick)] = flows.as_slice() else { return false };
    if reduction.separation.is_some() {
        // tr sigma^2/(2 alpha), see `separated` in the reduction.
        return true;
    }
    let moved = |atom: &&Expr| kick.rates.iter().any(|(_, symbol, _)| symbol == *atom);
    let quadratic =
        |energy: &Polynomial| energy.terms().all(|(monomial, _)| monomial.iter().filter(moved).count() <= 2);
    first.iter().all(|summand| summand.energy.as_ref().is_some_and(quadratic))
}

fn pairs(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..n).flat_map(move |a| (0..n).map(move |b| (a, b)))
}
