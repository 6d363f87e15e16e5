//! The internal motion of a sum of energies, whose mass matrix depends on the placement.
//!
//! It is written over `phi_dot` and `Pi`, and where it is confined to a group over `Oh` and `Sigma_hat`: the Lie algebra does
//! not turn with `phi`.

use crate::algebra::ring::{Square, product, table};
use crate::algebra::substitute::listed;
use crate::algebra::{Arena, Expr, Matrix, Polynomial, Rational};
use crate::mechanics::charts::{Chart, Momentum};
use crate::mechanics::constraint::Constraint;
use crate::mechanics::direction::{BasisVector, entries, invariant};
use crate::mechanics::kinetic::Kinetic;
use crate::mechanics::kinetics::{Kinetics, Lagrangian};
use crate::mechanics::metric::Definitions;
use crate::mechanics::term::Frame;
use crate::symbol::{Factorised, Quantity};

use super::Mixed;
use super::factorisation::Factorisation;
use super::mass::{along, mass_matrix};
use super::placed::Placed;

/// The Legendre transformation of the internal motion.
#[derive(Clone, Debug)]
pub struct Legendre {
    /// Quantities on the way from `phi` and the velocity.
    pub shared: Definitions,
    /// `(dT/dO)^T` in the velocities of each frame, projected under a constraint.
    pub momenta: Vec<(Frame, Square<Polynomial>)>,
    /// `T_int`.
    pub energy: Polynomial,
}

/// The inverse Legendre transformation, and what the equations of the internal motion are derived from.
#[derive(Clone, Debug)]
pub struct Internal {
    /// Quantities on the way from `phi` and the momentum to the velocity.
    pub shared: Definitions,
    /// The velocity as symbols, defined among the shared quantities.
    pub velocity: Matrix,
    /// The factorised mass matrix.
    pub factorisation: Factorisation,
    /// `tr(M O)/2`.
    pub energy: Polynomial,
    /// The energies.
    mixed: Mixed,
    /// The energy as its forces are derived from it.
    lagrangian: Lagrangian,
}

impl Internal {
    /// Inverts the Legendre transformation; `None` where the mass matrix is singular at every placement.
    pub fn new(arena: &mut Arena, mixed: &Mixed) -> Option<Self> {
        let momentum = if mixed.constraint.is_some() { Momentum::Body } else { Momentum::Canonical };
        let chart = Chart::new(arena, mixed.dim, momentum, None).under(mixed.constraint);
        let Solved { shared, components, factorisation } = Solved::new(arena, mixed, &chart)?;
        let half = Rational::HALF;
        let energy: Polynomial = components
            .iter()
            .map(|(momentum, speed)| momentum.mul(&Polynomial::atom(*speed)).scaled(&half))
            .sum();
        let on_the_group = Placed::new(arena, mixed.dim, mixed.constraint).values(arena);
        let lagrangian = mixed.lagrangian(arena, &chart, on_the_group, true);
        let velocity = Matrix::symbols(arena, chart.frame().velocity(), mixed.dim);
        Some(Self { shared, velocity, factorisation, energy, mixed: mixed.clone(), lagrangian })
    }

    /// The group that the motion is confined to.
    pub fn group(&self) -> Option<Constraint> {
        self.lagrangian.chart.confined
    }

    /// The frame of velocity and momentum.
    pub fn frame(&self) -> Frame {
        self.lagrangian.chart.frame()
    }

    /// Hamilton's equations, in each way that may be the shortest.
    pub fn kinetics(&self, arena: &mut Arena) -> Vec<Kinetics> {
        self.lagrangian.kinetics(arena, &self.velocity, &self.shared)
    }

    /// The inverse of the mass matrix over `phi_dot` on the group, `d(phi_dot)/dPi`, its columns numbered from `first` on: of a
    /// momentum `Pi` the Lie algebra sees `Pi phi`.
    pub fn inverse_on_the_group(&self, arena: &mut Arena, first: usize) -> (Definitions, Square<Polynomial>) {
        let chart = &self.lagrangian.chart;
        let (n, basis, phi) = (chart.dim, basis(chart), chart.placement());
        let mut shared = self.shared.clone();
        let columns: Square<Polynomial> = (0..n * n)
            .map(|unit| {
                // Of Pi = E_Bj the momentum conjugate to Oh_aB is phi_ja.
                let momentum = |k: usize| {
                    if k % n == unit % n { phi[unit / n][k / n].clone() } else { Polynomial::zero() }
                };
                let momenta: Vec<Polynomial> = basis.iter().map(|e| along(e, momentum)).collect();
                let speeds = self.factorisation.column(arena, first + unit, &momenta, &mut shared);
                let velocity = composed(&basis, &speeds, n * n);
                let velocity = table(n, |a, b| velocity[n * a + b].clone());
                product(&phi, &velocity).concat()
            })
            .collect();
        // It is symmetric: columns may stand as rows.
        (shared, columns)
    }

