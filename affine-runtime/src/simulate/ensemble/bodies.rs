//! Bodies of an ensemble on their way through lanes.

use core::ops::Range;

use super::ends::EndsInLanes;
use crate::capability::InLanes;
use crate::error::Reason;
use crate::frames::Matrix;
use crate::inner::{Equations, Fate, IS_FUSED, RungeKutta8InLanes, gathered};
use crate::inner::{Start, starts_in_lanes};
use crate::lanes::Lanes;
use crate::model::{Group, Model, StateVector};
use crate::simulate::layout::{Layout, placement_in};
use crate::simulate::mechanics::Moving;
use crate::simulate::methods::automatic;
use crate::simulate::motion::{Followed, WithWork};
use crate::simulate::orientation::{Moment, keeps_orientation, passes_through_zero};
use crate::simulate::point::is_clearly_positive;
use crate::simulate::settings::Plan;
use crate::simulate::watcher::Ends;
use crate::state::Phase;

/// A body before its first step.
pub(super) struct Begun<'a, const N: usize, M: InLanes<N>> {
    pub(super) body: usize,
    model: &'a M,
    point: &'a M::Point<f64>,
    state: M::Reduced<f64>,
    constants: M::Constants<f64>,
    start: Start<M::Reduced<f64>>,
}

/// As many bodies as there are lanes, or fewer, at their start; those are left out for which there is nothing to begin with.
pub(super) fn begun<'a, const N: usize, T: Lanes, M: InLanes<N>>(
    (plan, t_end): (&Plan, f64),
    points: &[(usize, &'a M, &'a M::Point<f64>)],
) -> Vec<Begun<'a, N, M>> {
    let t0 = plan.t0;
    let Some(&(_, first, _)) = points.first() else { return Vec::new() };
    let (states, constants): (Vec<_>, Vec<_>) =
        points.iter().map(|(_, model, point)| model.reduce(t0, point)).unzip();
    let models = points.iter().map(|(_, model, _)| *model).collect();
    let equations = Reduced { first, models, constants: M::constants_in_lanes::<T>(&constants) };
    let mut in_lanes = M::Reduced::<T>::zeros();
    for (k, component) in in_lanes.as_mut().iter_mut().enumerate() {
        *component = gathered(&states, |state: &M::Reduced<f64>| state.as_ref()[k]);
    }
    let starts = starts_in_lanes(&equations, (t0, &in_lanes), t_end, plan.tolerance);
    let bodies = points.iter().zip(states).zip(constants).zip(starts);
    bodies
        .filter_map(|(((&(body, model, point), state), constants), start)| {
            Some(Begun { body, model, point, state, constants, start: start? })
        })
        .collect()
}

/// Lanes, each with a body or at rest.
pub(super) struct Bodies<'a, const N: usize, T: Lanes, M: InLanes<N>> {
    integration: RungeKutta8InLanes<T, M::Reduced<T>, Reduced<'a, N, M, T>>,
    t0: f64,
    bodies: Vec<Option<usize>>,
    /// Of the body that is, or was last, in each lane.
    of_lanes: Vec<(&'a M, M::Constants<f64>)>,
    /// Those of the equations are others.
    has_changed: bool,
    /// The ends of steps, where events are looked for.
    ends: Option<EndsInLanes<'a, N, M>>,
    /// How bodies moved where their last steps ended, of a model that may lose its orientation within them.
    moments: Vec<Option<Moment<N>>>,
}

