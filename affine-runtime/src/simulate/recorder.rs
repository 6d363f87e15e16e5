//! A trajectory in the making.

use super::checkpoint::{Bits, Place};
use super::course::Choice;
use super::dense::Keep;
use super::domain::Domain;
use super::energy::Energy;
use super::event::{Action, Occurrence};
use super::mechanics::Mechanics;
use super::motion::{Motion, WithWork};
use super::output::{Schedule, without_steps};
use super::point::{check, go_on};
use super::progress::{Observe, Progress, Watch};
use super::range::in_range;
use super::standing::Side;
use super::trajectory::Trajectory;
use super::watcher::{At, Met, Sampling, Step, Watcher};
use super::witness::Witness;
use crate::error::{Callback, Reason};
use crate::inner::{larger, norm};
use crate::state::Phase;

/// Samples of a step after which it tells how far it has come.
const SAMPLES_UNHEARD: u32 = 1 << 10;
/// Equal steps do not resolve forces that would take so many times the energy of the body within one of them.
const UNRESOLVED: f64 = 10.0;

/// What is recorded of a run, and how far it has come.
pub(super) struct Recorder<'r, 'a, const N: usize, P> {
    pub(super) model: &'a dyn Mechanics<N, P>,
    /// The method forms `det phi`.
    pub(super) needs_determinant: bool,
    pub(super) trajectory: &'r mut Trajectory<N, P>,
    /// How what lies between the outputs is kept, where it is.
    pub(super) keep: Option<Keep<N, P>>,
    pub(super) schedule: Schedule,
    pub(super) progress: Option<Watch<'a>>,
    pub(super) observe: Option<Observe<'a, P>>,
    pub(super) watcher: Watcher<'a, N, P>,
    pub(super) max_steps: u64,
    /// Time of the start of the run.
    pub(super) origin: f64,
    /// Time of its end.
    pub(super) t_end: f64,
    /// The run goes backward in time.
    pub(super) backward: bool,
    /// Accepted steps so far, or outputs of a closed form.
    pub(super) steps: u64,
    pub(super) place: Place,
    /// The energy since the integration started.
    pub(super) witness: Option<Witness>,
    /// The integrator's state cannot be kept.
    pub(super) is_lost: bool,
    /// What an event has led to.
    pub(super) turn: Option<Turn<P>>,
}

/// Where a run does not go straight on.
pub(super) enum Turn<P> {
    /// The run ends at the event.
    Stopped,
    /// It goes on from another point.
    Changed {
        t: f64,
        point: P,
        work: f64,
        /// Its changes accumulate: that is where the run ends.
        accumulation: Option<Reason>,
    },
    /// It goes on from where it is by a method that is chosen anew.
    Anew { t: f64, point: P, work: f64 },
}

impl<const N: usize, P: Phase<N>> Recorder<'_, '_, N, P> {
    /// Records the start of an integration where it is an output.
    pub(super) fn begin(&mut self, t0: f64, start: &P) -> Result<(), Reason> {
        self.watch_from(t0, start);
        if !self.place.integrator.is_empty() {
            return Ok(());
        }
        if self.schedule == Schedule::Steps {
            self.record_step(t0, (*start, 0.0))?;
        } else if self.schedule.take_through(t0, self.backward).is_some() {
            self.record(t0, (*start, 0.0))?;
        }
        Ok(())
    }

    /// Begins or goes on with a closed form, with output times of its own where none were asked for.
    pub(super) fn begin_closed_form(&mut self, t0: f64, rate: f64, at: &dyn Fn(f64) -> P) {
        if self.schedule == Schedule::Steps {
            self.schedule = without_steps(self.origin, self.t_end);
            self.schedule.resume(self.place.outputs);
            while t0 != self.origin && self.schedule.take_through(t0, self.backward).is_some() {}
        }
        let reached = self.place.integrator.first();
        let begin = reached.map_or(t0, |bits| f64::from_bits(*bits));
        let point = at(begin);
        self.watcher.begin(begin, &point, larger(rate, turning(self.model, &point)), &self.place.events);
    }

