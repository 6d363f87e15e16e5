//! Running a simulation: from its settings to the outcome, leg by leg.

use super::checkpoint::{Checkpoint, Place};
use super::course::{Choice, Course};
use super::dense::Dense;
use super::distortion::distinctness;
use super::energy::Energy;
use super::fingerprint::fingerprint;
use super::layout::total;
use super::mechanics::{Mechanics, Moves};
use super::method::Method;
use super::outcome::{Halt, Outcome};
use super::point::{check, check_constraint};
use super::recorder::{Recorder, Turn};
use super::settings::{Plan, Settings};
use super::simulation::Simulation;
use super::trajectory::{Computation, Energies, Trajectory};
use super::watcher::Watcher;
use crate::error::Setting;
use crate::error::{Reason, Stop};
use crate::integrate::{FusedArithmetic, Statistics};
use crate::model::{Model, StateVector};
use crate::state::Phase;

impl<const N: usize, M: Model<N>> Simulation<'_, N, M> {
    /// Runs the simulation.
    ///
    /// Every step and every output is checked: finite, and `det phi > 0`; the time of a collapse is found within the step,
    /// see [`Reason::Placement`], also where a body in a flat metric collapses and turns inside out twice within a step:
    /// steps that change the placement by half of itself or more are looked into.
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
        Run { model: &self.moving(), settings: self.settings }.outcome()
    }
}

#[cfg(feature = "report")]
impl<const N: usize, M: Model<N>> Simulation<'_, N, M> {
    /// Looks at the settings alone.
    ///
    /// # Errors
    /// What [`run`](Self::run) would say of them, with the start as it is.
    pub(crate) fn checked(self) -> Result<(), Halt<N, M::Point<f64>>> {
        let run = Run { model: &self.moving(), settings: self.settings };
        let checked = run.settings.checked(&M::DESCRIPTION).map_err(Reason::from);
        let checked = checked.and_then(|_| check(run.settings.plan.t0, &run.settings.start));
        checked.map_err(|reason| {
            let trajectory = Box::new(run.empty_trajectory(&run.energy_at_start()));
            Halt { stop: Stop { reason, t: trajectory.end.0, steps: 0 }, trajectory }
        })
    }
}

/// A run of a model that is only known by its phase points.
pub(super) struct Run<'a, const N: usize, P> {
    pub(super) model: &'a dyn Moves<N, P>,
    pub(super) settings: Settings<'a, N, P>,
}

