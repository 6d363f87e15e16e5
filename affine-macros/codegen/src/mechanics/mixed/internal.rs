//! The internal motion of a sum of energies, whose mass matrix depends on the placement.
//!
//! It is written over `phi_dot` and `Pi`, and where it is confined to a group over `Oh` and `Sigma_hat`: the Lie algebra does
//! not turn with `phi`.

use crate::algebra::ring::{Square, table};
use crate::algebra::{Arena, Expr, Matrix, Polynomial, Rational};
use crate::mechanics::charts::{Chart, Momentum};
use crate::mechanics::constraint::Constraint;
use crate::mechanics::kinetics::{Kinetics, Lagrangian};
use crate::mechanics::metric::{Definitions, Metric};
use crate::mechanics::shared::{atoms, frame_of};
use crate::mechanics::term::Frame;
use crate::symbol::Factorised;

use super::Mixed;
use super::confined::{Solved, on_the_algebra};
use super::factorisation::Factorisation;
use super::placed::Placed;

/// The Legendre transformation of the internal motion.
#[derive(Clone, Debug)]
pub struct Legendre {
    /// Quantities on the way from `phi` and the velocity.
    pub shared: Definitions,
    /// `(dT/dO)^T`, projected under a constraint.
    pub momentum: Square<Polynomial>,
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
    /// The energy as its forces are derived from it.
    lagrangian: Lagrangian,
}

impl Internal {
    /// Inverts the Legendre transformation; `None` where the mass matrix is singular at every placement.
    pub fn new(arena: &mut Arena, mixed: &Mixed) -> Option<Self> {
        let momentum = if mixed.constraint.is_some() { Momentum::Body } else { Momentum::Canonical };
        let chart = Chart::new(arena, mixed.dim, momentum, None).under(mixed.constraint);
        let Solved { shared, components, factorisation } = match mixed.constraint {
            None => on_all_matrices(arena, mixed, &chart)?,
            Some(group) => on_the_algebra(arena, mixed, &chart, group)?,
        };
        let half = Rational::HALF;
        let mut energy = Polynomial::zero();
        for (momentum, speed) in &components {
            energy.add_product(momentum, &Polynomial::atom(*speed), &half);
        }
        let on_the_group = Placed::new(arena, mixed.dim, mixed.constraint).values(arena);
        let lagrangian = mixed.lagrangian(arena, &chart, on_the_group, true);
        let velocity = Matrix::symbols(arena, frame_of(&chart).velocity(), mixed.dim);
        Some(Self { shared, velocity, factorisation, energy, lagrangian })
    }

    /// The group that the motion is confined to.
    #[must_use]
    pub fn group(&self) -> Option<Constraint> {
        self.lagrangian.chart.confined
    }

    /// The frame of velocity and momentum.
    #[must_use]
    pub fn frame(&self) -> Frame {
        frame_of(&self.lagrangian.chart)
    }

    /// Hamilton's equations, in each way that may be the shortest.
    pub fn kinetics(&self, arena: &mut Arena) -> Vec<Kinetics> {
        self.lagrangian.kinetics(arena, &self.velocity, &self.shared)
    }

    /// The Legendre transformation, in each form that may be the shortest.
    pub fn legendre(&self, arena: &mut Arena, mixed: &Mixed) -> [Legendre; 2] {
        let placed = Placed::new(arena, mixed.dim, mixed.constraint);
        let on_the_group = placed.values(arena);
        // Where G is no multiple of 1, nothing else here needs it.
        let through_green = placed.inverse_square.is_some();
        let lagrangian = mixed.lagrangian(arena, &self.lagrangian.chart, on_the_group, through_green);
        [false, true].map(|by_names| {
            let (shared, momentum, energy) = lagrangian.legendre(by_names);
            let shared = [placed.shared.clone(), shared].concat();
            let n = self.velocity.dim();
            let momentum = table(n, |a, b| momentum[n * a + b].clone());
            self.projected(Legendre { shared, momentum, energy })
        })
    }

    fn projected(&self, legendre: Legendre) -> Legendre {
        let Some(group) = self.group() else { return legendre };
        let Legendre { shared, momentum, energy } = legendre;
        // Of the entries of Oh those that determine the others.
        let dependent = group.dependent(&self.velocity);
        let value = |atom: Expr| dependent.iter().find(|(s, _)| *s == atom).map(|(_, value)| value.clone());
        let projected = group.projected(&momentum);
        Legendre {
            shared: shared.into_iter().map(|(symbol, p)| (symbol, p.substitute(&value))).collect(),
            momentum: table(self.velocity.dim(), |a, b| projected[a][b].substitute(&value)),
            energy: energy.substitute(&value),
        }
    }
}

/// The velocity `phi_dot` of a motion that nothing confines.
fn on_all_matrices(arena: &mut Arena, mixed: &Mixed, chart: &Chart) -> Option<Solved> {
    let Metric { mut shared, internal, .. } = Metric::new(arena, mixed.dim, &mixed.internal);
    let factorisation = Factorisation::new(arena, Factorised::Internal, &internal, &mut shared, chart)?;
    // The momentum conjugate to phi_dot_iA is Pi_Ai.
    let momenta = atoms(&chart.m.transpose()).concat();
    let velocity = Matrix::symbols(arena, Frame::Flat.velocity(), mixed.dim).0.concat();
    factorisation.solve(arena, Factorised::Internal, &momenta, &velocity, &mut shared);
    Some(Solved { shared, components: momenta.into_iter().zip(velocity).collect(), factorisation })
}
