//! Steps to the end of an integration, with output, events and callbacks on the way.

use super::collapse::first_failure;
use super::halt::{Callback, Reason};
use super::output::Schedule;
use super::point::{check, go_on, is_clearly_positive, placement_in, work};
use super::recorder::{Recorder, WithWork};
use super::signature::Signature;
use super::stepper::Stepper;
use super::{Progress, Simulation, Watch};
use crate::frames::Matrix;
use crate::integrate::Statistics;
use crate::model::{Group, Model, StateVector};
use crate::state::Phase;

/// Equal parts of a step at whose ends events are looked at.
pub(super) const WITHIN_A_STEP: u32 = 4;

impl<const N: usize, M: Model<N>> Simulation<'_, N, M> {
    /// Steps to the end with output on the way, and the expansion of the last good step.
    pub(super) fn step_through<S: StateVector<f64>>(
        &mut self,
        integration: &mut impl Stepper<S>,
        expand: impl Fn(f64, &S) -> M::Point<f64>,
        groups: &[Group],
        t_end: f64,
        recorder: &mut Recorder<'_, '_, N, M>,
    ) -> Result<(), Reason> {
        let mut last = None;
        let outcome = self.follow(integration, (&expand, groups), t_end, recorder, &mut last);
        let outcome = outcome.map_err(|reason| match reason {
            Reason::Placement { determinant, t } => {
                let good = last.as_ref().map_or(recorder.trajectory.end.0, |(t, _)| *t);
                let stands = |t| integration.between(t).is_ok_and(|y| check(t, &expand(t, &y)).is_ok());
                Reason::Placement { determinant, t: first_failure(good, t, stands) }
            }
            other => other,
        });
        let trajectory = &mut *recorder.trajectory;
        trajectory.statistics = sum(recorder.place.cost(), integration.statistics());
        if let Some((t, reduced)) = last.filter(|(t, _)| (t - trajectory.end.0) * (t_end - self.t0) > 0.0) {
            trajectory.end = (t, expand(t, &reduced));
            trajectory.energies.work_at_end = recorder.place.work() + work(groups, &reduced);
        }
        outcome
    }

    /// Steps to the end. A step without output whose reduced state shows that it is good is not expanded: it is
    /// only left in `last`, for a halt in the next one.
    fn follow<S: StateVector<f64>>(
        &mut self,
        integration: &mut impl Stepper<S>,
        (expand, groups): (&impl Fn(f64, &S) -> M::Point<f64>, &[Group]),
        t_end: f64,
        recorder: &mut Recorder<'_, '_, N, M>,
        last: &mut Option<(f64, S)>,
    ) -> Result<(), Reason> {
        let placement = placement_in(groups, N);
        let signature = Signature::of(self.model.regularity(self.start.phi()));
        let regularity = |t: f64, reduced: &S| self.model.regularity(expand(t, reduced).phi());
        let with_work =
            |t: f64, reduced: &S| -> WithWork<M::Point<f64>> { (expand(t, reduced), work(groups, reduced)) };
        let cost = recorder.place.cost().steps;
        recorder.take_up(integration, with_work);
        let is_watched = self.progress.is_some() || recorder.is_watched();
        while !integration.is_finished() {
            let steps = cost + integration.statistics().steps;
            if steps >= self.max_steps {
                recorder.pass(integration);
                return Err(Reason::StepLimit { limit: self.max_steps });
            }
            if let Err(failure) = integration.advance() {
                let (t, last) = (integration.t(), integration.y());
                let degenerate = signature.failing(regularity(t, last), t);
                return Err(degenerate.unwrap_or_else(|| self.reason(failure)));
            }
            let (t, reduced) = (integration.t(), *integration.y());
            if signature.may_change() {
                signature.kept(regularity(t, &reduced), t)?;
            }
            let mut at = |due: f64| match due == t {
                true => Ok(with_work(t, &reduced)),
                false => integration
                    .between(due)
                    .map(|between| with_work(due, &between))
                    .map_err(|failure| self.reason(failure)),
            };
            let parts = if self.method.step().is_some() { 1 } else { WITHIN_A_STEP };
            if recorder.meet(t, parts, &mut at)? {
                return Ok(());
            }
            recorder.record_through(t, &mut at)?;
            if recorder.schedule == Schedule::Steps {
                recorder.record_step(t, with_work(t, &reduced))?;
            } else if recorder.trajectory.end.0 != t {
                let phi =
                    placement.clone().map(|range| Matrix::<N>::from_row_slice(&reduced.as_ref()[range]));
                if integration.is_finished() || !phi.is_some_and(|phi| is_clearly_positive(&phi)) {
                    recorder.reach(t, with_work(t, &reduced))?;
                }
            }
            *last = Some((t, reduced));
            if is_watched {
                recorder.pass(integration);
            }
            report(&mut self.progress, Progress { t0: recorder.origin, t, t_end, steps: steps + 1 })?;
        }
        Ok(())
    }
}

pub(super) fn report(watch: &mut Option<Watch<'_>>, progress: Progress) -> Result<(), Reason> {
    match watch {
        Some(watch) => go_on(watch(&progress), Callback::Progress),
        None => Ok(()),
    }
}

/// Costs one after the other.
fn sum(before: Statistics, after: Statistics) -> Statistics {
    Statistics {
        steps: before.steps + after.steps,
        rejected: before.rejected + after.rejected,
        evaluations: before.evaluations + after.evaluations,
    }
}
