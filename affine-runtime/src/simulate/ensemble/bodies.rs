//! Bodies of an ensemble on their way through lanes.

use core::ops::Range;

use crate::capability::InLanes;
use crate::frames::Matrix;
use crate::inner::{Equations, Fate, RungeKutta8InLanes, gathered};
use crate::inner::{Start, starts_in_lanes};
use crate::lanes::Lanes;
use crate::model::{Group, StateVector};
use crate::simulate::layout::{Layout, placement_in};
use crate::simulate::motion::WithWork;
use crate::simulate::point::is_clearly_positive;

/// What all bodies of an ensemble have in common.
pub(super) struct Common<'a, M> {
    pub(super) model: &'a M,
    pub(super) t0: f64,
    pub(super) t_end: f64,
    pub(super) tolerance: f64,
    pub(super) max_steps: u64,
}

impl<M> Clone for Common<'_, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M> Copy for Common<'_, M> {}

/// A body before its first step.
pub(super) struct Begun<const N: usize, M: InLanes<N>> {
    body: usize,
    state: M::Reduced<f64>,
    constants: M::Constants<f64>,
    start: Start<M::Reduced<f64>>,
}

/// As many bodies as there are lanes, or fewer, at their start; those are left out for which there is nothing to begin with.
pub(super) fn begun<const N: usize, T: Lanes, M: InLanes<N>>(
    common: Common<'_, M>,
    points: &[(usize, &M::Point<f64>)],
) -> Vec<Begun<N, M>> {
    let Common { model, t0, t_end, tolerance, .. } = common;
    let (states, constants): (Vec<_>, Vec<_>) =
        points.iter().map(|(_, point)| model.reduce(t0, point)).unzip();
    let equations = Reduced { model, constants: M::constants_in_lanes::<T>(&constants) };
    let mut in_lanes = M::Reduced::<T>::zeros();
    for (k, component) in in_lanes.as_mut().iter_mut().enumerate() {
        *component = gathered(&states, |state: &M::Reduced<f64>| state.as_ref()[k]);
    }
    let starts = starts_in_lanes(&equations, (t0, &in_lanes), t_end, tolerance);
    let bodies = points.iter().zip(states).zip(constants).zip(starts);
    bodies
        .filter_map(|((((body, _), state), constants), start)| {
            Some(Begun { body: *body, state, constants, start: start? })
        })
        .collect()
}

/// A body that is done with its lane.
pub(super) struct Done<P> {
    pub(super) lane: usize,
    pub(super) body: usize,
    /// Where it has come to, with the work done; `None` where it cannot go on.
    pub(super) end: Option<WithWork<P>>,
}

/// Lanes, each with a body or at rest.
pub(super) struct Bodies<'a, const N: usize, T: Lanes, M: InLanes<N>> {
    integration: RungeKutta8InLanes<T, M::Reduced<T>, Reduced<'a, N, M, T>>,
    model: &'a M,
    t0: f64,
    t_end: f64,
    bodies: Vec<Option<usize>>,
    /// Of the body that is, or was last, in each lane.
    constants: Vec<M::Constants<f64>>,
    /// Those of the equations are others.
    has_changed: bool,
}

impl<'a, const N: usize, T: Lanes, M: InLanes<N>> Bodies<'a, N, T, M> {
    /// The first bodies, one in every lane; lanes that are left rest where the last of them is.
    pub(super) fn filled(
        common: Common<'a, M>,
        first: Begun<N, M>,
        others: &mut impl Iterator<Item = Begun<N, M>>,
    ) -> Self {
        let Common { model, t0, t_end, tolerance, max_steps } = common;
        let constants = vec![first.constants; T::LANES];
        let equations = Reduced { model, constants: M::constants_in_lanes(&constants) };
        let integration = RungeKutta8InLanes::new(equations, t_end, tolerance, max_steps);
        let bodies = vec![None; T::LANES];
        let mut lanes = Self { integration, model, t0, t_end, bodies, constants, has_changed: false };
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
    pub(super) fn put(&mut self, lane: usize, begun: &Begun<N, M>) {
        self.integration.start(lane, (self.t0, &begun.state), &begun.start);
        self.constants[lane] = begun.constants;
        self.has_changed = true;
        self.bodies[lane] = Some(begun.body);
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

    /// Tries one step of every body; the lanes that this leaves without.
    pub(super) fn advance(&mut self) -> Vec<Done<M::Point<f64>>> {
        if core::mem::take(&mut self.has_changed) {
            self.integration.equations().constants = M::constants_in_lanes(&self.constants);
        }
        let mut done = Vec::new();
        for (lane, fate) in self.integration.advance() {
            if let Some(body) = self.bodies[lane] {
                done.push(Done { lane, body, end: (fate == Fate::Arrived).then(|| self.end(lane)) });
            }
        }
        done
    }

    /// The phase point at the end of the interval, with the work done.
    fn end(&self, lane: usize) -> WithWork<M::Point<f64>> {
        let mut state = M::Reduced::<f64>::zeros();
        for (component, lanes) in state.as_mut().iter_mut().zip(self.integration.y().as_ref()) {
            *component = lanes.lane(lane);
        }
        let work = const { Layout::of(M::DESCRIPTION.reduced, N) }.work;
        let work = work.map_or(0.0, |place| state.as_ref()[place]);
        (self.model.expand(self.t_end, &self.constants[lane], &state), work)
    }
}

/// The reduced equations of the bodies in lanes.
struct Reduced<'a, const N: usize, M: InLanes<N>, T: Lanes> {
    model: &'a M,
    constants: M::Constants<T>,
}

impl<const N: usize, M: InLanes<N>, T: Lanes> Equations<T, M::Reduced<T>> for Reduced<'_, N, M, T> {
    const GROUPS: &'static [Group] = M::DESCRIPTION.reduced;

    #[inline(always)]
    fn slope(&self, t: T, y: &M::Reduced<T>, slope: &mut M::Reduced<T>) {
        self.model.equations_in_lanes(t, &self.constants, y, slope);
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
