//! The rotation that the skew part of an isotropic energy makes: it is applied exactly.

use crate::algebra::passage::{Constant, Extent, MatrixFunction, Passage, Statement, Tensor, Word};
use crate::algebra::{Arena, Polynomial};
use crate::mechanics::body::Body;
use crate::mechanics::brackets::poisson;
use crate::mechanics::charts::{Chart, Momentum};
use crate::mechanics::conserved::Candidate;
use crate::mechanics::hamiltonian::spatial_or_own;
use crate::mechanics::term::Frame;
use crate::symbol::Quantity;

use super::left_out::{LeftOut, Scope};

/// `|W|^2/(2 mu)`, which commutes with the rest of `H`.
#[derive(Clone, Debug)]
pub struct Rotation {
    /// With the vorticity, `phi -> phi exp(-t Vort/mu)`, or with the spin, `phi -> exp(-t S/mu) phi`.
    pub frame: Frame,
    /// `1/mu`.
    pub inverse_mass: Polynomial,
}

impl Rotation {
    /// That of a motion, where it is proved to commute with the rest of the energy, the potential and the forces.
    pub(super) fn of(arena: &mut Arena, body: &Body) -> Option<Self> {
        let h = body.motion.hamiltonian()?;
        let iso = h.isotropic.as_ref().filter(|iso| !iso.skew.is_zero())?;
        let chart = body.motion.chart(arena, true);
        let spin = spatial_or_own(&chart);
        let rest = iso.casimirs(&spin).add(&h.translation_in(&chart));
        let norm = match h.frame {
            Frame::Body => Candidate::Vorticity,
            _ => Candidate::Spin,
        };
        let commutes = poisson(&chart, &iso.skew_norm(&spin), &rest).is_zero()
            && body.potential.is_none_or(|u| u.keeps(norm))
            && body.forces.commute_with_rotation(&chart, h, iso);
        commutes.then(|| Self { frame: h.frame, inverse_mass: iso.skew.clone() })
    }

    /// Does it turn the affine momentum of a chart?
    pub(super) fn turns(&self, chart: &Chart) -> bool {
        chart.momentum == Momentum::of(self.frame)
    }

    /// `W/mu` is kept, and `phi` and the spin that it turns are turned.
    pub(super) fn pass(&self, chart: &Chart, passage: &mut Passage) {
        let [spin, skew, rotation, placement] =
            [Word::Spin, Word::Skew, Word::Rotation, Word::Placement].map(Tensor::Variable);
        let of_spin = Tensor::OfPoint(Momentum::of(self.frame).quantity());
        let generator = Tensor::Scaled(Box::new(skew), Quantity::InverseMu);
        passage.inward.extend([
            Statement::Named(Word::Spin, of_spin),
            Statement::Named(Word::Skew, spin.clone().transposed().minus(spin)),
            Statement::Named(Word::Rotation, generator),
        ]);
        let meaning = "Generator of the rotation that commutes with the rest of the motion.";
        passage.constants.push(Constant::new(Word::Rotation, Extent::Matrix, meaning));
        let angle = Tensor::Constant(Word::Rotation).times(Tensor::Variable(Word::Elapsed));
        let turned = match self.frame {
            Frame::Body => placement.times(rotation.clone()),
            Frame::Space | Frame::Flat => rotation.clone().times(placement),
        };
        passage.outward.extend([
            Statement::Named(Word::Rotation, angle.under(MatrixFunction::Exponential)),
            Statement::Named(Word::Placement, turned),
        ]);
        if self.turns(chart) {
            passage.momentum = passage.momentum.take().map(|(of, momentum)| match self.frame {
                Frame::Body => (of, rotation.clone().transposed_times(momentum).times(rotation)),
                Frame::Space | Frame::Flat => {
                    (of, rotation.clone().times(momentum).times(rotation.transposed()))
                }
            });
        }
    }

    pub(super) fn left_out(&self) -> LeftOut {
        Scope::Reduction.without(match self.frame {
            Frame::Body => {
                "the |Vort|^2/(2 mu) of H: it commutes with the rest and is applied exactly, phi -> phi exp(-t Vort/mu)"
            }
            _ => "the |S|^2/(2 mu) of H: it commutes with the rest and is applied exactly, phi -> exp(-t S/mu) phi",
        })
    }
}
