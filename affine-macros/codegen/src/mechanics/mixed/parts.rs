//! The energies of a sum as parts in the velocities of a chart.

use crate::algebra::ring::{Square, pairs};
use crate::algebra::{Arena, Expr, Matrix, Polynomial, Rational};
use crate::mechanics::charts::{Chart, Coordinate};
use crate::mechanics::kinetic::Kinetic;
use crate::mechanics::kinetics::{Lagrangian, Part};
use crate::mechanics::metric::Definitions;
use crate::mechanics::term::Frame;
use crate::mechanics::transport;
use crate::symbol::{Aspect, Quantity};

use super::Mixed;
use super::mass::same_blocks;
use super::placed::green;

impl Mixed {
    /// The internal energy in a chart; d'Alembert's in the velocity of the body `through_green`, if not in `phi_dot`.
    pub(super) fn lagrangian(
        &self,
        arena: &mut Arena,
        chart: &Chart,
        on_the_group: Definitions,
        through_green: bool,
    ) -> Lagrangian {
        let n = self.dim;
        let velocity = Matrix::symbols(arena, chart.frame().velocity(), n);
        let conjugate = pairs(n);
        let conjugate = conjugate.map(|(a, b)| (Coordinate::M(a, b), velocity.0[b][a])).collect();
        let part = |energy: &Kinetic| internal(arena, chart, &velocity, energy, through_green);
        let parts = self.internal.iter().map(part).collect();
        Lagrangian { chart: chart.clone(), conjugate, parts, on_the_group }
    }
}

fn internal(
    arena: &mut Arena,
    chart: &Chart,
    velocity: &Matrix,
    energy: &Kinetic,
    through_green: bool,
) -> Part {
    let n = chart.dim;
    let share = share(energy.frame);
    let own = Part {
        velocities: energy.velocity.0.concat(),
        definitions: None,
        energy: energy.internal_energy(),
        slopes: Vec::new(),
        momenta: shares(arena, share, &chart.m.0.concat()),
    };
    if energy.frame == chart.frame() {
        return own;
    }
    let (phi, psi, o) =
        (chart.placement(), Matrix::symbols(arena, Quantity::InversePlacement, n).atoms(), velocity.atoms());
    let form = energy.form();
    let stands_in_the_body = (energy.frame, chart.frame()) == (Frame::Flat, Frame::Body);
    if through_green && stands_in_the_body && same_blocks(&form, n) {
        let green = green(arena, n);
        return Part { velocities: velocity.0.concat(), energy: by_rows(&form, &o, &green), ..own };
    }
    let phi_dot = transport::velocity(chart.frame(), &o, &phi);
    let definitions = transport::velocity(energy.frame, &phi_dot, &psi);
    // The momentum conjugate to O_ab is X_ba.
    let slopes = Matrix::symbols(arena, energy.frame.momentum(), n).transpose().0.concat();
    Part { definitions: Some(definitions.concat()), slopes: shares(arena, share, &slopes), ..own }
}

/// `tr(phi_dot J phi_dot^T)/2 = tr(Oh J Oh^T G)/2`.
fn by_rows(form: &Square<Polynomial>, oh: &Square<Polynomial>, green: &Square<Polynomial>) -> Polynomial {
    let n = oh.len();
    let half = Rational::HALF;
    let mut energy = Polynomial::zero();
    for (a, b) in pairs(n) {
        for (c, d) in pairs(n) {
            energy.add_product(&form[c][d].mul(&green[a][b]), &oh[a][c].mul(&oh[b][d]), &half);
        }
    }
    energy
}

/// The share of the energies of a frame.
fn share(frame: Frame) -> Aspect {
    match frame {
        Frame::Body => Aspect::InTheBody,
        Frame::Space => Aspect::InSpace,
        Frame::Flat => Aspect::InPlacement,
    }
}

/// Symbols for what a part has of momenta.
pub(super) fn shares(arena: &mut Arena, part: Aspect, momenta: &[Expr]) -> Vec<Expr> {
    momenta.iter().map(|momentum| arena.about(part, *momentum)).collect()
}
