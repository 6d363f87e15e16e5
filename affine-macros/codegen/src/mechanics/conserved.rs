//! What a motion conserves: a candidate is listed exactly when its rate vanishes identically, and besides a basis of the linear
//! momenta whose rates do.
//!
//! Written out, the rates of a mass matrix that depends on the placement are long rational functions. Whether they vanish is
//! decided modulo the prime `2^61 - 1`, at points that have nothing to do with the model. The rates of the linear momenta at one
//! point are one equation for the combinations that are conserved; their common solutions are those of all of them as soon as
//! further points bring no further equation.

mod candidate;
mod components;
mod momenta;

use crate::algebra::residue::Residue;
use crate::algebra::ring::{Ring, Square, deviator, dot, skew};
use crate::algebra::{Arena, Polynomial};

use super::charts::Chart;
use super::equations::Load;
use super::flow::{Flow, power_rate};
use super::group_point::{GroupPoint, POINTS};

pub use candidate::{Candidate, candidates};
pub use components::Entry;
use components::{Rates, until_nothing_is_new};
use momenta::Layout;
pub(super) use momenta::Momenta;

/// What stays what it is, of what a chart has, under everything that was looked at.
#[derive(Clone, Debug)]
#[must_use]
pub struct Conservation {
    /// The momenta, and functions of them, that are conserved as a whole.
    pub whole: Vec<Candidate>,
    chart: Chart,
    rates: Rates,
}

impl Conservation {
    /// Everything that a chart with spatial `p` has, where nothing acts.
    pub fn of(chart: &Chart) -> Self {
        let layout = Layout { dim: chart.dim, moves: chart.linear.is_some() };
        let whole = candidates(chart);
        Self { rates: Rates::none(layout, &whole), whole, chart: chart.clone() }
    }

    /// What stays where the loads together move the coordinates: the motion of an energy, or forces alone.
    pub fn under(&mut self, arena: &Arena, loads: &[Load]) {
        let chart = &self.chart;
        until_nothing_is_new(|seed| {
            let mut point = GroupPoint::numbered(arena, chart, chart.confined, seed);
            loads.iter().for_each(|load| point.define(arena, &load.shared));
            let flow = Flow::new(chart, loads, &|p: &Polynomial| point.evaluate(arena, p));
            let [_, rates] = flow.momenta();
            if seed < POINTS {
                self.whole.retain(|candidate| flow.keeps(*candidate, &rates));
            }
            self.rates.see(&rates)
        });
    }

    /// What stays under forces of which no more is known than the rates of the momenta at points: they keep of the candidates
    /// what these leave at rest, and the energy or not.
    pub(super) fn under_forces(&mut self, energy: bool, rates: &dyn Fn(usize) -> Momenta) {
        self.whole.retain(|candidate| energy || *candidate != Candidate::Energy);
        until_nothing_is_new(|seed| {
            let rates = match self.rates.moves() {
                true => rates(seed),
                false => rates(seed).internal(),
            };
            if seed < POINTS {
                self.whole.retain(|candidate| rates.keep(*candidate));
            }
            self.rates.see(&rates)
        });
    }

    /// The combinations of entries of momenta that are conserved besides, none of which follows from others or from momenta that
    /// are conserved as a whole.
    pub fn components(&self, arena: &Arena) -> Vec<Vec<Entry>> {
        let chart = &self.chart;
        let values = |seed| {
            let point = GroupPoint::numbered(arena, chart, chart.confined, seed);
            let [values, _] = Flow::new(chart, &[], &|p: &Polynomial| point.evaluate(arena, p)).momenta();
            values
        };
        let values: Option<&dyn Fn(usize) -> Momenta> = chart.confined.is_some().then_some(&values);
        self.rates.components(&self.whole, values)
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
