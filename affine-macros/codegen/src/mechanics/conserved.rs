//! What a motion conserves: a candidate is listed exactly when its rate vanishes identically.
//!
//! Written out, the rates of a mass matrix that depends on the placement are long rational functions. Whether they vanish is
//! decided modulo the prime `2^61 - 1`, at points that have nothing to do with the model.

use crate::algebra::residue::Residue;
use crate::algebra::ring::{Ring, Square, deviator, skew, sum};
use crate::algebra::{Arena, Polynomial, Rational};

use super::charts::Chart;
use super::constraint::Constraint;
use super::equations::Load;
use super::flow::{Flow, power_rate};
use super::group_point::GroupPoint;

/// What a model may conserve, named as in the runtime.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Candidate {
    /// Energy `H`.
    Energy,
    /// `p`
    LinearMomentum,
    /// `p_hat = phi^T p`
    ComovingLinearMomentum,
    /// `x p^T - p x^T`
    OrbitalAngularMomentum,
    /// `I(O) = x p^T + Sigma`
    TotalAffineMomentum,
    /// `I(O) - I(O)^T`
    TotalAngularMomentum,
    /// `Sigma`
    AffineSpin,
    /// traceless part of `Sigma`
    Deviator,
    /// `S = Sigma - Sigma^T`
    Spin,
    /// `|S|^2`
    SpinNorm,
    /// `Sigma_hat`
    ComovingAffineSpin,
    /// traceless part of `Sigma_hat`
    ComovingDeviator,
    /// `Vort = Sigma_hat - Sigma_hat^T`
    Vorticity,
    /// `|Vort|^2`
    VorticityNorm,
    /// `Pi`
    CanonicalMomentum,
    /// `tr Sigma`
    Casimir1,
    /// `tr Sigma^2`
    Casimir2,
    /// `tr Sigma^3`
    Casimir3,
    /// `tr sigma^2` of the deviator
    DeviatorCasimir2,
    /// `tr sigma^3` of the deviator
    DeviatorCasimir3,
}

impl Candidate {
    const ALL: [Candidate; 20] = [
        Candidate::Energy,
        Candidate::LinearMomentum,
        Candidate::ComovingLinearMomentum,
        Candidate::OrbitalAngularMomentum,
        Candidate::TotalAffineMomentum,
        Candidate::TotalAngularMomentum,
        Candidate::AffineSpin,
        Candidate::Deviator,
        Candidate::Spin,
        Candidate::SpinNorm,
        Candidate::ComovingAffineSpin,
        Candidate::ComovingDeviator,
        Candidate::Vorticity,
        Candidate::VorticityNorm,
        Candidate::CanonicalMomentum,
        Candidate::Casimir1,
        Candidate::Casimir2,
        Candidate::Casimir3,
        Candidate::DeviatorCasimir2,
        Candidate::DeviatorCasimir3,
    ];

    /// Does the quantity exist for a model of this dimension, with or without translation?
    fn exists(self, dim: usize, translation: bool) -> bool {
        match self {
            Candidate::LinearMomentum
            | Candidate::ComovingLinearMomentum
            | Candidate::OrbitalAngularMomentum
            | Candidate::TotalAffineMomentum
            | Candidate::TotalAngularMomentum => translation,
            Candidate::Casimir3 | Candidate::DeviatorCasimir3 => dim == 3,
            _ => true,
        }
    }

    /// Is it under the constraint neither a number nor another candidate under a second name? `Sigma` is traceless for
    /// SL(n) and `S/2` for SO(n); where `phi` is a rotation up to scale, `|Vort| = |S|` and the deviator is `S/2`.
    fn means_something(self, group: Constraint) -> bool {
        let deviators = matches!(
            self,
            Candidate::Deviator
                | Candidate::ComovingDeviator
                | Candidate::DeviatorCasimir2
                | Candidate::DeviatorCasimir3
        );
        let casimirs = matches!(self, Candidate::Casimir1 | Candidate::Casimir2 | Candidate::Casimir3);
        let spins = matches!(self, Candidate::AffineSpin | Candidate::ComovingAffineSpin);
        match group {
            Constraint::Isochoric => !deviators && self != Candidate::Casimir1,
            Constraint::Rigid => !deviators && !casimirs && !spins && self != Candidate::VorticityNorm,
            Constraint::Conformal => !deviators && self != Candidate::VorticityNorm,
        }
    }
}