    /// Notes by which method the integration goes on.
    pub(super) fn note(&mut self, choice: &Choice) {
        let computation = &mut self.trajectory.computation;
        computation.method = choice.method;
        computation.stiffness = choice.stiffness;
        computation.friction = choice.friction;
        computation.missing = choice.missing;
        self.needs_determinant = choice.needs_determinant;
        self.place.spend(choice.evaluations);
    }

    /// Events are looked for, within steps.
    pub(super) fn has_events(&self) -> bool {
        !self.watcher.is_idle()
    }

    /// Begins to look for them where steps begin.
    fn watch_from(&mut self, t: f64, point: &P) {
        if self.has_events() {
            self.watcher.begin(t, point, turning(self.model, point), &self.place.events);
            self.watcher.begin_steps(self.model, point);
        }
    }

    /// Something may end the run, or ask where it is.
    pub(super) fn is_watched(&self) -> bool {
        self.observe.is_some() || self.has_events()
    }

    /// Gives an integrator the state in which an interrupted run left it.
    pub(super) fn take_up(&mut self, motion: &mut dyn Motion<P>) {
        if self.place.integrator.is_empty() {
            if self.is_watched() {
                self.pass(motion);
            }
            return;
        }
        motion.exchange(&mut Bits::Read(self.place.integrator.iter()));
        let t = motion.t();
        let (point, work) = motion.reached();
        self.watch_from(t, &point);
        self.trajectory.end = (t, point);
        self.trajectory.energies.work_at_end = self.place.work() + work;
    }

    /// A step is done with.
    pub(super) fn pass(&mut self, motion: &mut dyn Motion<P>) {
        self.is_lost = !motion.is_exchanged();
        let mut tape = Bits::Written(Vec::new());
        motion.exchange(&mut tape);
        if let Bits::Written(bits) = tape {
            self.passed(bits);
        }
    }

    /// The state of the integrator after a step, or the time in closed form, from which the run can go on.
    pub(super) fn passed(&mut self, integrator: Vec<u64>) {
        self.place.passed(integrator, self.watcher.memory());
    }

    /// Where the motion ends that is integrated: where an event changes the point, or at the last good one.
    pub(super) fn turned_at(&self) -> f64 {
        match &self.turn {
            Some(Turn::Changed { t, .. } | Turn::Anew { t, .. }) => *t,
            _ => self.trajectory.end.0,
        }
    }

    /// Tells how far the run has come.
    pub(super) fn report(&mut self, t: f64) -> Result<(), Reason> {
        let progress = Progress { t0: self.origin, t, t_end: self.t_end, steps: self.steps };
        match &mut self.progress {
            Some(watch) => go_on(watch(&progress), Callback::Progress),
            None => Ok(()),
        }
    }

    /// The events on the way to `end` with the outputs before them; whether the motion does not go straight on there. What the
    /// ends tell may be known.
    pub(super) fn meet(
        &mut self,
        end: f64,
        sampling: Sampling,
        told: Option<Step<P>>,
        at: &mut At<'_, P>,
    ) -> Result<bool, Reason> {
        if !self.has_events() {
            return Ok(false);
        }
        let (start, model) = (self.watcher.t(), self.model);
        let rate = |point: &P| larger(sampling.rate, turning(model, point));
        let told = match told {
            None if sampling.by_ends => self.watcher.passes(model, (end, sampling.rate), at)?,
            told => told.unwrap_or(Step::Open(None)),
        };
        let (known, is_crossed) = match told {
            Step::Quiet => return Ok(false),
            Step::Crossed(point) => (Some(point), true),
            Step::Open(point) => (point, false),
        };
        let (mut count, mut samples) = (0, 0_u32);
        while self.watcher.t() != end {
            let sample = if is_crossed { end } else { self.watcher.next(start, end, sampling) };
            for met in self.watcher.look((sample, known.filter(|_| sample == end)), rate, at)? {
                count += 1;
                self.watcher.happened(&met);
                // Those before had happened when the run was interrupted.
                if count > self.place.met {
                    let is_recorded = self.record_before(&met, at)?;
                    self.happen(count, &met, is_recorded)?;
                }
                if self.turn.is_some() {
                    return Ok(true);
                }
            }
            self.watcher.rest()?;
            self.watcher.pass();
            samples += 1;
            if samples.is_multiple_of(SAMPLES_UNHEARD) {
                self.report(sample)?;
            }
        }
        Ok(false)
    }

