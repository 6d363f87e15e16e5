//! Running a simulation: checks, the closed form, the integration.

use core::ops::{ControlFlow, Range};

use super::conservation::larger;
use super::halt::{Callback, Halt, Outcome, Reason, Setting, Stop};
use super::output::{Schedule, without_steps};
use super::stepper::{Explicit, Stepper};
use super::trajectory::{Computation, Energies, Trajectory};
use super::{Method, Observe, Progress, Simulation, Watch};
use crate::frames::Matrix;
use crate::geodesic::{Geodesic, Motion};
use crate::integrate::gauss::{Tableau, step_count};
use crate::integrate::{Failure, Gauss, RungeKutta8, Statistics, norm};
use crate::kinematics::LogDeterminant;
use crate::model::{Group, Model, StateVector, WORK};
use crate::state::Phase;

/// The finest tolerance: about four roundings.
const FINEST_TOLERANCE: f64 = 1e-15;
/// Part of `|phi|^n` above which a determinant is positive whatever the rounding of a few products.
const CLEARLY_POSITIVE: f64 = 1e-12;

impl<const N: usize, M: Model<N>> Simulation<'_, N, M> {
    /// Runs the simulation.
    ///
    /// Every step and every output is checked: finite, and `det phi > 0`. What happens between two of them is not
    /// seen: a body without a potential that prevents it may collapse and turn inside out twice in between.
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
        trajectory.energies.end = model.hamiltonian(trajectory.end.0, &trajectory.end.1);
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
            computation: Computation {
                asked: self.method,
                method: Method::RungeKutta8,
                tolerance: self.tolerance,
                closed_form_exists: false,
                no_whirl: false,
                at_rest: self.start.p().iter().all(|p| *p == 0.0),
                residual: None,
            },
        }
    }

    fn drive(mut self, trajectory: &mut Trajectory<N, M::Point<f64>>) -> Result<(), Reason> {
        let (t_end, schedule) = self.checked_settings()?;
        check(self.t0, &self.start)?;
        let geodesic = self.model.geodesic(self.t0, &self.start);
        trajectory.computation.closed_form_exists = geodesic.is_some();
        let mut recorder = Recorder { model: self.model, trajectory, schedule, observe: self.observe.take() };
        match (self.method, geodesic) {
            (Method::ClosedForm, None) => Err(Setting::NoClosedForm { model: M::DESCRIPTION.name }.into()),
            (Method::Automatic | Method::ClosedForm, Some(geodesic)) => {
                self.evaluate(&geodesic, t_end, &mut recorder)
            }
            (Method::Automatic, None) | (Method::RungeKutta8 | Method::Gauss { .. }, _) => {
                self.integrate(t_end, &mut recorder)
            }
        }
    }

    fn checked_settings(&self) -> Result<(f64, Schedule), Setting> {
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
        if let Method::Gauss { stages, step } = self.method {
            Tableau::of_stages(stages).ok_or(Setting::Stages { given: stages })?;
            if !step.is_finite() || step_count(self.t0, t_end, step).is_none() {
                return Err(Setting::Step { given: step, t0: self.t0, t_end });
            }
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
        if recorder.schedule == Schedule::Steps {
            recorder.schedule = without_steps(self.t0, t_end);
        }
        let at = |t| if t == self.t0 { self.start } else { self.model.on_geodesic(geodesic, t, &self.start) };
        let mut outputs = 0;
        while let Some(t) = recorder.schedule.take_through(t_end, t_end < self.t0) {
            recorder.record(t, at(t), 0.0)?;
            outputs += 1;
            report(&mut self.progress, Progress { t0: self.t0, t, t_end, steps: outputs })?;
        }
        recorder.reach(t_end, at(t_end), 0.0)
    }

    /// Reduction, integration with output on the way, expansion.
    fn integrate(&mut self, t_end: f64, recorder: &mut Recorder<'_, '_, N, M>) -> Result<(), Reason> {
        let model = self.model;
        if recorder.schedule == Schedule::Steps || recorder.schedule.take_through(self.t0, false).is_some() {
            recorder.record(self.t0, self.start, 0.0)?;
        }
        let (reduced, constants) = model.reduce(self.t0, &self.start);
        let equations = |t: f64, reduced: &M::Reduced<f64>| model.reduced_equations(t, &constants, reduced);
        let begin = (self.t0, reduced);
        match self.method {
            Method::Gauss { stages, step } => {
                let tableau = Tableau::of_stages(stages).ok_or(Setting::Stages { given: stages })?;
                let integration = Gauss::new(equations, tableau, begin, t_end, step);
                let mut integration = integration.map_err(|failure| self.reason(failure))?;
                recorder.trajectory.computation.method = self.method;
                let outcome = self.step_through(&mut integration, &constants, t_end, recorder);
                recorder.trajectory.computation.residual = Some(integration.residual());
                outcome
            }
            _ => {
                let groups = M::DESCRIPTION.reduced;
                let integration = RungeKutta8::new(equations, groups, begin, t_end, self.tolerance);
                let mut integration = Explicit::new(integration.map_err(|failure| self.reason(failure))?);
                self.step_through(&mut integration, &constants, t_end, recorder)
            }
        }
    }

    /// Steps to the end with output on the way, and the expansion of the last good step.
    fn step_through(
        &mut self,
        integration: &mut impl Stepper<M::Reduced<f64>>,
        constants: &M::Constants<f64>,
        t_end: f64,
        recorder: &mut Recorder<'_, '_, N, M>,
    ) -> Result<(), Reason> {
        let model = self.model;
        let expand = |t: f64, reduced: &M::Reduced<f64>| model.expand(t, constants, reduced);
        let mut last = None;
        let outcome = self.follow(integration, expand, t_end, recorder, &mut last);
        let trajectory = &mut *recorder.trajectory;
        trajectory.statistics = integration.statistics();
        if let Some((t, reduced)) = last.filter(|(t, _)| (t - trajectory.end.0) * (t_end - self.t0) > 0.0) {
            trajectory.end = (t, expand(t, &reduced));
            trajectory.energies.work_at_end = work::<N, M>(&reduced);
        }
        outcome
    }

    /// Steps to the end. A step without output whose reduced state shows that it is good is not expanded: it is
    /// only left in `last`, for a halt in the next one.
    fn follow(
        &mut self,
        integration: &mut impl Stepper<M::Reduced<f64>>,
        expand: impl Fn(f64, &M::Reduced<f64>) -> M::Point<f64>,
        t_end: f64,
        recorder: &mut Recorder<'_, '_, N, M>,
        last: &mut Option<(f64, M::Reduced<f64>)>,
    ) -> Result<(), Reason> {
        let placement = placement_in(M::DESCRIPTION.reduced, N);
        while !integration.is_finished() {
            let steps = integration.statistics().steps;
            if steps == self.max_steps {
                return Err(Reason::StepLimit { limit: self.max_steps });
            }
            integration.advance().map_err(|failure| self.reason(failure))?;
            let (t, reduced) = (integration.t(), *integration.y());
            while let Some(due) = recorder.schedule.take_through(t, t_end < self.t0) {
                if due == t {
                    recorder.record(t, expand(t, &reduced), work::<N, M>(&reduced))?;
                } else {
                    let between = integration.between(due).map_err(|failure| self.reason(failure))?;
                    recorder.record(due, expand(due, &between), work::<N, M>(&between))?;
                }
            }
            if recorder.schedule == Schedule::Steps {
                recorder.record(t, expand(t, &reduced), work::<N, M>(&reduced))?;
            } else if recorder.trajectory.end.0 != t {
                let phi =
                    placement.clone().map(|range| Matrix::<N>::from_row_slice(&reduced.as_ref()[range]));
                if integration.is_finished() || !phi.is_some_and(|phi| is_clearly_positive(&phi)) {
                    recorder.reach(t, expand(t, &reduced), work::<N, M>(&reduced))?;
                }
            }
            *last = Some((t, reduced));
            report(&mut self.progress, Progress { t0: self.t0, t, t_end, steps: steps + 1 })?;
        }
        Ok(())
    }

    fn reason(&self, failure: Failure) -> Reason {
        match failure {
            Failure::NotFinite => Reason::NotFinite,
            Failure::StepUnderflow => Reason::StepUnderflow { tolerance: self.tolerance },
            Failure::NoSolution { residual } => {
                let step = if let Method::Gauss { step, .. } = self.method { step } else { f64::NAN };
                Reason::NoSolution { residual, step }
            }
        }
    }
}

