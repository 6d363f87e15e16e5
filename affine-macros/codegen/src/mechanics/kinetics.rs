//! Hamilton's equations of any energy from its velocities, its forces and the brackets.
//!
//! ```text
//! dz/dt = sum over momenta y of {z, y} dH/dy + F_z,   F_z = sum over positions q of {z, q} dH/dq
//! ```
//!
//! The velocities `dH/dy` are polynomials in the momenta, or quantities that solve the Legendre transformation at a
//! placement. The forces `F` are zero where `H` depends on the momenta of the chart alone.

mod action;
mod lagrangian;
mod ways;

use crate::algebra::ring::{Square, pairs, table};
use crate::algebra::substitute::listed;
use crate::algebra::{Arena, Matrix, Polynomial};

use super::brackets::{bracket, gradient};
use super::charts::{Chart, Coordinate, Momentum};
use super::equations::{Form, Load, System};
use super::metric::Definitions;

pub use lagrangian::{Lagrangian, Part, named};

/// An energy in a chart, as far as its motion depends on it.
#[derive(Clone, Debug)]
#[must_use]
pub struct Kinetics {
    /// The chart.
    pub chart: Chart,
    /// The affine velocity `(dH/dM)^T` as symbols.
    pub velocity: Matrix,
    /// Definitions of the velocities, and of what the forces share.
    pub shared: Definitions,
    /// `dH/dy` of the momenta `y` that the energy depends on.
    slopes: Vec<(Coordinate, Polynomial)>,
    /// `F` of the momenta that have a force.
    forces: Vec<(Coordinate, Polynomial)>,
}

impl Kinetics {
    /// Of an energy that is a polynomial in the coordinates of a chart.
    pub fn polynomial(arena: &mut Arena, chart: &Chart, h: &Polynomial) -> Self {
        let velocity = chart.velocity(arena);
        let (slopes, positions): (Vec<_>, Vec<_>) =
            gradient(chart, h).into_iter().partition(|(y, _)| y.is_momentum());
        let force = |z: Coordinate| (z, paired(chart, z, &positions));
        let momenta = chart.coordinates().into_iter().filter(|z| z.is_momentum());
        let shared =
            pairs(chart.dim).map(|(a, b)| (velocity.0[a][b], h.derivative(chart.m.0[b][a]))).collect();
        let forces = momenta.map(force).filter(|(_, force)| !force.is_zero()).collect();
        Self { chart: chart.clone(), velocity, shared, slopes, forces }
    }

    /// The same energy in a chart that has a spatial `p` besides.
    pub fn beside(&self, chart: &Chart) -> Self {
        Self { chart: chart.clone(), ..self.clone() }
    }

    /// The affine velocity in a form.
    pub fn affine_velocity(&self, form: Form) -> Square<Polynomial> {
        let written = |a: usize, b: usize| match form {
            Form::ThroughVelocity => Polynomial::atom(self.velocity.0[a][b]),
            Form::Expanded => listed(&self.slopes)(Coordinate::M(b, a)).unwrap_or_else(Polynomial::zero),
        };
        table(self.chart.dim, written)
    }

    /// `dz/dt`.
    pub fn rate(&self, form: Form, z: Coordinate) -> Polynomial {
        let slope = |(y, slope): &(Coordinate, Polynomial)| match (form, *y) {
            (Form::ThroughVelocity, Coordinate::M(a, b)) => (*y, Polynomial::atom(self.velocity.0[b][a])),
            _ => (*y, slope.clone()),
        };
        let slopes: Vec<_> = self.slopes.iter().map(slope).collect();
        let forces = self.forces.iter().filter(|(y, _)| *y == z).map(|(_, force)| force);
        paired(&self.chart, z, &slopes).add(&forces.sum())
    }

    /// Hamilton's equations of all coordinates: placement through the velocity, momenta in the given form.
    pub fn system(&self, momenta: Form) -> System {
        let rate = |z: Coordinate| {
            let form = match z {
                Coordinate::Phi(..) => Form::ThroughVelocity,
                Coordinate::M(..) => momenta,
                // With I(O) as momentum the velocity of x is a difference that cancels.
                Coordinate::X(_) | Coordinate::P(_) if self.chart.momentum == Momentum::Total => {
                    Form::Expanded
                }
                Coordinate::X(_) | Coordinate::P(_) | Coordinate::Carried(_) => Form::ThroughVelocity,
            };
            (z, self.chart.symbol(z), self.rate(form, z))
        };
        let rates = self.chart.coordinates().into_iter().map(rate).collect();
        let system = System { shared: self.shared.clone(), rates, ..System::default() };
        system.confined(&self.chart, &self.velocity)
    }

    /// What it adds to the equations of another energy in the same chart, before any projection.
    pub fn load(&self) -> Load {
        let rate = |z: Coordinate| (z, self.rate(Form::ThroughVelocity, z));
        let forces = self.chart.coordinates().into_iter().map(rate).filter(|(_, rate)| !rate.is_zero());
        Load { shared: self.shared.clone(), forces: forces.collect(), ..Load::default() }
    }
}

/// `sum over y of {z, y} slope_y`.
fn paired(chart: &Chart, z: Coordinate, slopes: &[(Coordinate, Polynomial)]) -> Polynomial {
    slopes.iter().map(|(y, slope)| bracket(chart, z, *y).mul(slope)).sum()
}
