//! Running a simulation: checks, the closed form, the integration.

use core::ops::{ControlFlow, Range};

use super::checkpoint::{Checkpoint, Place};
use super::collapse::first_failure;
use super::conservation::larger;
use super::halt::{Callback, Halt, Outcome, Reason, Setting, Stop};
use super::output::Schedule;
use super::range::in_range;
use super::recorder::{Recorder, Turn, WithWork};
use super::signature::Signature;
use super::stepper::{Explicit, Stepper};
use super::trajectory::{Computation, Energies, Trajectory};
use super::watcher::Watcher;
use super::{Method, Progress, Simulation, TAYLOR_TOLERANCE, Watch};
use crate::frames::Matrix;
use crate::geodesic::{Geodesic, Motion};
use crate::integrate::gauss::{Tableau, step_count};
use crate::integrate::lie::{Chart, Coordinates, Flat};
use crate::integrate::rattle::{Composition, Reaction};
use crate::integrate::splitting::{Splitting, Sweeps};
use crate::integrate::taylor::{HIGHEST_ORDER, LOWEST_ORDER, Taylor};
use crate::integrate::{Failure, Gauss, Rattle, RungeKutta8, Statistics, norm, sum_of_squares};
use crate::kinematics::LogDeterminant;
use crate::model::{Constraint, Group, Model, StateVector, WORK};
use crate::state::Phase;