    /// The Legendre transformation, in each form that may be the shortest; on all placements that of each part in its frame.
    pub fn legendre(&self, arena: &mut Arena) -> Vec<Legendre> {
        let parts = &self.mixed.internal;
        let Some(group) = self.group() else {
            return vec![Legendre {
                shared: Definitions::new(),
                momenta: parts.iter().map(|part| (part.frame, part.momentum())).collect(),
                energy: parts.iter().map(Kinetic::internal_energy).sum(),
            }];
        };
        let n = self.mixed.dim;
        let placed = Placed::new(arena, n, Some(group));
        let on_the_group = placed.values(arena);
        // Where G is no multiple of 1, nothing else here needs it.
        let through_green = placed.inverse_square.is_some();
        let lagrangian = self.mixed.lagrangian(arena, &self.lagrangian.chart, on_the_group, through_green);
        // Of the entries of Oh those that determine the others.
        let dependent = group.dependent(&self.velocity);
        let value = listed(&dependent);
        let forms = [false, true].map(|by_names| {
            let (shared, momentum, energy) = lagrangian.legendre(by_names);
            let shared = placed.shared.iter().cloned().chain(shared);
            let projected = group.projected(&table(n, |a, b| momentum[n * a + b].clone()));
            Legendre {
                shared: shared.map(|(symbol, p)| (symbol, p.substitute(&value))).collect(),
                momenta: vec![(Frame::Body, table(n, |a, b| projected[a][b].substitute(&value)))],
                energy: energy.substitute(&value),
            }
        });
        forms.into()
    }
}

/// The velocities that the mass matrix stands on: all of them, or a basis of the Lie algebra of a group.
fn basis(chart: &Chart) -> Vec<BasisVector> {
    match chart.confined {
        None => entries(chart.dim.pow(2)),
        // The first basis that there is: its vectors have the fewest entries.
        Some(group) => group.bases(chart.dim, invariant(chart.dim)).swap_remove(0),
    }
}

/// The entries of the velocity with these speeds along a basis.
fn composed(basis: &[BasisVector], speeds: &[Expr], size: usize) -> Vec<Polynomial> {
    let mut velocity = vec![Polynomial::zero(); size];
    for (e, speed) in basis.iter().zip(speeds) {
        e.entries.iter().for_each(|(place, weight)| velocity[*place].add_term(vec![*speed], weight));
    }
    velocity
}

/// An inverse Legendre transformation.
struct Solved {
    /// Quantities on the way from placement and momentum to the velocity, all of its entries included.
    shared: Definitions,
    /// Momenta and velocities along a basis.
    components: Vec<(Polynomial, Expr)>,
    /// The factorised mass matrix on that basis.
    factorisation: Factorisation,
}

impl Solved {
    /// The velocity of a chart; `None` where the mass matrix is singular at every placement.
    fn new(arena: &mut Arena, mixed: &Mixed, chart: &Chart) -> Option<Self> {
        let n = mixed.dim;
        let basis = basis(chart);
        let mut placed = Placed::new(arena, n, chart.confined);
        let matrix = mass_matrix(arena, &mut placed, &mixed.internal, chart.frame(), &basis);
        let mut shared = placed.shared;
        let factorisation = Factorisation::new(arena, Factorised::Internal, &matrix, &mut shared, chart)?;
        // The momentum conjugate to O_ab is M_ba.
        let conjugate = chart.m.transpose().0.concat();
        let momentum = |e: &BasisVector| chart.reduced(&along(e, |k| Polynomial::atom(conjugate[k])));
        let momenta: Vec<Polynomial> = basis.iter().map(momentum).collect();
        let velocity = Matrix::symbols(arena, chart.frame().velocity(), n).0.concat();
        let speeds: Vec<Expr> = match chart.confined {
            None => velocity.clone(),
            Some(_) => arena.components(Quantity::Speed, basis.len()),
        };
        factorisation.solve(arena, Factorised::Internal, &momenta, &speeds, &mut shared);
        let entries = velocity.into_iter().zip(composed(&basis, &speeds, n * n));
        shared.extend(entries.filter(|(symbol, _)| !speeds.contains(symbol)));
        Some(Self { shared, components: momenta.into_iter().zip(speeds).collect(), factorisation })
    }
}
