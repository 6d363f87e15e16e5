//! Bodies of an ensemble on their way through lanes.

use super::ends::EndsInLanes;
use crate::capability::InLanes;
use crate::inner::{Fate, Start, gathered, starts_in_lanes};
use crate::lanes::Lanes;
use crate::model::StateVector;
use crate::simulate::in_lanes::{Bodies, EIGHT, Together};
use crate::simulate::settings::Plan;
use crate::simulate::watcher::Ends;

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
    let Some(last) = points.len().checked_sub(1) else { return Vec::new() };
    let (states, constants): (Vec<_>, Vec<_>) =
        points.iter().map(|(_, model, point)| model.reduce(t0, point)).unzip();
    let body = |lane: usize| (points[lane.min(last)].1, constants[lane.min(last)]);
    let together = Together::<N, T, &M>::of(body);
    let mut in_lanes = M::Reduced::<T>::zeros();
    for (k, component) in in_lanes.as_mut().iter_mut().enumerate() {
        *component = gathered(&states, |state: &M::Reduced<f64>| state.as_ref()[k]);
    }
    let starts = starts_in_lanes(&together, (t0, &in_lanes), t_end, plan.tolerance);
    let bodies = points.iter().zip(states).zip(constants).zip(starts);
    bodies
        .filter_map(|(((&(body, model, point), state), constants), start)| {
            Some(Begun { body, model, point, state, constants, start: start? })
        })
        .collect()
}

/// Bodies in lanes, with the ends of their steps.
pub(super) struct Watched<'a, const N: usize, T: Lanes, M: InLanes<N>> {
    pub(super) bodies: Bodies<N, T, &'a M>,
    t0: f64,
    /// Where events are looked for.
    ends: Option<EndsInLanes<'a, N, M>>,
}

impl<'a, const N: usize, T: Lanes, M: InLanes<N>> Watched<'a, N, T, M> {
    /// The first bodies, one in every lane; lanes that are left rest where the last of them is. With the bodies that are there.
    pub(super) fn filled(
        (plan, t_end): (&Plan, f64),
        (within_steps, has_events): (bool, bool),
        first: Begun<'a, N, M>,
        others: &mut impl Iterator<Item = Begun<'a, N, M>>,
    ) -> (Self, [Option<usize>; EIGHT]) {
        let together = Together::of(|_| (first.model, first.constants));
        let bodies = Bodies::new(together, (plan, t_end), within_steps);
        let ends = has_events.then(|| EndsInLanes::new(EIGHT, (first.model, first.point)));
        let mut watched = Self { bodies, t0: plan.t0, ends };
        watched.put(0, &first);
        let (mut numbers, mut last) = ([None; EIGHT], first);
        numbers[0] = Some(last.body);
        for (lane, number) in numbers.iter_mut().enumerate().skip(1) {
            let next = others.next();
            *number = next.as_ref().map(|next| next.body);
            last = next.unwrap_or(last);
            watched.put(lane, &last);
            if number.is_none() {
                watched.bodies.rest(lane);
            }
        }
        (watched, numbers)
    }

    /// Puts a body into a lane.
    pub(super) fn put(&mut self, lane: usize, begun: &Begun<'a, N, M>) {
        self.bodies.set_model(lane, begun.model, begun.constants);
        self.bodies.start(lane, (self.t0, &begun.state), &begun.start);
        if let Some(ends) = &mut self.ends {
            ends.begin(lane, begun.model, (self.t0, begun.point));
        }
    }

    /// Tries one step of every body; the lanes in which the way of one ends.
    pub(super) fn advance(&mut self) -> impl Iterator<Item = (usize, Fate)> + use<'a, N, T, M> {
        let Self { bodies, ends, .. } = self;
        let fates = bodies.advance();
        if let Some(ends) = ends {
            ends.step(|lane| bodies.has_stepped(lane).then(|| (bodies.t(lane), bodies.reached(lane).0)));
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
}