impl<const N: usize, P: Phase<N>> Run<'_, N, P> {
    /// Runs it; callbacks and events stay, for a run that goes on from there.
    pub(super) fn outcome(&mut self) -> Outcome<N, P> {
        let at_start = self.energy_at_start();
        let mut trajectory = self.empty_trajectory(&at_start);
        let model = self.model;
        let mut good = 0;
        let outcome = self.drive(&mut trajectory, at_start, &mut good);
        // The end is the last output, as a rule; an event may have changed it since.
        let last = trajectory.times.last().zip(trajectory.energies.outputs.last());
        trajectory.energies.end = match (&outcome, last) {
            (Ok(Some(energy)), _) => *energy,
            (_, Some((t, energy))) if *t == trajectory.end.0 && trajectory.events.is_empty() => *energy,
            _ => model.hamiltonian(trajectory.end.0, &trajectory.end.1),
        };
        trajectory.computation.distinctness = distinctness(trajectory.end.1.phi());
        match outcome {
            Ok(_) => Ok(trajectory),
            Err(reason) => {
                // A closed form takes none, and a step that was refused is none.
                let steps = good.min(trajectory.statistics.steps);
                let stop = Stop { reason, t: trajectory.end.0, steps };
                Err(Halt { stop, trajectory: Box::new(trajectory) })
            }
        }
    }

    fn energy_at_start(&self) -> Energy {
        Energy::at(self.model, self.settings.plan.t0, &self.settings.start)
    }

    fn empty_trajectory(&self, at_start: &Energy) -> Trajectory<N, P> {
        let Settings { plan, start, dense, .. } = &self.settings;
        let dense = dense.map(|_| Box::new(Dense::new((plan.t0, *start))));
        Trajectory { dense, ..empty_trajectory(self.model, plan, start, at_start) }
    }

    /// To the end, or to an event that ends the run, by good steps; the energy there, where it was looked at.
    fn drive(
        &mut self,
        trajectory: &mut Trajectory<N, P>,
        at_start: Energy,
        good: &mut u64,
    ) -> Result<Option<f64>, Reason> {
        let description = self.model.description();
        let (t_end, schedule) = self.settings.checked(description)?;
        let Plan { t0, max_steps, .. } = self.settings.plan;
        check(t0, &self.settings.start)?;
        check_constraint(description.constraint, &self.settings.start)?;
        let events: Vec<&'static str> = self.settings.events.iter().map(|event| event.name).collect();
        let mut recorder = Recorder {
            model: self.model,
            needs_determinant: false,
            trajectory,
            keep: self.settings.dense,
            schedule,
            progress: self.settings.progress.take(),
            observe: self.settings.observe.take(),
            watcher: Watcher::new(core::mem::take(&mut self.settings.events), self.model.bases()),
            max_steps,
            origin: t0,
            t_end,
            steps: 0,
            backward: t_end < t0,
            place: Place::starting(Vec::new(), (Statistics::default(), 0.0)),
            witness: None,
            is_lost: false,
            turn: None,
        };
        let (mut origin, mut at_start) = ((t0, self.settings.start), Some(at_start));
        if let Some(checkpoint) = self.settings.checkpoint.take() {
            at_start = None;
            origin = self.take_up(checkpoint, &events, &mut recorder)?;
        }
        let outcome = self.legs(&mut origin, at_start, &mut recorder);
        *good = recorder.steps;
        let interrupted = matches!(outcome, Err(Reason::Interrupted(_) | Reason::StepLimit { .. }));
        if (interrupted || recorder.trajectory.stopped_by.is_some()) && !recorder.is_lost {
            let place = Place { outputs: recorder.schedule.taken(), ..recorder.place };
            let place = place.from(origin.0, &origin.1);
            let run = fingerprint(self.model, &self.settings, &events);
            recorder.trajectory.checkpoint = Some(Box::new(Checkpoint::new(run, place)));
        }
        self.settings.events = recorder.watcher.events;
        (self.settings.progress, self.settings.observe) = (recorder.progress, recorder.observe);
        outcome
    }

    /// Goes back to where a run was interrupted: time and point from which the integration started.
    fn take_up(
        &self,
        checkpoint: Checkpoint,
        events: &[&'static str],
        recorder: &mut Recorder<'_, '_, N, P>,
    ) -> Result<(f64, P), Setting> {
        let model = self.model.description().name;
        if !checkpoint.is_of(&fingerprint(self.model, &self.settings, events)) {
            return Err(Setting::Checkpoint { model });
        }
        if checkpoint.fused != FusedArithmetic::here() {
            recorder.trajectory.computation.fused_before = Some(checkpoint.fused);
        }
        let origin = checkpoint.place.origin(&self.settings.start);
        recorder.place = checkpoint.place;
        recorder.trajectory.computation.at_rest &= !recorder.place.moved;
        recorder.trajectory.computation.stiff_since = recorder.place.stiff_since();
        recorder.trajectory.end = origin;
        recorder.trajectory.energies.work_at_end = recorder.place.work();
        recorder.schedule.resume(recorder.place.outputs);
        Ok(origin)
    }

    /// One integration after the other: where an event changes the point, the next one starts, and `from` is where. The energy
    /// of the first may be known; that of the end, where it was looked at.
    fn legs(
        &self,
        from: &mut (f64, P),
        mut known: Option<Energy>,
        recorder: &mut Recorder<'_, '_, N, P>,
    ) -> Result<Option<f64>, Reason> {
        let mut changes = 0;
        loop {
            let energy = known.take().unwrap_or_else(|| Energy::at(self.model, from.0, &from.1));
            self.leg(from, &energy, recorder)?;
            // The point itself, where another method takes the motion.
            let recorded = matches!(recorder.turn, Some(Turn::Anew { .. }));
            let (t, point, work, accumulation) = match recorder.turn.take() {
                Some(Turn::Changed { t, point, work, accumulation }) => (t, point, work, accumulation),
                Some(Turn::Anew { t, point, work }) => {
                    recorder.trajectory.computation.stiff_since = Some(t);
                    (t, point, work, None)
                }
                Some(Turn::Stopped) => return Ok(None),
                None => return recorder.arrive(),
            };
            *from = (t, point);
            recorder.trajectory.end = *from;
            recorder.trajectory.energies.work_at_end = work;
            recorder.trajectory.computation.at_rest &= point.p().iter().all(|p| *p == 0.0);
            let cost = recorder.trajectory.statistics;
            let events = recorder.watcher.memory().to_vec();
            let moved = !recorder.trajectory.computation.at_rest;
            let stiff_since = recorder.trajectory.computation.stiff_since.unwrap_or(f64::NAN).to_bits();
            recorder.place = Place { recorded, moved, stiff_since, ..Place::starting(events, (cost, work)) };
            if let Some(reason) = accumulation {
                return Err(reason);
            }
            changes += 1;
            if changes > recorder.max_steps {
                return Err(Reason::StepLimit { limit: recorder.max_steps });
            }
            recorder.report(t)?;
        }
    }

    /// The motion from a point to the end, or to an event that changes it.
    fn leg(
        &self,
        from: &(f64, P),
        energy: &Energy,
        recorder: &mut Recorder<'_, '_, N, P>,
    ) -> Result<(), Reason> {
        let (t0, start) = (from.0, &from.1);
        let Plan { method, .. } = self.settings.plan;
        let tolerance = recorder.trajectory.computation.tolerance;
        let within_steps = recorder.has_events();
        let course = Course { t0, start, t_end: recorder.t_end, method, tolerance, within_steps };
        let geodesic = self.model.geodesic(t0, start);
        recorder.trajectory.computation.closed_form_exists = geodesic.is_some();
        let has_tolerance = method.step().is_none() && geodesic.is_none();
        recorder.begin_at_energy((t0, start), energy, has_tolerance.then_some(tolerance))?;
        match (method, geodesic) {
            (Method::ClosedForm, None) => {
                Err(Setting::NoClosedForm { model: self.model.description().name }.into())
            }
            (Method::Automatic | Method::ClosedForm, Some(geodesic)) => {
                let outcome = recorder.evaluate(&geodesic, &course);
                let (start, to) = ((t0, *start), recorder.turned_at());
                let dense = recorder.trajectory.dense.as_mut().filter(|_| to != t0);
                dense.into_iter().for_each(|dense| dense.close(&geodesic, start, to));
                outcome
            }
            _ => {
                recorder.begin(t0, start)?;
                let (mut choice, mut has_begun) = (Choice::default(), false);
                let outcome = self.model.follow(&course, &mut choice, &mut |motion, choice| {
                    has_begun = true;
                    recorder.note(choice);
                    recorder.follow(motion)
                });
                match has_begun {
                    true => recorder.look_back(&course),
                    false => recorder.note(&choice),
                }
                outcome
            }
        }
    }
}