/// The quantities that exist in a chart.
#[must_use]
pub fn candidates(chart: &Chart) -> Vec<Candidate> {
    let exists = |c: &Candidate| {
        c.exists(chart.dim, chart.linear.is_some())
            && chart.confined.is_none_or(|group| c.means_something(group))
    };
    Candidate::ALL.into_iter().filter(exists).collect()
}

/// Those of the candidates that stay what they are where the loads together move the coordinates of a chart with spatial
/// `p`: the motion of an energy, or forces alone.
#[must_use]
pub fn still(arena: &Arena, chart: &Chart, loads: &[Load], mut candidates: Vec<Candidate>) -> Vec<Candidate> {
    for mut point in GroupPoint::all(arena, chart, chart.confined) {
        loads.iter().for_each(|load| point.define(arena, &load.shared));
        let flow = Flow::new(chart, loads, &|p: &Polynomial| point.evaluate(arena, p));
        candidates.retain(|candidate| flow.rate(*candidate).iter().all(Ring::vanishes));
    }
    candidates
}

impl Flow {
    /// The components of the rate of a candidate, up to common factors that do not vanish.
    fn rate(&self, candidate: Candidate) -> Vec<Residue> {
        let ([sigma, sigma_dot], [sigma_hat, sigma_hat_dot]) = (&self.sigma, &self.sigma_hat);
        let total = || sum(&self.orbital_rate(), sigma_dot);
        let shear = || [deviator(sigma), deviator(sigma_dot)];
        match candidate {
            Candidate::Energy => Vec::new(),
            Candidate::LinearMomentum => self.p[1].clone(),
            Candidate::ComovingLinearMomentum => self.comoving_momentum_rate(),
            Candidate::OrbitalAngularMomentum => skew(&self.orbital_rate()),
            Candidate::TotalAffineMomentum => total().concat(),
            Candidate::TotalAngularMomentum => skew(&total()),
            Candidate::AffineSpin => sigma_dot.concat(),
            Candidate::Deviator => deviator(sigma_dot).concat(),
            Candidate::Spin => skew(sigma_dot),
            Candidate::SpinNorm => norm_rate(sigma, sigma_dot),
            Candidate::ComovingAffineSpin => sigma_hat_dot.concat(),
            Candidate::ComovingDeviator => deviator(sigma_hat_dot).concat(),
            Candidate::Vorticity => skew(sigma_hat_dot),
            Candidate::VorticityNorm => norm_rate(sigma_hat, sigma_hat_dot),
            Candidate::CanonicalMomentum => self.pi[1].concat(),
            // Sigma and Sigma_hat have the same traces.
            Candidate::Casimir1 => power_rate(1, &self.sigma),
            Candidate::Casimir2 => power_rate(2, &self.sigma),
            Candidate::Casimir3 => power_rate(3, &self.sigma),
            Candidate::DeviatorCasimir2 => power_rate(2, &shear()),
            Candidate::DeviatorCasimir3 => power_rate(3, &shear()),
        }
    }
}

/// Half the rate of the squared norm of the skew part.
fn norm_rate(m: &Square<Residue>, m_dot: &Square<Residue>) -> Vec<Residue> {
    let mut rate = Residue::ZERO;
    for (w, w_dot) in skew(m).iter().zip(&skew(m_dot)) {
        rate.plus_product(w, w_dot, &Rational::ONE);
    }
    vec![rate]
}