    /// The outputs up to an event; whether the last of them is at its time. Where a collapse ends the run, there is none of it.
    fn record_before(&mut self, met: &Met<P>, at: &mut At<'_, P>) -> Result<bool, Reason> {
        match (self.record_through(met.t, at), &self.watcher.events[met.event].action) {
            (Err(Reason::Placement { .. }), Action::Stop) => Ok(false),
            (recorded, _) => recorded.map(|last| last == Some(met.t)),
        }
    }

    /// An event that is the `count`th of its step happens. A change is not done with before the point is recorded.
    fn happen(&mut self, count: usize, met: &Met<P>, is_recorded: bool) -> Result<(), Reason> {
        let Met { t, point, work, to, .. } = *met;
        let event = &self.watcher.events[met.event];
        let name = event.name;
        if !point.is_finite() {
            return Err(Reason::NotFinite);
        }
        let occurrence = Occurrence { name, t, point, rising: to == Side::Positive };
        match &event.action {
            Action::Record => {
                self.trajectory.events.push(occurrence);
                self.place.met = count;
                Ok(())
            }
            Action::Stop => {
                self.trajectory.events.push(occurrence);
                self.place.met = count;
                self.turn = Some(Turn::Stopped);
                self.trajectory.stopped_by = Some(name);
                // A collapse is a placement without inverse, and may be the event.
                self.trajectory.end = (t, point);
                self.trajectory.energies.work_at_end = self.place.work() + work;
                match self.schedule.ends_with_output() && !is_recorded {
                    true => self.push(&Energy::at(self.model, t, &point)),
                    false => Ok(()),
                }
            }
            Action::Change(change) => {
                let changed = change(t, &point).ok().filter(|changed| check(t, changed).is_ok());
                if self.schedule == Schedule::Steps {
                    self.record_step(t, (point, work))?;
                }
                self.trajectory.events.push(occurrence);
                let Some(changed) = changed else {
                    // Nothing is to be made of a body that has collapsed itself.
                    return check(t, &point).and(Err(Reason::Change { event: name }));
                };
                let accumulation = self.watcher.change(met, &changed);
                // Behind the end of the run there is none to tell of.
                let (end, backward) = (self.t_end, self.backward);
                let accumulation = accumulation
                    .filter(|(t, _)| if backward { *t > end } else { *t < end })
                    .map(|(t, count)| Reason::Accumulation { event: name, t, count });
                let work = self.place.work() + work;
                self.turn = Some(Turn::Changed { t, point: changed, work, accumulation });
                Ok(())
            }
        }
    }

    /// Records the outputs that are due up to a time; that of the last one.
    pub(super) fn record_through(&mut self, t: f64, at: &mut At<'_, P>) -> Result<Option<f64>, Reason> {
        let mut last = None;
        while let Some(due) = self.schedule.take_through(t, self.backward) {
            self.record(due, at(due)?)?;
            last = Some(due);
        }
        Ok(last)
    }

    /// Records the end of a step, once.
    pub(super) fn record_step(&mut self, t: f64, point: WithWork<P>) -> Result<(), Reason> {
        // Left set where the observer ends the run.
        if core::mem::replace(&mut self.place.recorded, true) {
            self.reach(t, point)?;
        } else {
            self.record(t, point)?;
        }
        self.place.recorded = false;
        Ok(())
    }

    /// Checks a phase point, which becomes the last good one.
    pub(super) fn reach(&mut self, t: f64, point: WithWork<P>) -> Result<(), Reason> {
        check(t, &point.0)?;
        self.stand_at(t, point)
    }

