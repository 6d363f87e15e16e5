//! What a motion conserves: a candidate is listed exactly when its rate vanishes identically, and besides a basis of the linear
//! momenta whose rates do.
//!
//! Written out, the rates of a mass matrix that depends on the placement are long rational functions. Whether they vanish is
//! decided modulo the prime `2^61 - 1`, at points that have nothing to do with the model. The rates of the linear momenta at one
//! point are one equation for the combinations that are conserved; their common solutions are those of all of them as soon as
//! further points bring no further equation. The entries that are combined stand in the bases that the user states the model in.

mod candidate;
mod components;
mod momenta;
mod restated;

use crate::algebra::evaluate::Field;
use crate::algebra::residue::Residue;
use crate::algebra::ring::{Ring, Square, deviator, dot, scalar, skew, table};
use crate::algebra::{Arena, Matrix, Polynomial, Rational};

use super::charts::Chart;
use super::equations::Load;
use super::flow::{Flow, power_rate};
use super::group_point::{GroupPoint, POINTS, inverse};
use super::metrics::Bases;

pub use candidate::{Candidate, Entry, candidates};
use components::{Rates, until_nothing_is_new};
pub(super) use momenta::Momenta;
use momenta::{Factors, Layout};

/// What stays what it is, of what a chart has, under everything that was looked at.
#[derive(Clone, Debug)]
#[must_use]
pub struct Conservation {
    /// The momenta, and functions of them, that are conserved as a whole.
    pub whole: Vec<Candidate>,
    chart: Chart,
    /// `A^-1` of space and `B` of the body, where the user's bases are not orthonormal.
    bases: Option<[Matrix; 2]>,
    rates: Rates,
}

impl Conservation {
    /// Everything that a chart with spatial `p` has, where nothing acts.
    pub fn of(chart: &Chart, bases: Option<&[Matrix; 2]>) -> Self {
        let layout = Layout { dim: chart.dim, moves: chart.linear.is_some(), is_given: true };
        let whole = candidates(chart);
        Self {
            rates: Rates::none(layout, &whole, bases.is_none()),
            whole,
            chart: chart.clone(),
            bases: bases.cloned(),
        }
    }

    /// The change of bases at a point.
    fn factors(&self, arena: &Arena, seed: usize) -> Factors {
        let one = || scalar(self.chart.dim, &Residue::from_rational(&Rational::ONE));
        let Some(bases) = &self.bases else { return [0, 1].map(|_| [one(), one()]) };
        let point = GroupPoint::numbered(arena, &self.chart, self.chart.confined, seed);
        let [space_inverse, body] =
            bases.each_ref().map(|factor| table(factor.dim(), |i, j| point.of_atom(arena, factor.0[i][j])));
        [[inverse(&space_inverse), space_inverse], [body.clone(), inverse(&body)]]
    }

    /// What stays where the loads together move the coordinates: the motion of an energy, or forces alone.
    pub fn under(&mut self, arena: &Arena, loads: &[Load]) {
        until_nothing_is_new(|seed| {
            let chart = &self.chart;
            let mut point = GroupPoint::numbered(arena, chart, chart.confined, seed);
            loads.iter().for_each(|load| point.define(arena, &load.shared));
            let flow = Flow::new(chart, loads, &|p: &Polynomial| point.evaluate(arena, p));
            let ([_, rates], factors) = (flow.momenta(), self.factors(arena, seed));
            if seed < POINTS {
                self.whole.retain(|candidate| flow.keeps(*candidate, &rates));
            }
            self.rates.see(&rates, &factors)
        });
    }

    /// What stays under forces of which no more is known than the rates of the momenta at points: they keep of the candidates
    /// what these leave at rest, and the energy or not.
    pub(super) fn under_forces(&mut self, arena: &Arena, energy: bool, rates: &dyn Fn(usize) -> Momenta) {
        self.whole.retain(|candidate| energy || *candidate != Candidate::Energy);
        until_nothing_is_new(|seed| {
            let rates = match self.rates.moves() {
                true => rates(seed),
                false => rates(seed).internal(),
            };
            if seed < POINTS {
                self.whole.retain(|candidate| rates.keep(*candidate));
            }
            let factors = self.factors(arena, seed);
            self.rates.see(&rates, &factors)
        });
    }

    /// The combinations of entries of momenta that are conserved besides, none of which follows from others or from momenta that
    /// are conserved as a whole; `bases` are those of metrics that are numbers.
    pub fn components(&self, arena: &Arena, bases: Option<&Bases>) -> Vec<Vec<Entry>> {
        let chart = &self.chart;
        let values = |seed| {
            let point = GroupPoint::numbered(arena, chart, chart.confined, seed);
            let [values, _] = Flow::new(chart, &[], &|p: &Polynomial| point.evaluate(arena, p)).momenta();
            values
        };
        let values: Option<&dyn Fn(usize) -> Momenta> = chart.confined.is_some().then_some(&values);
        self.rates.components(&self.whole, (&self.factors(arena, 0), bases), values)
    }
}

impl Flow {
    /// Does the candidate stay what it is, by the rates of the linear momenta?
    fn keeps(&self, candidate: Candidate, rates: &Momenta) -> bool {
        let shear = || [deviator(&self.sigma[0]), deviator(&self.sigma[1])];
        match candidate {
            Candidate::Energy => true,
            Candidate::SpinNorm => norm_rate(&self.sigma).vanishes(),
            Candidate::VorticityNorm => norm_rate(&self.sigma_hat).vanishes(),
            Candidate::Casimir2 => power_rate(2, &self.sigma).vanishes(),
            Candidate::Casimir3 => power_rate(3, &self.sigma).vanishes(),
            Candidate::DeviatorCasimir2 => power_rate(2, &shear()).vanishes(),
            Candidate::DeviatorCasimir3 => power_rate(3, &shear()).vanishes(),
            momentum => rates.keep(momentum),
        }
    }
}

/// Half the rate of the squared norm of the skew part.
fn norm_rate([m, m_dot]: &[Square<Residue>; 2]) -> Residue {
    dot(skew(m).iter().zip(&skew(m_dot)))
}