/// A run before its first step.
pub(super) fn empty_trajectory<const N: usize, P: Phase<N>>(
    model: &dyn Mechanics<N, P>,
    plan: &Plan,
    start: &P,
    energy: &Energy,
) -> Trajectory<N, P> {
    let t0 = plan.t0;
    Trajectory {
        description: model.description(),
        bases: model.bases().map(Box::new),
        start: (t0, *start),
        end: (t0, *start),
        times: Vec::new(),
        points: Vec::new(),
        energies: Energies {
            start: energy.value,
            end: energy.value,
            outputs: Vec::new(),
            work: Vec::new(),
            work_at_end: 0.0,
            scale: energy.scale(),
        },
        statistics: Statistics::default(),
        events: Vec::new(),
        stopped_by: None,
        checkpoint: None,
        dense: None,
        computation: Computation {
            asked: plan.method,
            method: Method::RungeKutta8,
            tolerance: plan.tolerance_at(model, start),
            tolerance_asked: plan.tolerance,
            closed_form_exists: false,
            no_whirl: false,
            at_rest: start.p().iter().all(|p| *p == 0.0),
            missing: None,
            stiffness: None,
            friction: None,
            stiff_since: None,
            fused_before: None,
            condition: model.condition(start.phi()),
            residual: None,
            energy_defect: 0.0,
            unresolved_power: 0.0,
            turns: None,
            distinctness: 1.0,
        },
    }
}
