//! Conserved quantities by exact brackets: a candidate is listed exactly when its bracket with `H` vanishes
//! identically.

use crate::algebra::residue::Residue;
use crate::algebra::ring::{Ring, Square, deviator, skew, sum};
use crate::algebra::{Arena, Polynomial};

use super::brackets::gradient;
use super::charts::{Chart, Coordinate};
use super::constraint::Constraint;
use super::flow::{Flow, at_a_point, norm_rate, power_rate};
use super::group_point::GroupPoint;
use super::weight;

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

/// The candidates that `h` conserves, a polynomial in the chart of the model's own frame with `p` spatial.
#[must_use]
pub fn conserved(arena: &Arena, chart: &Chart, h: &Polynomial) -> Vec<Candidate> {
    let exists = |c: &Candidate| {
        c.exists(chart.dim, chart.linear.is_some())
            && chart.confined.is_none_or(|group| c.means_something(group))
    };
    still(arena, chart, h, Candidate::ALL.into_iter().filter(exists).collect())
}

/// The candidates whose brackets vanish at the points that `points` evaluate at; `slopes` are the derivatives of `H`.
pub(super) fn conserved_at_points(
    chart: &Chart,
    slopes: &[(Coordinate, Polynomial)],
    points: &[&dyn Fn(&Polynomial) -> Residue],
) -> Vec<Candidate> {
    let mut list = Candidate::ALL.to_vec();
    list.retain(|c| c.exists(chart.dim, chart.linear.is_some()));
    list.retain(|c| chart.confined.is_none_or(|group| c.means_something(group)));
    for point in points {
        let flow = Flow::new(chart, slopes, point);
        list.retain(|c| flow.bracket(*c).iter().all(Ring::vanishes));
    }
    list
}

/// Those of the candidates whose brackets with `h` vanish.
fn still(arena: &Arena, chart: &Chart, h: &Polynomial, candidates: Vec<Candidate>) -> Vec<Candidate> {
    let mut slopes = gradient(chart, h);
    if let Some(group) = chart.confined {
        slopes.extend(weight::slopes(arena, chart, h));
        let mut list = candidates;
        for point in GroupPoint::all(arena, chart, Some(group)) {
            let value = |p: &Polynomial| -> Residue { point.evaluate(arena, p) };
            let flow = Flow::new(chart, &slopes, &value);
            list.retain(|c| flow.bracket(*c).iter().all(Ring::vanishes));
        }
        return list;
    }
    let (residue, itself) = (at_a_point(arena), Polynomial::clone);
    let sample = Flow::new(chart, &slopes, &residue);
    let symbolic = Flow::new(chart, &slopes, &itself);
    let mut list = candidates;
    list.retain(|c| sample.leaves(*c) && symbolic.leaves(*c));
    list
}

impl<R: Ring> Flow<'_, R> {
    /// Does the flow leave the candidate at rest?
    pub(super) fn leaves(&self, candidate: Candidate) -> bool {
        self.bracket(candidate).iter().all(Ring::vanishes)
    }

    /// The components of `{candidate, H}`, up to common factors that do not vanish.
    fn bracket(&self, candidate: Candidate) -> Vec<R> {
        match candidate {
            Candidate::Energy => Vec::new(),
            Candidate::LinearMomentum => self.p_dot(),
            Candidate::ComovingLinearMomentum => self.comoving_momentum_rate(),
            Candidate::OrbitalAngularMomentum => skew(&self.orbital_rate()),
            Candidate::TotalAffineMomentum => sum(&self.orbital_rate(), self.sigma_dot()).concat(),
            Candidate::TotalAngularMomentum => skew(&sum(&self.orbital_rate(), self.sigma_dot())),
            Candidate::AffineSpin => self.sigma_dot().concat(),
            Candidate::Deviator => deviator(self.sigma_dot()).concat(),
            Candidate::Spin => skew(self.sigma_dot()),
            Candidate::SpinNorm => norm_rate(&self.sigma_up_to_scale(), self.sigma_dot()),
            Candidate::ComovingAffineSpin => self.sigma_hat_dot().concat(),
            Candidate::ComovingDeviator => deviator(self.sigma_hat_dot()).concat(),
            Candidate::Vorticity => skew(self.sigma_hat_dot()),
            Candidate::VorticityNorm => norm_rate(&self.sigma_hat_up_to_scale(), self.sigma_hat_dot()),
            Candidate::CanonicalMomentum => self.canonical_rate().concat(),
            Candidate::Casimir1 => self.casimir_rate(1, Clone::clone),
            Candidate::Casimir2 => self.casimir_rate(2, Clone::clone),
            Candidate::Casimir3 => self.casimir_rate(3, Clone::clone),
            Candidate::DeviatorCasimir2 => self.casimir_rate(2, deviator),
            Candidate::DeviatorCasimir3 => self.casimir_rate(3, deviator),
        }
    }

    /// Rate of the trace of a power of the affine spin or of its deviator. `Sigma` and `Sigma_hat` have the same
    /// traces, so one of them at rest settles it.
    fn casimir_rate(&self, k: usize, part: impl Fn(&Square<R>) -> Square<R>) -> Vec<R> {
        let at_rest = |rate: &Square<R>| rate.iter().flatten().all(Ring::vanishes);
        if at_rest(self.sigma_dot()) || at_rest(self.sigma_hat_dot()) {
            return Vec::new();
        }
        power_rate(k, &part(&self.spin()), &part(self.spin_rate()))
    }
}
