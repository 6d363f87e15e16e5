//! The integrators, each begun on the state that it steps.

use super::halt::{Reason, Setting};
use super::point::placement_in;
use super::recorder::Recorder;
use super::stepper::Explicit;
use super::{Method, Simulation, TAYLOR_TOLERANCE};
use crate::integrate::gauss::Tableau;
use crate::integrate::lie::{Chart, Coordinates};
use crate::integrate::rattle::{Composition, Reaction};
use crate::integrate::{
    Failure, Gauss, Rattle, RungeKutta5, RungeKutta8, RungeKuttaNystrom12, Splitting, Taylor,
};
use crate::model::{Constraint, Group, Model, StateVector};

impl<const N: usize, M: Model<N>> Simulation<'_, N, M> {
    /// The integrator to take, noted with what was missing for a better one.
    pub(super) fn chosen(&self, recorder: &mut Recorder<'_, '_, N, M>) -> Method {
        // Within steps it costs a step for each time that is looked at.
        let halves = self.model.second_order().is_some() && !recorder.has_events();
        let computation = &mut recorder.trajectory.computation;
        computation.method = match self.method {
            Method::Automatic if halves => Method::RungeKuttaNystrom12,
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
    pub(super) fn integrate_by_series(
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

    /// The halves of the reduced state by Runge-Kutta-Nystrom steps.
    pub(super) fn integrate_in_halves(
        &mut self,
        t_end: f64,
        recorder: &mut Recorder<'_, '_, N, M>,
    ) -> Result<(), Reason> {
        let model = self.model;
        recorder.begin(self.t0, self.start)?;
        let (reduced, constants) = model.reduce(self.t0, &self.start);
        let expand = |t: f64, reduced: &M::Reduced<f64>| model.expand(t, &constants, reduced);
        let (groups, begin) = (M::DESCRIPTION.reduced, (self.t0, reduced));
        let system = model.second_order();
        let system = system.ok_or(Setting::NotEmitted { model: M::DESCRIPTION.name, key: "nystrom" })?;
        let integration = RungeKuttaNystrom12::new((system, constants), groups, begin, t_end, self.tolerance);
        let mut integration = integration.map_err(|failure| self.reason(failure))?;
        self.step_through(&mut integration, expand, groups, t_end, recorder)
    }

    /// Reduction, integration with output on the way, expansion.
    pub(super) fn integrate<C: Coordinates<M::Reduced<f64>>>(
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
    pub(super) fn integrate_with_reaction(
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
            Method::RungeKutta5 => {
                let integration =
                    RungeKutta5::within(coordinates, equations, groups, begin, t_end, self.tolerance);
                let mut integration = Explicit::new(integration.map_err(|failure| self.reason(failure))?);
                self.step_through(&mut integration, expand, groups, t_end, recorder)
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
    pub(super) fn integrate_by_rattle(
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
    pub(super) fn integrate_by_splitting(
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

    pub(super) fn reason(&self, failure: Failure) -> Reason {
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

/// The chart of the group to which the motion is confined, where the reduced state holds the placement.
pub(super) fn chart<const N: usize, M: Model<N>>() -> Option<Chart<N>> {
    let placement = placement_in(M::DESCRIPTION.reduced, N)?;
    Some(Chart::new(M::DESCRIPTION.constraint?, placement.start))
}

/// The reduced equations are those of the body without constraint, over `phi` and `Pi`.
pub(super) fn is_canonical<const N: usize, M: Model<N>>() -> bool {
    M::DESCRIPTION.reduced.iter().any(|group| group.name == "Pi")
}
