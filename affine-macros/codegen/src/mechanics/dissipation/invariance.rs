//! What a dissipation leaves as it is: rotations of space, pieces of `H` that commute.

use crate::algebra::Polynomial;
use crate::algebra::ring::{Square, pairs, skew, sum, table};
use crate::mechanics::brackets::poisson;
use crate::mechanics::charts::{Chart, Coordinate};
use crate::mechanics::hamiltonian::{Hamiltonian, Isotropic, spatial_or_own};
use crate::mechanics::symmetry::{Group, Side, broken_by};

use super::Dissipation;

impl Dissipation {
    /// Does no rotation of space change `R`?
    pub fn is_isotropic_in_space(&self) -> bool {
        self.parts.iter().all(|part| broken_by(&part.form, Side::Space, Group::Metric).is_none())
    }

    /// May the piece `|W|^2/(2 mu)` of `H`, `W` the vorticity or the spin, be applied apart from the rest? So it is
    /// where the forces leave `W` at rest, do not see the part `-W/mu` of the velocity, and the flow of the piece
    /// leaves them as they are: its Lie bracket with them vanishes.
    pub fn commutes_with_rotation(&self, chart: &Chart, h: &Hamiltonian, iso: &Isotropic) -> bool {
        let own = chart.frame();
        let centre =
            self.centre.iter().all(|(frame, _)| h.translation.as_ref().is_some_and(|(m, _)| m == frame));
        // Under a constraint the forces are projected: not decided.
        let confined = chart.confined.is_some();
        if confined || !centre || self.parts.iter().any(|part| part.form.frame != own) {
            return false;
        }
        let spin = spatial_or_own(chart);
        let rest = iso.casimirs(&spin);
        let without: Square<Polynomial> = table(chart.dim, |a, b| rest.derivative(chart.m.0[b][a]));
        let total = |velocity: &Square<Polynomial>| {
            let zero = table(chart.dim, |_, _| Polynomial::zero());
            self.parts.iter().fold(zero, |force, part| sum(&force, &part.force(velocity)))
        };
        let force = total(&h.velocity);
        if force != total(&without) || skew(&force).iter().any(|w| !w.is_zero()) {
            return false;
        }
        let piece = iso.skew_norm(&spin);
        chart.coordinates().into_iter().all(|z| {
            let along = |f: &Polynomial| -> Polynomial {
                pairs(chart.dim).map(|(a, b)| f.derivative(chart.m.0[a][b]).mul(&force[a][b])).sum()
            };
            let own_rate = match z {
                Coordinate::M(a, b) => force[a][b].clone(),
                // A multiple of p, which the piece leaves alone.
                Coordinate::X(_) | Coordinate::Phi(..) | Coordinate::P(_) | Coordinate::Carried(_) => {
                    Polynomial::zero()
                }
            };
            let there = poisson(chart, &own_rate, &piece);
            let back = along(&poisson(chart, &Polynomial::atom(chart.symbol(z)), &piece));
            there == back
        })
    }
}