impl<'a, const N: usize, T: Lanes, M: InLanes<N>> Bodies<'a, N, T, M> {
    /// The first bodies, one in every lane; lanes that are left rest where the last of them is.
    pub(super) fn filled(
        (plan, t_end): (&Plan, f64),
        (within_steps, has_events): (bool, bool),
        first: Begun<'a, N, M>,
        others: &mut impl Iterator<Item = Begun<'a, N, M>>,
    ) -> Self {
        let Plan { t0, tolerance, max_steps, .. } = *plan;
        let constants = M::constants_in_lanes(&[first.constants]);
        let equations = Reduced { first: first.model, models: vec![first.model; T::LANES], constants };
        let mut integration = RungeKutta8InLanes::new(equations, t_end, tolerance, max_steps);
        if within_steps || const { passes_through_zero(&M::DESCRIPTION) } {
            integration.keep();
        }
        let of_lanes = vec![(first.model, first.constants); T::LANES];
        let (bodies, has_changed) = (vec![None; T::LANES], false);
        let ends = has_events.then(|| EndsInLanes::new(T::LANES, (first.model, first.point)));
        let moments = vec![None; T::LANES];
        let mut lanes = Self { integration, t0, bodies, of_lanes, has_changed, ends, moments };
        lanes.put(0, &first);
        let mut last = first;
        for lane in 1..T::LANES {
            let next = others.next();
            let is_left = next.is_none();
            last = next.unwrap_or(last);
            lanes.put(lane, &last);
            if is_left {
                lanes.rest(lane);
            }
        }
        lanes
    }

    /// Puts a body into a lane.
    pub(super) fn put(&mut self, lane: usize, begun: &Begun<'a, N, M>) {
        self.integration.start(lane, (self.t0, &begun.state), &begun.start);
        self.of_lanes[lane] = (begun.model, begun.constants);
        self.has_changed = true;
        self.bodies[lane] = Some(begun.body);
        if let Some(ends) = &mut self.ends {
            ends.begin(lane, begun.model, (self.t0, begun.point));
        }
        if const { passes_through_zero(&M::DESCRIPTION) } {
            let (point, _) = self.expanded(lane, self.t0, &begun.state);
            self.moments[lane] = Some(Moment::of(&moving(begun.model), (self.t0, &point)));
        }
    }

    /// The body in a lane keeps its orientation throughout its last step, and goes on from the end of it.
    pub(super) fn keeps_orientation(&mut self, lane: usize) -> bool {
        if const { !passes_through_zero(&M::DESCRIPTION) } {
            return true;
        }
        let (t, (point, _)) = (self.t(lane), self.reached(lane));
        let model = moving(self.of_lanes[lane].0);
        let end = Moment::of(&model, (t, &point));
        let Some(begin) = self.moments[lane].replace(end) else { return false };
        let is_clear = begin.clearly_reaches(&end);
        is_clear
            || point.is_finite() && keeps_orientation(&model, &mut self.within(lane), (&begin, &end)).is_ok()
    }

    /// Leaves a lane without a body.
    pub(super) fn rest(&mut self, lane: usize) {
        self.integration.rest(lane);
        self.bodies[lane] = None;
    }

    /// There are bodies on their way.
    pub(super) fn are_moving(&self) -> bool {
        self.bodies.iter().any(Option::is_some)
    }

    /// The body in a lane.
    pub(super) fn body(&self, lane: usize) -> Option<usize> {
        self.bodies[lane]
    }

