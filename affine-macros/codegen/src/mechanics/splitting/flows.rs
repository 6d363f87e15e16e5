//! Flows in closed form, and which of them a system of equations has.

use crate::algebra::ring::{Square, difference, product, table};
use crate::algebra::substitute::listed;
use crate::algebra::{Arena, Expr, Kernel, Polynomial, Rational};
use crate::mechanics::charts::{Chart, Coordinate, Momentum};
use crate::mechanics::equations::System;
use crate::mechanics::separation::Separation;

/// A flow in closed form.
#[derive(Clone, Debug)]
pub enum Flow {
    /// `z -> z + t z'`, the rates being constants of the flow.
    Shift(System),
    /// `z -> z + r(h)`, the rises being polynomials in the state and functions of the time `h`.
    Rise(System),
    /// `phi -> phi exp(tY)` or `exp(tY) phi`.
    Exponential {
        /// What `Y` is written in.
        shared: Vec<(Expr, Polynomial)>,
        /// `Y`.
        generator: Vec<Vec<Polynomial>>,
        /// Does it stand on the right?
        right: bool,
        /// Does the affine momentum turn along?
        turns_momentum: bool,
    },
    /// `q` and the trace of the affine spin along the closed form of their motion.
    Dilatation {
        /// The motion.
        separation: Separation,
        /// The diagonal of the affine spin.
        spin: Vec<Polynomial>,
    },
}

/// A system with its velocities written out.
pub(super) fn expanded(mut system: System) -> System {
    let defined = std::mem::take(&mut system.shared);
    system.substitute(&listed(&defined))
}

/// The flow of a system, where it has one of the two forms.
pub(super) fn exact_flow(arena: &Arena, chart: &Chart, system: &System, time: Expr) -> Option<Flow> {
    let system = &with_work(arena, system, time);
    let moved = |s: Expr| system.rates.iter().any(|(_, symbol, _)| *symbol == s);
    let shared = system.shared.iter().map(|(_, p)| p).chain(system.kernels.iter().flat_map(Kernel::inputs));
    // Nothing reads the work.
    let rates = system.rates.iter().filter(|(z, ..)| !matches!(z, Coordinate::Carried(_)));
    let read = shared.chain(rates.map(|(_, _, rate)| rate));
    if !read.into_iter().any(|p| p.any_symbol(arena, &mut |s| moved(s))) {
        return Some(Flow::Shift(system.clone()));
    }
    if !(system.shared.is_empty() && system.kernels.is_empty()) {
        return None;
    }
    let (generator, right) = generator(chart, system)?;
    let turns_momentum = system.rates.iter().any(|(z, ..)| matches!(z, Coordinate::M(..)));
    (!turns_momentum || turns_along(chart, system, &generator, right)).then_some(Flow::Exponential {
        shared: Vec::new(),
        generator,
        right,
        turns_momentum,
    })
}

/// The system with the mean rate of its work over a time `h` among the rates. The power `P` is linear in momenta, which rise at
/// constant rates: the mean is `P + h/2 (dP/dz) z'`.
fn with_work(arena: &Arena, system: &System, time: Expr) -> System {
    let mut system = system.clone();
    let Some((symbol, power)) = system.work.take() else { return system };
    let power = written_out(arena, &system, &power);
    let half = Polynomial::term(vec![time], Rational::HALF);
    let mut mean = power.clone();
    for (_, s, rate) in &system.rates {
        mean.add_product(&half.mul(&power.derivative(*s)), rate, &Rational::ONE);
    }
    system.rates.push((Coordinate::Carried(symbol), symbol, mean));
    system.tidied(arena)
}

/// The rates of a system that moves momenta alone, in these: with velocities and forces written out.
pub(super) fn in_momenta(arena: &Arena, system: &System) -> Vec<(Coordinate, Expr, Polynomial)> {
    let rates = system.rates.iter();
    rates.map(|(z, symbol, rate)| (*z, *symbol, written_out(arena, system, rate))).collect()
}

/// With the definitions of all that changes while a system moves, velocities and what is named by them.
fn written_out(arena: &Arena, system: &System, polynomial: &Polynomial) -> Polynomial {
    let mut moved: Vec<Expr> = system.rates.iter().map(|(_, symbol, _)| *symbol).collect();
    let mut named: Vec<&(Expr, Polynomial)> = Vec::new();
    for definition in &system.shared {
        if definition.1.any_symbol(arena, &mut |s| moved.contains(&s)) {
            moved.push(definition.0);
            named.push(definition);
        }
    }
    named.into_iter().rev().fold(polynomial.clone(), |written, (name, value)| {
        written.substitute(&|atom| (atom == *name).then(|| value.clone()))
    })
}

/// `Y` with `phi' = phi Y` or `phi' = Y phi` and `Y' = 0`, and whether it stands on the right. Nothing else moves but
/// an affine momentum.
pub(super) fn generator(chart: &Chart, system: &System) -> Option<(Square<Polynomial>, bool)> {
    let n = chart.dim;
    if system.rates.iter().any(|(z, ..)| !matches!(z, Coordinate::Phi(..) | Coordinate::M(..))) {
        return None;
    }
    // The columns or rows that an exponential leaves alone are not among the rates.
    let placement = |i: usize, a: usize| {
        let found = system.rates.iter().find(|(z, ..)| *z == Coordinate::Phi(i, a));
        let still = || (chart.symbol(Coordinate::Phi(i, a)), Polynomial::zero());
        found.map_or_else(still, |(_, symbol, rate)| (*symbol, rate.clone()))
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
        placement(i, a).1.derivative(placement(j, b).0)
    };
    // (phi Y)_kc = phi_kr Y_rc, and (Y phi)_rk = Y_rc phi_ck.
    let rows = table(n, |r, c| if right { entry(c, r, 0) } else { entry(r, c, 0) });
    let phi = table(n, |i, a| Polynomial::atom(placement(i, a).0));
    let moved = if right { product(&phi, &rows) } else { product(&rows, &phi) };
    if moved != table(n, |i, a| placement(i, a).1) {
        return None;
    }
    let still = |y: &Polynomial| {
        let rate: Polynomial =
            system.rates.iter().map(|(_, symbol, slope)| y.derivative(*symbol).mul(slope)).sum();
        rate.is_zero()
    };
    rows.iter().flatten().all(still).then_some((rows, right))
}

/// `M' = [M, Y]`, or `[Y, M]` on the left.
pub(super) fn turns_along(
    chart: &Chart,
    system: &System,
    generator: &Square<Polynomial>,
    right: bool,
) -> bool {
    let (dependent, m) = (chart.dependent(), chart.m.atoms());
    let [after, before] = [product(&m, generator), product(generator, &m)];
    let commutator = if right { difference(&after, &before) } else { difference(&before, &after) };
    chart.independent_momenta().into_iter().all(|z| {
        let Coordinate::M(a, b) = z else { return true };
        // A component that keeps still must keep still in the commutator as well.
        commutator[a][b].substitute(&listed(&dependent)) == system.rate(z)
    })
}

/// Increments of the affine momentum under a constraint: of the entries that determine the others, in these.
pub(super) fn confined(chart: &Chart, mut system: System) -> System {
    let dependent = chart.dependent();
    system.rates.retain(|(_, symbol, _)| listed(&dependent)(*symbol).is_none());
    system.substitute(&listed(&dependent))
}