/// A trajectory in the making.
struct Recorder<'r, 'a, const N: usize, M: Model<N>> {
    model: &'a M,
    trajectory: &'r mut Trajectory<N, M::Point<f64>>,
    schedule: Schedule,
    observe: Option<Observe<'a, M::Point<f64>>>,
}

impl<const N: usize, M: Model<N>> Recorder<'_, '_, N, M> {
    /// Checks a phase point, which becomes the last good one.
    fn reach(&mut self, t: f64, point: M::Point<f64>, work: f64) -> Result<(), Reason> {
        check(t, &point)?;
        self.trajectory.end = (t, point);
        self.trajectory.energies.work_at_end = work;
        Ok(())
    }

    /// Checks a phase point, records it as an output and shows it to the observer.
    fn record(&mut self, t: f64, point: M::Point<f64>, work: f64) -> Result<(), Reason> {
        self.reach(t, point, work)?;
        self.trajectory.times.push(t);
        self.trajectory.points.push(point);
        let energy = self.model.hamiltonian(t, &point);
        let energies = &mut self.trajectory.energies;
        energies.outputs.push(energy);
        energies.work.push(work);
        energies.scale = larger(energies.scale, energy_scale(self.model, &point, energy));
        match &mut self.observe {
            Some(observe) => go_on(observe(t, &point), Callback::Observer),
            None => Ok(()),
        }
    }
}

