//! What the end of a run is held against: the same motion by another method, at the tightest tolerance.

use core::mem::discriminant;

use crate::inner::{larger, norm};
use crate::model::Model;
use crate::report::method_name;
use crate::report::stability::Oracle;
use crate::simulate::{Method, Reason, Simulation};

/// Tolerance of the runs that judge.
const TIGHT: f64 = 1e-14;

/// Who judges, the first that serves: not the method under test, and for a model that has it.
const JUDGES: [Method; 5] = [
    Method::ClosedForm,
    Method::Taylor { order: None },
    Method::RungeKutta8,
    Method::Radau { stages: Some(7) },
    Method::Radau { stages: Some(5) },
];

/// A motion from a start to an end.
pub(super) struct Leg<'a, const N: usize, M: Model<N>> {
    pub(super) model: &'a M,
    pub(super) start: M::Point<f64>,
    pub(super) interval: (f64, f64),
    pub(super) max_steps: u64,
}

impl<'a, const N: usize, M: Model<N>> Leg<'a, N, M> {
    /// Its simulation by a method, without output on the way.
    pub(super) fn simulation(&self, method: Method, tolerance: f64) -> Simulation<'a, N, M> {
        let (t0, t_end) = self.interval;
        Simulation::new(self.model, self.start)
            .from(t0)
            .until(t_end)
            .output([t_end])
            .method(method)
            .tolerance(tolerance)
            .max_steps(self.max_steps)
    }
}

/// The end by one of the judges, or why there is none.
type End<P> = Result<P, Refusal>;

/// Why a judge has no end.
#[derive(Clone)]
struct Refusal {
    /// The method does not serve for this model, which says nothing about the motion.
    is_setting: bool,
    words: String,
}

/// The ends of a leg by those who judge, each run when first asked for.
pub(super) struct Judge<'a, const N: usize, M: Model<N>> {
    pub(super) leg: Leg<'a, N, M>,
    ends: [Option<End<M::Point<f64>>>; JUDGES.len()],
}

impl<'a, const N: usize, M: Model<N>> Judge<'a, N, M> {
    pub(super) fn new(leg: Leg<'a, N, M>) -> Self {
        Self { leg, ends: core::array::from_fn(|_| None) }
    }

    /// The error of an end that a method came to, and what it was held against; in words, why nothing can be said.
    pub(super) fn error(&mut self, method: Method, end: &M::Point<f64>) -> Result<(f64, Oracle), String> {
        let mut words = None;
        for (judge, known) in JUDGES.into_iter().zip(&mut self.ends) {
            if is_same(method, judge) {
                continue;
            }
            match known.get_or_insert_with(|| tight_end(&self.leg, judge)) {
                Ok(exact) => {
                    let oracle =
                        if judge == Method::ClosedForm { Oracle::ClosedForm } else { Oracle::TighterRun };
                    return Ok((distance(&self.leg, end, exact), oracle));
                }
                Err(refusal) if refusal.is_setting => {}
                Err(refusal) => {
                    words.get_or_insert_with(|| format!("{}: {}", method_name(judge), refusal.words));
                }
            }
        }
        Err(words.unwrap_or_else(|| "no other method serves for this model".to_owned()))
    }
}

fn tight_end<const N: usize, M: Model<N>>(leg: &Leg<'_, N, M>, judge: Method) -> End<M::Point<f64>> {
    match leg.simulation(judge, TIGHT).run() {
        Ok(run) => Ok(*run.end().1),
        Err(halt) => Err(Refusal {
            is_setting: matches!(halt.stop.reason, Reason::Setting(_)),
            words: halt.stop.to_string(),
        }),
    }
}

/// Would the judge repeat what it judges? Radau methods of different numbers of stages share no coefficient; one that was
/// left to choose may have taken seven.
fn is_same(method: Method, judge: Method) -> bool {
    match (method, judge) {
        (Method::Radau { stages }, Method::Radau { stages: of_judge }) => {
            stages == of_judge || (stages.is_none() && of_judge == Some(7))
        }
        _ => discriminant(&method) == discriminant(&judge),
    }
}

/// The largest `|a - b|/max(|b|, |start|)` over the quantities of a phase point: what passes through zero at the end is measured
/// by what it was.
fn distance<const N: usize, M: Model<N>>(
    leg: &Leg<'_, N, M>,
    end: &M::Point<f64>,
    exact: &M::Point<f64>,
) -> f64 {
    let [end, exact, start] = [end, exact, &leg.start].map(|point| leg.model.flatten(point));
    let mut offset = 0;
    let errors = M::DESCRIPTION.full.iter().map(|group| {
        let range = offset..offset + group.len;
        offset = range.end;
        let [end, exact, start] = [&end, &exact, &start].map(|full| &full.as_ref()[range.clone()]);
        let differences: Vec<f64> = end.iter().zip(exact).map(|(a, b)| a - b).collect();
        let apart = norm(&differences);
        if apart == 0.0 { 0.0 } else { apart / larger(norm(exact), norm(start)) }
    });
    errors.fold(0.0, larger)
}
