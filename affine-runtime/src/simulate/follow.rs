//! Steps to the end of an integration, with output, events and callbacks on the way.

use super::course::Course;
use super::domain::turns;
use super::failed::failed;
use super::friction::is_stiff;
use super::guard::{Guard, collapse, explained};
use super::layout::has_work;
use super::method::Method;
use super::motion::Motion;
use super::output::Schedule;
use super::point::is_clearly_positive;
use super::recorder::{Recorder, Turn};
use super::trajectory::{Computation, Trajectory};
use super::watcher::{Sampling, WITHIN_A_STEP};
use crate::error::Reason;
use crate::frames::Matrix;
use crate::state::Phase;

/// Explicit steps after which friction is looked at again, and after twice as many, and so on: a look costs the evaluations of
/// eight.
const STEPS_UNTIL_A_LOOK: u64 = 512;

impl<const N: usize, P: Phase<N>> Recorder<'_, '_, N, P> {
    /// Steps to the end with output on the way, and the expansion of the last good step.
    pub(super) fn follow(&mut self, motion: &mut dyn Motion<P>) -> Result<(), Reason> {
        let since = self.trajectory.end.0;
        let outcome = self.step_through(motion, since).map_err(|reason| {
            let end = self.trajectory.end;
            let (good, (point, _)) = motion.kept().unwrap_or((end.0, (end.1, 0.0)));
            let Computation { asked, tolerance, .. } = self.trajectory.computation;
            explained(self.model, motion, (good, &point), reason, (asked, tolerance))
        });
        let trajectory = &mut *self.trajectory;
        let end = trajectory.end.0;
        let is_later = |t: f64| if self.backward { t < end } else { t > end };
        if motion.kept_at().is_some_and(is_later)
            && let Some((t, (point, work))) = motion.kept()
        {
            trajectory.end = (t, point);
            trajectory.energies.work_at_end = self.place.work() + work;
        }
        // Up to an event or a halt within the last step.
        let kept = self.keep_through(motion, self.turned_at());
        self.trajectory.statistics = self.place.cost().and(motion.statistics());
        if self.trajectory.end.0 == motion.t() {
            // An end that stands is that of a good step, whoever ends the run there.
            self.steps = self.trajectory.statistics.steps;
        }
        self.trajectory.computation.residual = motion.residual();
        outcome.and(kept)
    }

    /// Keeps the motion up to a time, where it is to be asked for afterwards.
    fn keep_through(&mut self, motion: &mut dyn Motion<P>, until: f64) -> Result<(), Reason> {
        let Trajectory { dense, computation, description, .. } = &mut *self.trajectory;
        let (Some(keep), Some(dense)) = (self.keep, dense) else { return Ok(()) };
        if dense.reached() == until {
            return Ok(());
        }
        let (Computation { asked, tolerance, .. }, model, t) = (*computation, description.name, motion.t());
        keep(dense, until, tolerance, &mut |due| match due == t {
            true => Ok(motion.reached().0),
            false => match motion.between(due) {
                Ok((point, _)) => Ok(point),
                Err(failure) => Err(failed(failure, (asked, tolerance), model)),
            },
        })
    }

