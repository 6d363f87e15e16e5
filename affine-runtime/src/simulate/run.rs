//! Running a simulation: from its settings to the outcome, leg by leg.

use super::checkpoint::{Checkpoint, Place};
use super::halt::{Halt, Outcome, Reason, Setting, Stop};
use super::methods::{chart, is_canonical};
use super::point::{check, energy_scale, total};
use super::range::in_range;
use super::recorder::{Recorder, Turn};
use super::trajectory::{Computation, Energies, Trajectory};
use super::watcher::Watcher;
use super::{Method, Simulation};
use crate::integrate::Statistics;
use crate::integrate::lie::Flat;
use crate::model::{Model, StateVector};
use crate::state::Phase;

impl<const N: usize, M: Model<N>> Simulation<'_, N, M> {
    /// Runs the simulation.
    ///
    /// Every step and every output is checked: finite, and `det phi > 0`; the time of a collapse is found within the step,
    /// see [`Reason::Placement`]. What happens between two good steps is not seen: a body without a potential that
    /// prevents it may collapse and turn inside out twice in between. On a straight line, the closed form of a free
    /// body in a flat metric, every collapse is seen.
    ///
    /// # Errors
    /// [`Halt`] with the [`Reason`], the time, the step and the trajectory so far; the conversion to
    /// [`Error`](crate::Error) by `?` keeps reason, time and step.
    pub fn run(self) -> Outcome<N, M::Point<f64>> {
        const {
            assert!(
                total(M::DESCRIPTION.reduced) == <M::Reduced<f64> as StateVector<f64>>::LEN,
                "the groups of DESCRIPTION.reduced do not make up the reduced state"
            );
        }
        let mut trajectory = self.empty_trajectory();
        let model = self.model;
        let outcome = self.drive(&mut trajectory);
        // The end is the last output, as a rule; an event may have changed it since.
        trajectory.energies.end = match (trajectory.times.last(), trajectory.energies.outputs.last()) {
            (Some(t), Some(energy)) if *t == trajectory.end.0 && trajectory.events.is_empty() => *energy,
            _ => model.hamiltonian(trajectory.end.0, &trajectory.end.1),
        };
        match outcome {
            Ok(()) => Ok(trajectory),
            Err(reason) => {
                let stop = Stop { reason, t: trajectory.end.0, steps: trajectory.statistics.steps };
                Err(Halt { stop, trajectory: Box::new(trajectory) })
            }
        }
    }

    fn empty_trajectory(&self) -> Trajectory<N, M::Point<f64>> {
        let energy = self.model.hamiltonian(self.t0, &self.start);
        Trajectory {
            description: M::DESCRIPTION,
            bases: self.model.bases(),
            start: (self.t0, self.start),
            end: (self.t0, self.start),
            times: Vec::new(),
            points: Vec::new(),
            energies: Energies {
                start: energy,
                end: energy,
                outputs: Vec::new(),
                work: Vec::new(),
                work_at_end: 0.0,
                scale: energy_scale(self.model, &self.start, energy),
            },
            statistics: Statistics::default(),
            events: Vec::new(),
            stopped_by: None,
            checkpoint: None,
            computation: Computation {
                asked: self.method,
                method: Method::RungeKutta8,
                tolerance: self.tolerance,
                closed_form_exists: false,
                no_whirl: false,
                at_rest: self.start.p().iter().all(|p| *p == 0.0),
                missing: None,
                condition: self.condition(),
                residual: None,
            },
        }
    }

    fn condition(&self) -> Option<f64> {
        let by_fields = M::DESCRIPTION.signature.is_none();
        by_fields.then(|| self.model.condition(self.start.phi())).flatten()
    }

    fn drive(mut self, trajectory: &mut Trajectory<N, M::Point<f64>>) -> Result<(), Reason> {
        let (t_end, schedule) = self.checked_settings()?;
        check(self.t0, &self.start)?;
        in_range::<N, M>(self.t0, &self.start)?;
        let (t0, events) = (self.t0, self.events.len());
        let place = Place::starting(None, (Statistics::default(), 0.0));
        let mut recorder = Recorder {
            model: self.model,
            trajectory,
            schedule,
            observe: self.observe.take(),
            watcher: Watcher::new(core::mem::take(&mut self.events)),
            origin: self.t0,
            backward: t_end < self.t0,
            place,
            is_lost: false,
            turn: None,
        };
        if let Some(checkpoint) = self.checkpoint.take() {
            let run = self.fingerprint(t0, t_end, events);
            self.take_up(checkpoint, &run, &mut recorder)?;
        }
        let outcome = self.legs(t_end, &mut recorder);
        let interrupted = matches!(outcome, Err(Reason::Interrupted(_) | Reason::StepLimit { .. }));
        if (interrupted || recorder.trajectory.stopped_by.is_some()) && !recorder.is_lost {
            let place = Place { outputs: recorder.schedule.taken(), ..recorder.place };
            let place = place.from(self.t0, &self.start);
            let run = self.fingerprint(t0, t_end, events);
            recorder.trajectory.checkpoint = Some(Checkpoint { run, place });
        }
        outcome
    }

    /// What a checkpoint fits: runs that take the same steps from the same place.
    fn fingerprint(&self, t0: f64, t_end: f64, events: usize) -> String {
        let [t0, t_end, tolerance] = [t0, t_end, self.tolerance].map(f64::to_bits);
        let (model, method) = (M::DESCRIPTION.name, self.method);
        format!("{model} {method:?} {tolerance:x} {t0:x} {t_end:x} {events}")
    }

    /// Goes back to where a run was interrupted.
    fn take_up(
        &mut self,
        checkpoint: Checkpoint,
        run: &str,
        recorder: &mut Recorder<'_, '_, N, M>,
    ) -> Result<(), Setting> {
        if checkpoint.run != run {
            return Err(Setting::Checkpoint { model: M::DESCRIPTION.name });
        }
        (self.t0, self.start) = checkpoint.place.origin(&self.start);
        recorder.place = checkpoint.place;
        recorder.trajectory.end = (self.t0, self.start);
        recorder.trajectory.energies.work_at_end = recorder.place.work();
        recorder.schedule.resume(recorder.place.outputs);
        Ok(())
    }

    /// One integration after the other: where an event changes the point, the next one starts.
    fn legs(&mut self, t_end: f64, recorder: &mut Recorder<'_, '_, N, M>) -> Result<(), Reason> {
        let mut changes = 0;
        loop {
            self.leg(t_end, recorder)?;
            let Some(Turn::Changed { t, point, event, work }) = recorder.turn.take() else { return Ok(()) };
            check(t, &point)?;
            changes += 1;
            if changes > self.max_steps {
                return Err(Reason::StepLimit { limit: self.max_steps });
            }
            (self.t0, self.start) = (t, point);
            recorder.trajectory.end = (t, point);
            recorder.trajectory.energies.work_at_end = work;
            recorder.trajectory.computation.at_rest &= point.p().iter().all(|p| *p == 0.0);
            let cost = recorder.trajectory.statistics;
            recorder.place = Place::starting(Some(event), (cost, work));
        }
    }

    /// The motion from a point to the end, or to an event that changes it.
    fn leg(&mut self, t_end: f64, recorder: &mut Recorder<'_, '_, N, M>) -> Result<(), Reason> {
        let geodesic = self.model.geodesic(self.t0, &self.start);
        recorder.trajectory.computation.closed_form_exists = geodesic.is_some();
        match (self.method, geodesic) {
            (Method::ClosedForm, None) => Err(Setting::NoClosedForm { model: M::DESCRIPTION.name }.into()),
            (Method::Automatic | Method::ClosedForm, Some(geodesic)) => {
                self.evaluate(&geodesic, t_end, recorder)
            }
            (Method::Rattle { order, step }, _) => self.integrate_by_rattle((order, step), t_end, recorder),
            (Method::Splitting { order, step }, _) => {
                self.integrate_by_splitting((order, step), t_end, recorder)
            }
            _ => match (chart::<N, M>(), self.chosen(recorder)) {
                (_, Method::Taylor { order }) => self.integrate_by_series(order, t_end, recorder),
                (_, Method::RungeKuttaNystrom12) => self.integrate_in_halves(t_end, recorder),
                (Some(_), _) if is_canonical::<N, M>() => self.integrate_with_reaction(t_end, recorder),
                (Some(chart), _) => self.integrate(chart, t_end, recorder),
                (None, _) => self.integrate(Flat, t_end, recorder),
            },
        }
    }
}