    /// A phase point that was checked becomes the last good one.
    fn stand_at(&mut self, t: f64, (point, work): WithWork<P>) -> Result<(), Reason> {
        if self.needs_determinant {
            in_range(t, self.trajectory.orthonormal(&point).phi())?;
        }
        self.trajectory.end = (t, point);
        self.trajectory.energies.work_at_end = self.place.work() + work;
        Ok(())
    }

    /// Checks a phase point and its energy, records it as an output and shows it to the observer.
    pub(super) fn record(&mut self, t: f64, point: WithWork<P>) -> Result<(), Reason> {
        check(t, &point.0)?;
        let energy = self.witnessed(t, &point)?;
        self.stand_at(t, point)?;
        self.push(&energy)
    }

    /// Begins to hold the energy against what it is at the start of an integration.
    pub(super) fn begin_at_energy(
        &mut self,
        (t0, start): (f64, &P),
        energy: &Energy,
        tolerance: Option<f64>,
    ) -> Result<(), Reason> {
        Domain::at(self.model, (t0, start))?;
        if !energy.value.is_finite() {
            return Err(Reason::Energy { energy: energy.value, t: t0 });
        }
        let (before, scale) = ((energy, self.place.work()), self.place.largest_energy());
        self.witness = Some(Witness::begin(self.model.description(), before, scale, tolerance));
        Ok(())
    }

    /// Looks at the energy at the end, where that is no output; its value.
    pub(super) fn arrive(&mut self) -> Result<Option<f64>, Reason> {
        let Trajectory { end: (t, point), times, energies, computation, .. } = &*self.trajectory;
        if times.last() == Some(t) {
            return Ok(None);
        }
        // Of most ends the value says all.
        let (energy, has_equal_steps) =
            (self.model.hamiltonian(*t, point), computation.method.step().is_some());
        let is_kept = |witness: Witness| witness.keeps(energy, energies.work_at_end);
        if !has_equal_steps && self.witness.is_some_and(is_kept) {
            return Ok(Some(energy));
        }
        let reached = (*point, energies.work_at_end - self.place.work());
        self.witnessed(*t, &reached).map(|energy| Some(energy.value))
    }

    /// The energy of a point, held against that of the start.
    pub(super) fn witnessed(&mut self, t: f64, (point, work): &WithWork<P>) -> Result<Energy, Reason> {
        let energy = Energy::at(self.model, t, point);
        if let Some(witness) = &mut self.witness {
            let looked = witness.look(self.model, (t, point), (&energy, self.place.work() + work));
            self.place.met_energy(witness.scale());
            let defect = &mut self.trajectory.computation.energy_defect;
            *defect = larger(*defect, witness.worst());
            if let Some(step) = self.trajectory.computation.method.step() {
                let in_a_step = (step * self.model.power(t, point)).abs() / witness.scale();
                let unresolved = &mut self.trajectory.computation.unresolved_power;
                *unresolved =
                    if in_a_step > UNRESOLVED { larger(*unresolved, in_a_step) } else { *unresolved };
            }
            looked?;
        }
        Ok(energy)
    }

    /// Records the end so far, with its energy and the work there.
    fn push(&mut self, energy: &Energy) -> Result<(), Reason> {
        let Trajectory { end: (t, point), times, points, energies, .. } = &mut *self.trajectory;
        times.push(*t);
        points.push(*point);
        energies.outputs.push(energy.value);
        energies.work.push(energies.work_at_end);
        energies.scale = larger(energies.scale, energy.scale());
        match &mut self.observe {
            Some(observe) => go_on(observe(*t, point), Callback::Observer),
            None => Ok(()),
        }
    }
}

/// `|phi_dot|/|phi|`: what the body turns by, in radians, and its log-stretches change by in a unit of time.
fn turning<const N: usize, P: Phase<N>>(model: &dyn Mechanics<N, P>, point: &P) -> f64 {
    let rate = norm(model.velocity(point).phi_dot.as_slice()) / norm(point.phi().as_slice());
    if rate.is_nan() { 0.0 } else { rate }
}
