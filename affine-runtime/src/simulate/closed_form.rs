//! A trajectory in closed form: no steps, exact up to rounding.

use super::follow::{WITHIN_A_STEP, report};
use super::halt::Reason;
use super::recorder::Recorder;
use super::{Method, Progress, Simulation};
use crate::geodesic::{Geodesic, Motion};
use crate::kinematics::LogDeterminant;
use crate::model::Model;
use crate::state::Phase;

/// Part of the way to a collapse within which an event that follows belongs to it: times of a collapse and of the zero of
/// an event have errors of their own.
const PAST_A_COLLAPSE: f64 = 1e-8;

impl<const N: usize, M: Model<N>> Simulation<'_, N, M> {
    /// The closed form at the output times.
    pub(super) fn evaluate(
        &mut self,
        geodesic: &Geodesic<N>,
        t_end: f64,
        recorder: &mut Recorder<'_, '_, N, M>,
    ) -> Result<(), Reason> {
        let computation = &mut recorder.trajectory.computation;
        computation.method = Method::ClosedForm;
        computation.no_whirl =
            matches!(geodesic.motion, Motion::Body { whirl: None, .. } | Motion::Space { whirl: None, .. });
        let at = |t| if t == self.t0 { self.start } else { self.model.on_geodesic(geodesic, t, &self.start) };
        let collapse = geodesic.collapse(t_end, self.start.phi());
        let is_behind = |t: f64, end: f64| (t - end) * (t_end - self.t0) >= 0.0;
        let stands = |t: f64| match collapse {
            Some(end) if is_behind(t, end) => {
                Err(Reason::Placement { determinant: LogDeterminant::of(at(t).phi()).to_f64(), t: end })
            }
            _ => Ok(()),
        };
        // Events behind a collapse do not happen; the collapse may be one.
        let last_event = collapse.map(|end| end + PAST_A_COLLAPSE * (end - self.t0));
        recorder.begin_closed_form(self.t0, t_end, at);
        recorder.trajectory.statistics = recorder.place.cost();
        let mut outputs = 0;
        loop {
            let due = recorder.schedule.peek();
            let until = due.unwrap_or(t_end);
            let until = last_event.filter(|last| is_behind(until, *last)).unwrap_or(until);
            if recorder.meet(until, WITHIN_A_STEP, |t| Ok::<_, Reason>((at(t), 0.0)))? {
                return Ok(());
            }
            let Some(t) = due else { break };
            stands(t)?;
            recorder.schedule.take_through(t, recorder.backward);
            recorder.record(t, (at(t), 0.0))?;
            outputs += 1;
            recorder.place.passed(vec![t.to_bits()]);
            report(&mut self.progress, Progress { t0: recorder.origin, t, t_end, steps: outputs })?;
        }
        stands(t_end)?;
        recorder.reach(t_end, (at(t_end), 0.0))
    }
}
