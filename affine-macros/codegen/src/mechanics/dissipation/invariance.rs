//! What a dissipation leaves as it is: conserved quantities, rotations of space, pieces of `H` that commute.

use crate::algebra::residue::Residue;
use crate::algebra::ring::{Ring, Square, adjugate, product, skew, sum, table, times, transpose};
use crate::algebra::{Arena, Polynomial, Rational};
use crate::mechanics::brackets::poisson;
use crate::mechanics::charts::{Chart, Coordinate};
use crate::mechanics::conserved::Candidate;
use crate::mechanics::flow::{Flow, Push, at_a_point};
use crate::mechanics::group_point::GroupPoint;
use crate::mechanics::hamiltonian::{Hamiltonian, Isotropic, spatial_or_own};
use crate::mechanics::symmetry::{Group, Side, broken_by};
use crate::mechanics::term::Frame;

use crate::mechanics::shared::frame_of;

use super::Dissipation;

impl Dissipation {
    /// Those of the candidates that the forces leave at rest, for all momenta; `chart` is that of the model's own
    /// frame, with `p` spatial. `T` is quadratic in the momenta, the forces are linear: the rates that they and the
    /// bracket with `H` give have different degrees, so that each has to vanish for itself.
    pub fn keeps(
        &self,
        arena: &Arena,
        chart: &Chart,
        h: &Hamiltonian,
        candidates: &[Candidate],
    ) -> Vec<Candidate> {
        // The forces take energy out of every motion that they act on.
        let mut list = candidates.to_vec();
        list.retain(|c| *c != Candidate::Energy);
        if let Some(group) = chart.confined {
            for point in GroupPoint::all(arena, chart, Some(group)) {
                let value = |p: &Polynomial| -> Residue { point.evaluate(arena, p) };
                let flow = Flow::vertical(chart, self.push(chart, h, &value), &value);
                list.retain(|c| flow.leaves(*c));
            }
            return list;
        }
        let (residue, itself) = (at_a_point(arena), Polynomial::clone);
        let sample = Flow::vertical(chart, self.push(chart, h, &residue), &residue);
        list.retain(|c| sample.leaves(*c));
        if !list.is_empty() {
            let symbolic = Flow::vertical(chart, self.push(chart, h, &itself), &itself);
            list.retain(|c| symbolic.leaves(*c));
        }
        list
    }

    /// The forces in the chart of the model's own frame, times a power of `det phi` where they contain `phi^-1`.
    fn push<R: Ring>(&self, chart: &Chart, h: &Hamiltonian, lift: &dyn Fn(&Polynomial) -> R) -> Push<R> {
        let n = chart.dim;
        let lifted = |m: &[Vec<Polynomial>]| table(n, |i, j| lift(&m[i][j]));
        let phi = table(n, |i, a| lift(&Polynomial::atom(chart.phi.0[i][a])));
        let cofactors = adjugate(&phi);
        let mut det = R::zero();
        phi[0].iter().zip(&cofactors).for_each(|(e, row)| det.plus_product(e, &row[0], &Rational::ONE));
        let own = lifted(&h.velocity);
        let phi_dot = match h.frame {
            Frame::Body => product(&phi, &own),
            Frame::Space => product(&own, &phi),
            Frame::Flat => own.clone(),
        };
        let weight = |frame: Frame| match frame {
            Frame::Flat => 0,
            frame if frame == h.frame => 1,
            _ => 2,
        };
        let mass = h.translation.as_ref().map(|(frame, _)| *frame);
        let centre_weight =
            |frame: Frame| if (Some(Frame::Space), Frame::Body) == (mass, frame) { 2 } else { 0 };
        let weights = self.parts.iter().map(|part| weight(part.form.frame));
        let all =
            weights.chain(self.centre.iter().map(|(frame, _)| centre_weight(*frame))).max().unwrap_or(0);
        let scaled = |value: &R, from: usize| {
            (from..all).fold(value.clone(), |value, _| {
                let mut product = R::zero();
                product.plus_product(&value, &det, &Rational::ONE);
                product
            })
        };

        let mut pi = table(n, |_, _| R::zero());
        for part in &self.parts {
            let frame = part.form.frame;
            let velocity = match frame {
                _ if frame == h.frame => own.clone(),
                Frame::Body => product(&cofactors, &phi_dot),
                Frame::Space => product(&phi_dot, &cofactors),
                Frame::Flat => phi_dot.clone(),
            };
            let velocity = velocity.concat();
            let drag = table(n, |a, b| {
                let mut force = R::zero();
                let row = &part.hessian.matrix[b * n + a];
                row.iter().zip(&velocity).for_each(|(h, o)| {
                    if !h.is_zero() {
                        force.plus_product(&lift(h), o, &Rational::MINUS_ONE);
                    }
                });
                force
            });
            let push = match frame {
                Frame::Body => product(&drag, &cofactors),
                Frame::Space => product(&cofactors, &drag),
                Frame::Flat => drag,
            };
            let push = table(n, |a, i| scaled(&push[a][i], weight(frame)));
            pi = sum(&pi, &push);
        }

        let mut push = Push { p: vec![R::zero(); chart.p.len()], pi };
        if let (Some(mass), false) = (mass, chart.p.is_empty()) {
            let p: Vec<R> = chart.p.iter().map(|p| lift(&Polynomial::atom(*p))).collect();
            for (frame, coefficient) in &self.centre {
                let slope = match (mass, frame) {
                    (Frame::Body, Frame::Space) => times(&phi, &times(&transpose(&phi), &p)),
                    (Frame::Space, Frame::Body) => times(&transpose(&cofactors), &times(&cofactors, &p)),
                    // The metric of the mass: a multiple of p.
                    _ => p.clone(),
                };
                let coefficient = lift(coefficient);
                for (sum, slope) in push.p.iter_mut().zip(&slope) {
                    sum.plus_product(
                        &scaled(slope, centre_weight(*frame)),
                        &coefficient,
                        &Rational::MINUS_ONE,
                    );
                }
            }
        }
        push
    }

    /// Does no rotation of space change `R`?
    #[must_use]
    pub fn is_isotropic_in_space(&self) -> bool {
        self.parts.iter().all(|part| broken_by(&part.form, Side::Space, Group::Metric).is_none())
    }

    /// May the piece `|W|^2/(2 mu)` of `H`, `W` the vorticity or the spin, be applied apart from the rest? So it is
    /// where the forces leave `W` at rest, do not see the part `-W/mu` of the velocity, and the flow of the piece
    /// leaves them as they are: its Lie bracket with them vanishes.
    #[must_use]
    pub fn commutes_with_rotation(&self, chart: &Chart, h: &Hamiltonian, iso: &Isotropic) -> bool {
        let own = frame_of(chart);
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
            let along = |f: &Polynomial| {
                let mut sum = Polynomial::zero();
                for (a, row) in force.iter().enumerate() {
                    for (b, push) in row.iter().enumerate() {
                        sum.add_product(&f.derivative(chart.m.0[a][b]), push, &Rational::ONE);
                    }
                }
                sum
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
