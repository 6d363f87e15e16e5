//! Quantities that forces share: velocities, `phi^-1`, forces themselves.

use crate::algebra::ring::{Square, adjugate, determinant, pairs, table, times, transpose};
use crate::algebra::{Arena, Expr, Polynomial};
use crate::symbol::{Quantity, Symbol};

use super::charts::{Chart, Coordinate, Linear, Momentum};
use super::metric::{Definitions, share};
use super::term::Frame;
use super::transport;

/// How the velocity of the centre of mass is known.
#[derive(Clone, Debug)]
pub enum CentreVelocity {
    /// The centre stands still.
    Fixed,
    /// From its momentum in the frame of the mass, by `1/m`.
    PerMass(Frame, Polynomial),
    /// As symbols, which the equations define.
    Defined {
        /// `x_dot`.
        x_dot: Vec<Expr>,
        /// `v_hat = phi^-1 x_dot`, where they define it too.
        v_hat: Option<Vec<Expr>>,
    },
}

/// Quantities that forces share.
pub(super) struct Shared<'a> {
    pub(super) arena: &'a mut Arena,
    pub(super) list: Definitions,
}

impl Shared<'_> {
    /// The value under a name; what needs no name has none.
    pub(super) fn named(&mut self, symbol: impl Into<Symbol>, value: &Polynomial) -> Polynomial {
        if value.is_zero() || value.as_atom().is_some() {
            return value.clone();
        }
        let symbol = self.arena.symbol(symbol);
        share(&mut self.list, [(symbol, value.clone())]);
        Polynomial::atom(symbol)
    }

    pub(super) fn vector(&mut self, of: Quantity, values: &[Polynomial]) -> Vec<Polynomial> {
        values.iter().enumerate().map(|(i, value)| self.named(of.at([i + 1]), value)).collect()
    }

    pub(super) fn matrix(
        &mut self,
        of: impl Into<Symbol>,
        values: &Square<Polynomial>,
    ) -> Square<Polynomial> {
        let of = of.into();
        let mut result = values.clone();
        for (i, j) in pairs(values.len()) {
            result[i][j] = self.named(of.at([i + 1, j + 1]), &values[i][j]);
        }
        result
    }

    /// `phi^-1`, with the names that potentials have for the determinant and its reciprocal.
    pub(super) fn inverse(&mut self, phi: &Square<Polynomial>) -> Square<Polynomial> {
        let cofactors = adjugate(phi);
        let _ = self.named(Quantity::Determinant, &determinant(phi));
        let det = self.arena.symbol(Quantity::Determinant);
        // A symbol is not the number zero.
        let reciprocal = Polynomial::atom(self.arena.reciprocal(det));
        let inverse_det = self.arena.symbol(Quantity::InverseDeterminant);
        share(&mut self.list, [(inverse_det, reciprocal)]);
        let inverse_det = Polynomial::atom(inverse_det);
        let inverse = table(phi.len(), |a, i| cofactors[a][i].mul(&inverse_det));
        self.matrix(Quantity::InversePlacement, &inverse)
    }

    /// `phi_dot` through the affine velocity of the chart.
    pub(super) fn phi_dot(&mut self, chart: &Chart) -> Square<Polynomial> {
        let own = chart.velocity(self.arena).atoms();
        transport::velocity(chart.frame(), &own, &chart.placement())
    }

    /// `x_dot`; nothing where the chart has no `p`.
    pub(super) fn x_dot(&mut self, chart: &Chart, centre: &CentreVelocity) -> Vec<Polynomial> {
        let Some(linear) = chart.linear else { return Vec::new() };
        let (own, inverse_mass) = match centre {
            CentreVelocity::Fixed => return Vec::new(),
            CentreVelocity::Defined { x_dot, .. } => {
                return Polynomial::vector(x_dot);
            }
            CentreVelocity::PerMass(own, inverse_mass) => (own, inverse_mass),
        };
        let phi = chart.placement();
        let per_mass: Vec<Polynomial> =
            Polynomial::vector(&chart.p).iter().map(|p| p.mul(inverse_mass)).collect();
        match (linear, own) {
            (Linear::Body, _) => times(&phi, &per_mass),
            (Linear::Space, Frame::Body) => {
                let v_hat =
                    self.vector(Quantity::ComovingCentreVelocity, &times(&transpose(&phi), &per_mass));
                times(&phi, &v_hat)
            }
            (Linear::Space, _) => per_mass,
        }
    }
}

/// `phi^-1`, with what defines it.
pub(super) fn inverse_placement(
    arena: &mut Arena,
    phi: &Square<Polynomial>,
) -> (Square<Polynomial>, Definitions) {
    let mut shared = Shared { arena, list: Definitions::new() };
    (shared.inverse(phi), shared.list)
}

/// The forces on the momenta of a chart by those on its affine spin and on its `p`, if it has one: `I(O) = Sigma + x p^T`.
pub(super) fn on_momenta(
    chart: &Chart,
    affine: &Square<Polynomial>,
    centre: Vec<Polynomial>,
) -> Vec<(Coordinate, Polynomial)> {
    let on_spin = |(a, b): (usize, usize)| {
        let force = match (chart.momentum, centre.get(b)) {
            (Momentum::Total, Some(push)) => affine[a][b].add(&Polynomial::atom(chart.x[a]).mul(push)),
            _ => affine[a][b].clone(),
        };
        (Coordinate::M(a, b), force)
    };
    let mut forces: Vec<_> = pairs(chart.dim).map(on_spin).collect();
    forces.extend(centre.into_iter().enumerate().map(|(i, force)| (Coordinate::P(i), force)));
    forces
}
