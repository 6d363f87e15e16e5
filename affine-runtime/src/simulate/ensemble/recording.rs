//! What is recorded of the body in a lane, as a run of it alone records it.

use super::asked::{Asked, Start};
use crate::integrate::Statistics;
use crate::model::{Handle, Model};
use crate::simulate::checkpoint::Place;
use crate::simulate::energy::Energy;
use crate::simulate::mechanics::Mechanics;
use crate::simulate::motion::WithWork;
use crate::simulate::point::check;
use crate::simulate::recorder::{Recorder, Turn};
use crate::simulate::trajectory::Trajectory;
use crate::simulate::watcher::{At, Ends, Sampling, Step, WITHIN_A_STEP, Watcher};
use crate::state::Phase;

const SAMPLING: Sampling = Sampling { parts: WITHIN_A_STEP, by_ends: true, rate: 0.0 };

/// How a body goes on after a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Next {
    /// With the next step.
    Step,
    /// Not at all: an event has ended its run.
    End,
    /// By itself: something has to be looked at that lanes do not.
    Alone,
}

/// The body on its way in a lane, after others that were there.
pub(super) struct Recording<'r, 'a, const N: usize, P, A> {
    recorder: Recorder<'r, 'a, N, P>,
    /// Its place among the starts, and what is folded of it so far; none where the lane rests.
    of_body: Option<(usize, A)>,
    /// A run would not begin.
    is_refused: bool,
}

impl<'r, 'a, const N: usize, P: Phase<N>, A> Recording<'r, 'a, N, P, A> {
    /// Of a lane in which there is no body yet, where all of them are in turn.
    pub(super) fn of_none<'e: 'a, H>(
        asked: &Asked<'_, 'e, N, H, A>,
        model: &'a dyn Mechanics<N, P>,
        trajectory: &'r mut Trajectory<N, P>,
    ) -> Self
    where
        H: Handle<N, Model: Model<N, Point<f64> = P>>,
    {
        let (plan, t0) = (asked.plan, asked.plan.t0);
        let recorder = Recorder {
            model,
            needs_determinant: false,
            trajectory,
            keep: None,
            schedule: asked.schedule.clone(),
            progress: None,
            observe: None,
            watcher: Watcher::new(Vec::new(), None),
            max_steps: plan.max_steps,
            origin: t0,
            t_end: asked.t_end,
            backward: asked.t_end < t0,
            steps: 0,
            place: Place::starting(Vec::new(), (Statistics::default(), 0.0)),
            witness: None,
            is_lost: false,
            turn: None,
        };
        Self { recorder, of_body: None, is_refused: false }
    }

    /// At the start of a body.
    pub(super) fn begin<'e: 'a, H>(
        &mut self,
        asked: &Asked<'_, 'e, N, H, A>,
        (body, start): (usize, &Start<N, H>),
        model: &'a dyn Mechanics<N, P>,
    ) where
        H: Handle<N, Model: Model<N, Point<f64> = P>>,
    {
        let (recorder, t0) = (&mut self.recorder, asked.plan.t0);
        let Trajectory { start: first, end, times, points, events, energies, .. } = &mut *recorder.trajectory;
        (*first, *end) = ((t0, start.point), (t0, start.point));
        energies.work_at_end = 0.0;
        times.clear();
        points.clear();
        events.clear();
        recorder.model = model;
        recorder.schedule.clone_from(&asked.schedule);
        if asked.has_events {
            recorder.watcher = Watcher::new((asked.events)(), model.bases());
        }
        recorder.place = Place::starting(Vec::new(), (Statistics::default(), 0.0));
        (recorder.steps, recorder.witness, recorder.is_lost, recorder.turn) = (0, None, false, None);
        let due = recorder.schedule.take_through(t0, recorder.backward);
        // The least that what it is made of may be: a body whose energy seems lost goes alone, where more is known.
        let energy = Energy::of_value(model.hamiltonian(t0, &start.point));
        let begun = recorder.begin_at_energy((t0, &start.point), &energy, Some(asked.plan.tolerance));
        self.is_refused = begun.and_then(|()| recorder.begin(t0, &start.point)).is_err();
        let mut folded = (asked.begin)(start.number, &start.handle);
        due.iter().for_each(|t| (asked.add)(&mut folded, *t, &start.point));
        self.of_body = Some((body, folded));
    }

    /// There is a body in the lane.
    pub(super) fn has_body(&self) -> bool {
        self.of_body.is_some()
    }

    /// Looks at the ends of a step for events.
    pub(super) fn look_at(&mut self, ends: &Ends<'_, P>, turning: &dyn Fn() -> f64) -> Step<P> {
        self.recorder.watcher.goes_by(ends, SAMPLING.rate, turning)
    }

    /// Looks at a step to a time: events, of which its ends tell, and outputs.
    pub(super) fn step(
        &mut self,
        t: f64,
        events: Option<Step<P>>,
        at: &mut At<'_, P>,
        add: &dyn Fn(&mut A, f64, &P),
    ) -> Next {
        if self.is_refused {
            return Next::Alone;
        }
        if let Some(step @ (Step::Crossed(_) | Step::Open(_))) = events {
            // Those of the step before.
            self.recorder.place.met = 0;
            let met = self.recorder.meet(t, SAMPLING, Some(step), at);
            self.hand_over(add);
            match met {
                Ok(false) => {}
                Ok(true) if matches!(self.recorder.turn, Some(Turn::Stopped)) => return Next::End,
                _ => return Next::Alone,
            }
        }
        let Recorder { schedule, backward, .. } = &mut self.recorder;
        let Some((_, folded)) = &mut self.of_body else { return Next::Step };
        while let Some(due) = schedule.take_through(t, *backward) {
            match at(due) {
                Ok((point, _)) if check(due, &point).is_ok() => add(folded, due, &point),
                _ => return Next::Alone,
            }
        }
        Next::Step
    }

    /// What was recorded up to an event.
    fn hand_over(&mut self, add: &dyn Fn(&mut A, f64, &P)) {
        let Trajectory { times, points, energies, .. } = &mut *self.recorder.trajectory;
        energies.outputs.clear();
        energies.work.clear();
        let Some((_, folded)) = &mut self.of_body else { return };
        times.drain(..).zip(points.drain(..)).for_each(|(t, point)| add(folded, t, &point));
    }

    /// Looks at the end of the interval; whether a body may end there.
    pub(super) fn arrive(&mut self, t: f64, end: WithWork<P>) -> bool {
        let recorder = &mut self.recorder;
        !self.is_refused && recorder.reach(t, end).and_then(|()| recorder.arrive()).is_ok()
    }

    /// The body leaves the lane: its place among the starts and what was folded, with the trajectory, which is the next one's.
    pub(super) fn done(&mut self) -> Option<(usize, A, &mut Trajectory<N, P>)> {
        let (body, folded) = self.of_body.take()?;
        Some((body, folded, self.recorder.trajectory))
    }
}