    /// Tries one step of every body; the lanes in which one has arrived, or cannot go on.
    pub(super) fn advance(&mut self) -> impl Iterator<Item = (usize, Fate)> + use<'a, N, T, M> {
        if core::mem::take(&mut self.has_changed) {
            let constants: Vec<_> = self.of_lanes.iter().map(|(_, constants)| *constants).collect();
            let equations = self.integration.equations();
            equations.constants = M::constants_in_lanes(&constants);
            equations
                .models
                .iter_mut()
                .zip(&self.of_lanes)
                .for_each(|(model, (of_lane, _))| *model = of_lane);
        }
        let fates = self.integration.advance();
        if let Some(mut ends) = self.ends.take() {
            ends.step(|lane| {
                let has_end = self.bodies[lane].is_some() && self.has_stepped(lane);
                has_end.then(|| (self.t(lane), self.reached(lane).0))
            });
            self.ends = Some(ends);
        }
        fates
    }

    /// What is found at the ends of the last step in a lane, given how the body turns at its begin, where events are looked for.
    pub(super) fn ends<R>(
        &self,
        lane: usize,
        look: impl FnOnce(&Ends<'_, M::Point<f64>>, &dyn Fn() -> f64) -> R,
    ) -> Option<R> {
        self.ends.as_ref().map(|ends| ends.of_lane(lane, look))
    }

    /// The last attempt of a lane was a step.
    pub(super) fn has_stepped(&self, lane: usize) -> bool {
        self.integration.has_stepped(lane)
    }

    /// Time reached in a lane.
    pub(super) fn t(&self, lane: usize) -> f64 {
        self.integration.t(lane)
    }

    /// The phase point reached in a lane, with the work done.
    pub(super) fn reached(&self, lane: usize) -> WithWork<M::Point<f64>> {
        let mut state = M::Reduced::<f64>::zeros();
        for (component, lanes) in state.as_mut().iter_mut().zip(self.integration.y().as_ref()) {
            *component = lanes.lane(lane);
        }
        self.expanded(lane, self.t(lane), &state)
    }

    /// The phase points at times within the last step in a lane.
    pub(super) fn within(
        &mut self,
        lane: usize,
    ) -> impl FnMut(f64) -> Result<WithWork<M::Point<f64>>, Reason> {
        move |t| {
            if t == self.t(lane) {
                return Ok(self.reached(lane));
            }
            let state = self.integration.within(lane, t);
            state.map(|state| self.expanded(lane, t, &state)).ok_or(Reason::NotFinite)
        }
    }

    fn expanded(&self, lane: usize, t: f64, state: &M::Reduced<f64>) -> WithWork<M::Point<f64>> {
        let (model, constants) = &self.of_lanes[lane];
        let work = const { Layout::of(M::DESCRIPTION.reduced, N) }.work;
        (model.expand(t, constants, state), work.map_or(0.0, |place| state.as_ref()[place]))
    }
}

/// A model as far as its phase points go.
pub(super) fn moving<'m, const N: usize, M: Model<N>>(model: &'m M) -> Moving<'m, N, Followed<'m, M>> {
    Moving { handle: Followed(model), begin: automatic }
}

/// The steps of a model are in vectors, so that those of the processor decide whether its lanes are fused as well; where the
/// target has decided that already, there is one kind of lanes.
#[inline(always)]
pub(super) fn has_fused_lanes<const N: usize, M: Model<N>>(model: &M) -> bool {
    !IS_FUSED && M::packing(model).is_some()
}

/// The reduced equations of the bodies in lanes.
struct Reduced<'a, const N: usize, M: InLanes<N>, T: Lanes> {
    first: &'a M,
    /// Of each lane, as far as there are bodies.
    models: Vec<&'a M>,
    constants: M::Constants<T>,
}

impl<const N: usize, M: InLanes<N>, T: Lanes> Equations<T, M::Reduced<T>> for Reduced<'_, N, M, T> {
    const GROUPS: &'static [Group] = M::DESCRIPTION.reduced;

    #[inline(always)]
    fn slope(&self, t: T, y: &M::Reduced<T>, slope: &mut M::Reduced<T>) {
        let model = |lane: usize| self.models.get(lane).copied().unwrap_or(self.first);
        M::equations_in_lanes(model, t, &self.constants, y, slope);
    }

    #[inline(always)]
    fn are_a_last_resort(&self) -> bool {
        !T::IS_FUSED && has_fused_lanes(self.first)
    }

    #[inline(always)]
    fn is_sound(&self, y: &M::Reduced<T>, lane: usize) -> bool {
        match const { placement_in(M::DESCRIPTION.reduced, N) } {
            Some(Range { start, end }) => {
                let entries = &y.as_ref()[start..end];
                is_clearly_positive(&Matrix::<N>::from_fn(|i, k| entries[N * i + k].lane(lane)))
            }
            // Bodies without one are not taken into lanes.
            None => false,
        }
    }
}