/// The finest tolerance: about four roundings.
const FINEST_TOLERANCE: f64 = 1e-15;
/// Equal parts of a step at whose ends events are looked at.
const WITHIN_A_STEP: u32 = 4;
/// Part of the way to a collapse within which an event that follows belongs to it: times of a collapse and of the zero of
/// an event have errors of their own.
const PAST_A_COLLAPSE: f64 = 1e-8;
/// Part of `|phi|^n` above which a determinant is positive whatever the rounding of a few products.
const CLEARLY_POSITIVE: f64 = 1e-12;

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
        let run = self.fingerprint(t_end);
        let place = Place::starting((self.t0, &self.start), None, (Statistics::default(), 0.0));
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
            self.take_up(checkpoint, &run, &mut recorder)?;
        }
        let outcome = self.legs(t_end, &mut recorder);
        let interrupted = matches!(outcome, Err(Reason::Interrupted(_) | Reason::StepLimit { .. }));
        if (interrupted || recorder.trajectory.stopped_by.is_some()) && !recorder.is_lost {
            let place = Place { outputs: recorder.schedule.taken(), ..recorder.place };
            recorder.trajectory.checkpoint = Some(Checkpoint { run, place });
        }
        outcome
    }

    /// What a checkpoint fits: runs that take the same steps from the same place.
    fn fingerprint(&self, t_end: f64) -> String {
        let [t0, t_end, tolerance] = [self.t0, t_end, self.tolerance].map(f64::to_bits);
        let (model, method, events) = (M::DESCRIPTION.name, self.method, self.events.len());
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
            recorder.place = Place::starting((t, &point), Some(event), (cost, work));
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
            _ => match (chart::<N, M>(), self.chosen(&mut recorder.trajectory.computation)) {
                (_, Method::Taylor { order }) => self.integrate_by_series(order, t_end, recorder),
                (Some(_), _) if is_canonical::<N, M>() => self.integrate_with_reaction(t_end, recorder),
                (Some(chart), _) => self.integrate(chart, t_end, recorder),
                (None, _) => self.integrate(Flat, t_end, recorder),
            },
        }
    }

    pub(super) fn checked_settings(&self) -> Result<(f64, Schedule), Setting> {
        let t_end = self.t_end.ok_or(Setting::NoEnd)?;
        for (name, given) in [("the time of the start", self.t0), ("the time of the end", t_end)] {
            if !given.is_finite() {
                return Err(Setting::Time { name, given });
            }
        }
        if !(FINEST_TOLERANCE..1.0).contains(&self.tolerance) {
            return Err(Setting::Tolerance { given: self.tolerance });
        }
        if self.max_steps == 0 {
            return Err(Setting::NoSteps);
        }
        for event in &self.events {
            if let Some(index) = event.out_of_range {
                return Err(Setting::EventIndex { event: event.name, index });
            }
        }
        match self.method {
            Method::Taylor { order: Some(given) } if !(LOWEST_ORDER..=HIGHEST_ORDER).contains(&given) => {
                return Err(Setting::Order { given });
            }
            Method::Gauss { stages, .. } => {
                Tableau::of_stages(stages).ok_or(Setting::Stages { given: stages })?;
            }
            Method::Rattle { order, .. } => {
                Composition::of_order(order).ok_or(Setting::Order { given: order })?;
                if M::DESCRIPTION.constraint != Some(Constraint::Isochoric) {
                    return Err(Setting::NotIsochoric { model: M::DESCRIPTION.name });
                }
            }
            Method::Splitting { order, .. } if Sweeps::of_order(order, false).is_none() => {
                return Err(Setting::Order { given: order });
            }
            _ => {}
        }
        if let Some(step) = self.method.step()
            && (!step.is_finite() || step_count(self.t0, t_end, step).is_none())
        {
            return Err(Setting::Step { given: step, t0: self.t0, t_end });
        }
        Ok((t_end, self.output.schedule(self.t0, t_end)?))
    }

    /// The closed form at the output times.
    fn evaluate(
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

    /// The integrator to take, noted with what was missing for a better one.
    fn chosen(&self, computation: &mut Computation) -> Method {
        computation.method = match self.method {
            Method::Automatic
                if self.tolerance <= TAYLOR_TOLERANCE && M::DESCRIPTION.constraint.is_none() =>
            {
                if self.model.taylor().is_some() {
                    Method::Taylor { order: None }
                } else {
                    computation.missing = Some("taylor");
                    Method::RungeKutta8
                }
            }
            Method::Automatic => Method::RungeKutta8,
            asked => asked,
        };
        computation.method
    }

    /// The reduced state by its Taylor series.
    fn integrate_by_series(
        &mut self,
        order: Option<usize>,
        t_end: f64,
        recorder: &mut Recorder<'_, '_, N, M>,
    ) -> Result<(), Reason> {
        let model = self.model;
        recorder.begin(self.t0, self.start)?;
        let (reduced, constants) = model.reduce(self.t0, &self.start);
        let expand = |t: f64, reduced: &M::Reduced<f64>| model.expand(t, &constants, reduced);
        let (groups, begin) = (M::DESCRIPTION.reduced, (self.t0, reduced));
        let series = model.taylor();
        let series = series.ok_or(Setting::NotEmitted { model: M::DESCRIPTION.name, key: "taylor" })?;
        let integration = Taylor::new((series, constants), groups, begin, t_end, self.tolerance, order);
        let mut integration = integration.map_err(|failure| self.reason(failure))?;
        self.step_through(&mut integration, expand, groups, t_end, recorder)
    }

    /// Reduction, integration with output on the way, expansion.
    fn integrate<C: Coordinates<M::Reduced<f64>>>(
        &mut self,
        coordinates: C,
        t_end: f64,
        recorder: &mut Recorder<'_, '_, N, M>,
    ) -> Result<(), Reason> {
        let model = self.model;
        recorder.begin(self.t0, self.start)?;
        let (reduced, constants) = model.reduce(self.t0, &self.start);
        let equations = |t: f64, reduced: &M::Reduced<f64>| model.reduced_equations(t, &constants, reduced);
        let expand = |t: f64, reduced: &M::Reduced<f64>| model.expand(t, &constants, reduced);
        let state = (M::DESCRIPTION.reduced, reduced);
        if !matches!(self.method, Method::Gauss { .. }) {
            return self.integrate_in(coordinates, equations, state, expand, t_end, recorder);
        }
        // What is carried along would spoil the geometry of the method: it is computed from the rest.
        let closed = |t: f64, reduced: &M::Reduced<f64>| equations(t, &model.renewed(reduced));
        self.integrate_in(coordinates, closed, state, expand, t_end, recorder)
    }

    /// The phase point of a separable isochoric body on SL(n): its equations are the free ones, to which the multiplier is
    /// added.
    fn integrate_with_reaction(
        &mut self,
        t_end: f64,
        recorder: &mut Recorder<'_, '_, N, M>,
    ) -> Result<(), Reason> {
        let model = self.model;
        recorder.begin(self.t0, self.start)?;
        let groups = M::DESCRIPTION.full;
        let free = |t: f64, full: &M::Full<f64>| model.hamilton_equations(t, full);
        let start = model.flatten(&self.start);
        let reaction = Reaction::<N>::of(groups, &free, (self.t0, &start));
        let reaction = reaction.map_err(|failure| self.reason(failure))?;
        let placement =
            placement_in(groups, N).ok_or(Setting::NotSeparable { model: M::DESCRIPTION.name })?;
        let chart = Chart::<N>::new(Constraint::Isochoric, placement.start);
        let equations = |t: f64, full: &M::Full<f64>| reaction.rates(&free, t, full);
        let expand = |_: f64, full: &M::Full<f64>| model.unflatten(&reaction.with_momentum(full));
        let state = (groups, reaction.with_velocity(&start));
        self.integrate_in(chart, equations, state, expand, t_end, recorder)
    }

    /// Integration of a state by the method asked for.
    fn integrate_in<S: StateVector<f64>>(
        &mut self,
        coordinates: impl Coordinates<S>,
        equations: impl Fn(f64, &S) -> S,
        (groups, start): (&'static [Group], S),
        expand: impl Fn(f64, &S) -> M::Point<f64>,
        t_end: f64,
        recorder: &mut Recorder<'_, '_, N, M>,
    ) -> Result<(), Reason> {
        let begin = (self.t0, start);
        match self.method {
            Method::Gauss { stages, step } => {
                let tableau = Tableau::of_stages(stages).ok_or(Setting::Stages { given: stages })?;
                let integration = Gauss::within(coordinates, equations, tableau, begin, t_end, step);
                let mut integration = integration.map_err(|failure| self.reason(failure))?;
                recorder.trajectory.computation.method = self.method;
                let outcome = self.step_through(&mut integration, expand, groups, t_end, recorder);
                recorder.trajectory.computation.residual = Some(integration.residual());
                outcome
            }
            _ => {
                let integration =
                    RungeKutta8::within(coordinates, equations, groups, begin, t_end, self.tolerance);
                let mut integration = Explicit::new(integration.map_err(|failure| self.reason(failure))?);
                self.step_through(&mut integration, expand, groups, t_end, recorder)
            }
        }
    }

    /// RATTLE on the phase point itself.
    fn integrate_by_rattle(
        &mut self,
        (order, step): (usize, f64),
        t_end: f64,
        recorder: &mut Recorder<'_, '_, N, M>,
    ) -> Result<(), Reason> {
        let model = self.model;
        recorder.begin(self.t0, self.start)?;
        let composition = Composition::of_order(order).ok_or(Setting::Order { given: order })?;
        let equations = |t: f64, full: &M::Full<f64>| model.hamilton_equations(t, full);
        let expand = |_: f64, full: &M::Full<f64>| model.unflatten(full);
        let (groups, begin) = (M::DESCRIPTION.full, (self.t0, model.flatten(&self.start)));
        let integration = Rattle::<N, _, _>::new(equations, groups, composition, begin, t_end, step);
        let mut integration = integration.map_err(|failure| self.reason(failure))?;
        recorder.trajectory.computation.method = self.method;
        let outcome = self.step_through(&mut integration, expand, groups, t_end, recorder);
        recorder.trajectory.computation.residual = Some(integration.residual());
        outcome
    }

    /// The reduced state by the exact flows of pieces.
    fn integrate_by_splitting(
        &mut self,
        (order, step): (usize, f64),
        t_end: f64,
        recorder: &mut Recorder<'_, '_, N, M>,
    ) -> Result<(), Reason> {
        let model = self.model;
        recorder.begin(self.t0, self.start)?;
        let (reduced, constants) = model.reduce(self.t0, &self.start);
        let expand = |t: f64, reduced: &M::Reduced<f64>| model.expand(t, &constants, reduced);
        let pieces = model.splitting();
        let pieces = pieces.ok_or(Setting::NotEmitted { model: M::DESCRIPTION.name, key: "splitting" })?;
        let begin = (self.t0, reduced);
        let integration = Splitting::new((pieces, constants), order, begin, t_end, step);
        let integration = integration.ok_or(Setting::Order { given: order })?;
        let mut integration = integration.map_err(|failure| self.reason(failure))?;
        recorder.trajectory.computation.method = self.method;
        self.step_through(&mut integration, expand, M::DESCRIPTION.reduced, t_end, recorder)
    }

    /// Steps to the end with output on the way, and the expansion of the last good step.
    fn step_through<S: StateVector<f64>>(
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

    fn reason(&self, failure: Failure) -> Reason {
        match failure {
            Failure::NotFinite => Reason::NotFinite,
            Failure::StepUnderflow => Reason::StepUnderflow { tolerance: self.tolerance },
            Failure::NoSolution { residual } => {
                Reason::NoSolution { residual, step: self.method.step().unwrap_or(f64::NAN) }
            }
            Failure::NotSeparable => Setting::NotSeparable { model: M::DESCRIPTION.name }.into(),
            Failure::OffConstraint { defect } => Setting::OffConstraint { defect }.into(),
        }
    }
}

fn report(watch: &mut Option<Watch<'_>>, progress: Progress) -> Result<(), Reason> {
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

pub(super) fn go_on(flow: ControlFlow<()>, callback: Callback) -> Result<(), Reason> {
    match flow {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(Reason::Interrupted(callback)),
    }
}

/// Refuses a phase point that is not finite or whose placement does not keep orientation.
pub(super) fn check<const N: usize, P: Phase<N>>(t: f64, point: &P) -> Result<(), Reason> {
    if !point.is_finite() {
        return Err(Reason::NotFinite);
    }
    if is_clearly_positive(point.phi()) {
        return Ok(());
    }
    let determinant = LogDeterminant::of(point.phi());
    if determinant.is_positive() {
        return Ok(());
    }
    Err(Reason::Placement { determinant: determinant.to_f64(), t })
}

/// A few products settle the sign of most determinants; what is close to zero, or out of the range of numbers,
/// is left to the careful way.
pub(super) fn is_clearly_positive<const N: usize>(phi: &Matrix<N>) -> bool {
    let minor = |a: usize, b: usize| phi[(1, a)] * phi[(2, b)] - phi[(1, b)] * phi[(2, a)];
    let scale = sum_of_squares(phi.as_slice());
    // `det > c |phi|^n` without the root.
    let exceeds = |determinant: f64, power: f64| {
        determinant > 0.0 && determinant * determinant > CLEARLY_POSITIVE * CLEARLY_POSITIVE * power
    };
    match N {
        2 => exceeds(phi[(0, 0)] * phi[(1, 1)] - phi[(0, 1)] * phi[(1, 0)], scale * scale),
        3 => {
            let determinant =
                phi[(0, 0)] * minor(1, 2) - phi[(0, 1)] * minor(0, 2) + phi[(0, 2)] * minor(0, 1);
            exceeds(determinant, scale * scale * scale)
        }
        _ => false,
    }
}

/// What an energy is measured against: `|H|`, or `(|Pi| |phi_dot| + |p| |x_dot|)/2`, which is at least `|T|`.
pub(super) fn energy_scale<const N: usize, M: Model<N>>(
    model: &M,
    point: &M::Point<f64>,
    energy: f64,
) -> f64 {
    let velocity = model.velocity(point);
    let internal = norm(point.pi().0.0.as_slice()) * norm(velocity.phi_dot.as_slice());
    let translational = norm(point.p().as_slice()) * norm(velocity.x_dot.as_slice());
    larger(energy.abs(), 0.5 * (internal + translational))
}

/// The chart of the group to which the motion is confined, where the reduced state holds the placement.
fn chart<const N: usize, M: Model<N>>() -> Option<Chart<N>> {
    let placement = placement_in(M::DESCRIPTION.reduced, N)?;
    Some(Chart::new(M::DESCRIPTION.constraint?, placement.start))
}

/// The reduced equations are those of the body without constraint, over `phi` and `Pi`.
pub(super) fn is_canonical<const N: usize, M: Model<N>>() -> bool {
    M::DESCRIPTION.reduced.iter().any(|group| group.name == "Pi")
}

/// Components of a state that are the placement, row by row, up to factors of positive determinant that
/// the expansion restores.
pub(super) fn placement_in(groups: &[Group], n: usize) -> Option<Range<usize>> {
    let k = groups.iter().position(|group| group.is_placement() && group.len == n * n)?;
    let start = total(&groups[..k]);
    Some(start..start + n * n)
}

/// The work of the forces that no potential has, where the state holds it.
fn work<S: StateVector<f64>>(groups: &[Group], state: &S) -> f64 {
    let place = groups.iter().position(|group| group.name == WORK).map(|k| total(&groups[..k]));
    place.map_or(0.0, |place| state.as_ref()[place])
}

const fn total(groups: &[Group]) -> usize {
    let mut total = 0;
    let mut k = 0;
    while k < groups.len() {
        total += groups[k].len;
        k += 1;
    }
    total
}