fn report(watch: &mut Option<Watch<'_>>, progress: Progress) -> Result<(), Reason> {
    match watch {
        Some(watch) => go_on(watch(&progress), Callback::Progress),
        None => Ok(()),
    }
}

fn go_on(flow: ControlFlow<()>, callback: Callback) -> Result<(), Reason> {
    match flow {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(Reason::Interrupted(callback)),
    }
}

/// Refuses a phase point that is not finite or whose placement does not keep orientation.
fn check<const N: usize, P: Phase<N>>(t: f64, point: &P) -> Result<(), Reason> {
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
fn is_clearly_positive<const N: usize>(phi: &Matrix<N>) -> bool {
    let minor = |a: usize, b: usize| phi[(1, a)] * phi[(2, b)] - phi[(1, b)] * phi[(2, a)];
    let size = norm(phi.as_slice());
    match N {
        2 => phi[(0, 0)] * phi[(1, 1)] - phi[(0, 1)] * phi[(1, 0)] > CLEARLY_POSITIVE * size * size,
        3 => {
            let determinant =
                phi[(0, 0)] * minor(1, 2) - phi[(0, 1)] * minor(0, 2) + phi[(0, 2)] * minor(0, 1);
            determinant > CLEARLY_POSITIVE * size * size * size
        }
        _ => false,
    }
}

/// What an energy is measured against: `|H|`, or `(|Pi| |phi_dot| + |p| |x_dot|)/2`, which is at least `|T|`.
fn energy_scale<const N: usize, M: Model<N>>(model: &M, point: &M::Point<f64>, energy: f64) -> f64 {
    let velocity = model.velocity(point);
    let internal = norm(point.pi().0.0.as_slice()) * norm(velocity.phi_dot.as_slice());
    let translational = norm(point.p().as_slice()) * norm(velocity.x_dot.as_slice());
    larger(energy.abs(), 0.5 * (internal + translational))
}

/// Components of a reduced state that are the placement, row by row, up to factors of positive determinant that
/// the expansion restores.
fn placement_in(groups: &[Group], n: usize) -> Option<Range<usize>> {
    let k = groups.iter().position(|group| group.name == "phi" && group.len == n * n)?;
    let start = total(&groups[..k]);
    Some(start..start + n * n)
}

/// The work of the forces that no potential has, where the reduced state holds it.
fn work<const N: usize, M: Model<N>>(reduced: &M::Reduced<f64>) -> f64 {
    let groups = M::DESCRIPTION.reduced;
    let place = groups.iter().position(|group| group.name == WORK).map(|k| total(&groups[..k]));
    place.map_or(0.0, |place| reduced.as_ref()[place])
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
