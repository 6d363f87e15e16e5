//! A trajectory in closed form: no steps, exact up to rounding.

use super::collapse::rate_of_determinant;
use super::course::Course;
use super::distortion::told;
use super::mechanics::Mechanics;
use super::method::Method;
use super::point::check;
use super::recorder::Recorder;
use super::watcher::{At, Sampling, WITHIN_A_STEP};
use crate::error::Reason;
use crate::geodesic::{Geodesic, Orbit};
use crate::inner::LogDeterminant;
use crate::inner::larger;
use crate::state::Phase;

/// Part of the way to a collapse within which an event that follows belongs to it: times of a collapse and of the zero of
/// an event have errors of their own.
const PAST_A_COLLAPSE: f64 = 1e-8;

/// Stretches of a run in closed form between whose ends events are looked at, where the motion asks for no more.
const STRETCHES: f64 = 100.0;

/// A closed form on the way to an end.
#[derive(Clone, Copy)]
pub(super) struct ClosedForm<const N: usize, P> {
    geodesic: Geodesic<N>,
    start: (f64, P),
    t_end: f64,
    /// The time of the first collapse up to there.
    collapse: Option<f64>,
}

impl<const N: usize, P: Phase<N>> ClosedForm<N, P> {
    pub(super) fn begin(
        model: &dyn Mechanics<N, P>,
        geodesic: Geodesic<N>,
        start: (f64, P),
        t_end: f64,
    ) -> Self {
        let collapse = model.collapse(&geodesic, t_end, start.1.phi());
        Self { geodesic, start, t_end, collapse }
    }

    /// The same motion to another end.
    pub(super) fn aimed(&self, model: &dyn Mechanics<N, P>, t_end: f64) -> Self {
        Self::begin(model, self.geodesic, self.start, t_end)
    }

    /// The phase point at a time.
    pub(super) fn at(&self, model: &dyn Mechanics<N, P>, t: f64) -> P {
        let (t0, start) = &self.start;
        if t == *t0 { *start } else { model.on_geodesic(&self.geodesic, t, start) }
    }

    fn is_behind(&self, t: f64, end: f64) -> bool {
        (t - end) * (self.t_end - self.start.0) >= 0.0
    }

    /// Refuses a time that rounding makes another.
    pub(super) fn resolved(&self, t: f64) -> Result<(), Reason> {
        let rate = self.geodesic.rate();
        match f64::EPSILON * rate * (t - self.start.0).abs() >= 1.0 {
            true => Err(Reason::Unresolved { rate, t }),
            false => Ok(()),
        }
    }

    /// The phase point at a time, which is before any collapse: none but that of a straight line loses its orientation. `good` is
    /// the time of the last good one.
    pub(super) fn reached(&self, model: &dyn Mechanics<N, P>, good: f64, t: f64) -> Result<P, Reason> {
        self.stands(model, good, t)?;
        let point = self.at(model, t);
        let may_collapse = matches!(self.geodesic.motion, Orbit::Straight { .. });
        match check(t, &point) {
            Err(Reason::Placement { determinant, .. }) if !may_collapse => {
                Err(Reason::Distortion { determinant, t })
            }
            checked => checked.map(|()| point),
        }
    }

    /// Refuses a time behind a collapse.
    fn stands(&self, model: &dyn Mechanics<N, P>, good: f64, t: f64) -> Result<(), Reason> {
        match self.collapse {
            Some(end) if self.is_behind(t, end) => {
                let met = LogDeterminant::of(self.at(model, t).phi());
                // Where the body has turned back by then, the first bad point is the zero.
                let determinant = if met.is_positive() { 0.0 } else { met.to_f64() };
                let rate = Some(rate_of_determinant(model, &self.at(model, good)));
                Err(Reason::Placement { determinant, rate, t: end })
            }
            _ => Ok(()),
        }
    }
}

impl<const N: usize, P: Phase<N>> Recorder<'_, '_, N, P> {
    /// The closed form at the output times.
    pub(super) fn evaluate(&mut self, geodesic: &Geodesic<N>, course: &Course<'_, P>) -> Result<(), Reason> {
        let Course { t0, start, t_end, .. } = *course;
        let has_stepped = self.trajectory.statistics.steps > 0;
        let computation = &mut self.trajectory.computation;
        // What was left of a motion in steps is no more exact than they.
        computation.method = if has_stepped { computation.method } else { Method::ClosedForm };
        let no_whirl =
            matches!(geodesic.motion, Orbit::Body { whirl: None, .. } | Orbit::Space { whirl: None, .. });
        // Nor before an event that has changed the point.
        computation.no_whirl = no_whirl && (t0 == self.origin || computation.no_whirl);
        let model = self.model;
        let motion = ClosedForm::begin(model, *geodesic, (t0, *start), t_end);
        let at = |t| motion.at(model, t);
        let (rate, collapse) = (geodesic.rate(), motion.collapse);
        // Events behind a collapse do not happen; the collapse may be one.
        let last_event = collapse.map(|end| end + PAST_A_COLLAPSE * (end - t0));
        self.begin_closed_form(t0, rate, &at);
        self.trajectory.statistics = self.place.cost();
        self.steps = 0;
        loop {
            let due = self.schedule.peek();
            let until = due.unwrap_or(t_end);
            let until = match (collapse, last_event) {
                (Some(end), Some(last)) if motion.is_behind(until, end) => last,
                _ => until,
            };
            motion.resolved(until)?;
            let met = self.meet_between(until, rate, &mut |t| Ok((at(t), 0.0)));
            if met.map_err(|reason| told(reason, at(until).phi(), 0.0))? {
                return Ok(());
            }
            let Some(t) = due else { break };
            let point = motion.reached(model, self.trajectory.end.0, t)?;
            // An event at that very time has it recorded already.
            if self.schedule.take_through(t, self.backward).is_some() {
                self.record(t, (point, 0.0))?;
            }
            self.steps += 1;
            self.passed(vec![t.to_bits()]);
            self.report(t)?;
        }
        let end = motion.reached(model, self.trajectory.end.0, t_end)?;
        self.reach(t_end, (end, 0.0))
    }

    /// The events on the way from one output to the next, in stretches of a few samples each, after which the run may be
    /// interrupted; whether the motion does not go straight on.
    fn meet_between(&mut self, until: f64, rate: f64, at: &mut At<'_, P>) -> Result<bool, Reason> {
        let sampling = Sampling { parts: WITHIN_A_STEP, by_ends: false, rate };
        let longest = (self.t_end - self.origin).abs() / STRETCHES;
        while self.has_events() && self.watcher.t() != until {
            let (t, left) = (self.watcher.t(), until - self.watcher.t());
            let stretches = larger(
                (left.abs() / longest).round(),
                self.watcher.parts_to(until) / f64::from(WITHIN_A_STEP),
            );
            let end = t + left / stretches;
            let end = if stretches > 1.0 && end != t { end } else { until };
            if self.meet(end, sampling, None, at)? {
                return Ok(true);
            }
            if end != until {
                self.passed(vec![end.to_bits()]);
                self.report(end)?;
            }
        }
        Ok(false)
    }
}