    /// Steps to the end. A step without output whose state shows that it is good is not expanded: it is only kept, for
    /// a halt in the next one.
    fn step_through(&mut self, motion: &mut dyn Motion<P>, since: f64) -> Result<(), Reason> {
        let (model, start) = (self.model, self.trajectory.end.1);
        let cost = self.place.cost().steps;
        self.take_up(motion);
        let begin = self.trajectory.end;
        self.trajectory.dense.iter_mut().for_each(|dense| dense.begin(begin));
        let Computation { asked, tolerance, .. } = self.trajectory.computation;
        let mut guard = Guard::begin(model, motion, (since, &start), self.t_end, (asked, tolerance))?;
        let is_watched = self.progress.is_some() || self.is_watched();
        let equal = asked.step().is_some();
        let sampling = Sampling { parts: if equal { 1 } else { WITHIN_A_STEP }, by_ends: !equal, rate: 0.0 };
        while !motion.is_finished() {
            self.steps = cost + motion.statistics().steps;
            if self.steps >= self.max_steps {
                self.pass(motion);
                return Err(Reason::StepLimit { limit: self.max_steps });
            }
            let begin = motion.t();
            guard.advance(model, motion)?;
            let t = motion.t();
            self.turned((begin, t));
            self.witness.iter_mut().for_each(|witness| witness.stepped((t - begin).abs()));
            let stands = guard.stands(model, motion, (self.t_end, self.max_steps - self.steps));
            let until = match stands {
                Err(Reason::Placement { t, .. }) => {
                    let good = motion.kept_at().unwrap_or(self.trajectory.end.0);
                    collapse(motion, good, t)
                }
                Err(Reason::Domain { t, .. }) => t,
                _ => t,
            };
            if self.pass_through(motion, until, sampling)? {
                return Ok(());
            }
            let is_known = stands?;
            if self.schedule == Schedule::Steps {
                self.record_step(t, motion.reached())?;
            } else if self.trajectory.end.0 != t {
                let is_good = |phi: &[f64]| is_clearly_positive(&Matrix::<N>::from_row_slice(phi));
                if motion.is_finished() || !(is_known || motion.placement().is_some_and(is_good)) {
                    self.reach(t, motion.reached())?;
                }
            }
            motion.keep();
            self.keep_through(motion, t)?;
            if is_watched {
                self.pass(motion);
            }
            if self.has_stiffened(motion) {
                return Ok(());
            }
            self.steps += 1;
            self.report(t)?;
        }
        Ok(())
    }

    /// Friction has become stiff on the way, and the method is chosen anew: where the choice is free, and took explicit steps.
    fn has_stiffened(&mut self, motion: &dyn Motion<P>) -> bool {
        let steps = motion.statistics().steps;
        let Computation { asked, method, .. } = self.trajectory.computation;
        let is_explicit = matches!(method, Method::RungeKutta8 | Method::Taylor { .. });
        let is_due = steps >= STEPS_UNTIL_A_LOOK && steps.is_power_of_two() && !motion.is_finished();
        if !(is_due && asked == Method::Automatic && is_explicit && has_work(self.model.description())) {
            return false;
        }
        let (t, (point, work)) = (motion.t(), motion.reached());
        let stiff = self.model.rate_of_friction(t, &point).is_some_and(|rate| is_stiff(rate, self.t_end - t));
        if stiff {
            self.turn = Some(Turn::Anew { t, point, work: self.place.work() + work });
        }
        stiff
    }

    /// Notes what many explicit steps were taken in place of. A run that is too short for a trial takes fewer.
    pub(super) fn look_back(&mut self, course: &Course<'_, P>) {
        let Trajectory { computation, statistics, .. } = &mut *self.trajectory;
        let is_chosen = course.method == Method::Automatic && computation.method == Method::RungeKutta8;
        if is_chosen && statistics.steps >= STEPS_UNTIL_A_LOOK {
            computation.stiffness = self.model.would_pass_over(course);
        }
    }

    /// Keeps the step in which the time turns an angle of the potential furthest.
    fn turned(&mut self, step: (f64, f64)) {
        let turned = turns(self.model, &self.trajectory.end.1, step);
        let most = &mut self.trajectory.computation.turns;
        if turned.is_some_and(|(_, turns)| most.is_none_or(|(_, most)| turns > most)) {
            *most = turned;
        }
    }

    /// The events and the outputs of a step that has been taken, up to a time; whether the motion does not go straight on.
    fn pass_through(
        &mut self,
        motion: &mut dyn Motion<P>,
        until: f64,
        sampling: Sampling,
    ) -> Result<bool, Reason> {
        let t = motion.t();
        let (Computation { asked, tolerance, .. }, model) =
            (self.trajectory.computation, self.trajectory.description.name);
        let mut at = |due: f64| match due == t {
            true => Ok(motion.reached()),
            false => motion.between(due).map_err(|failure| failed(failure, (asked, tolerance), model)),
        };
        if self.meet(until, sampling, None, &mut at)? {
            return Ok(true);
        }
        self.record_through(until, &mut at)?;
        Ok(false)
    }
}
