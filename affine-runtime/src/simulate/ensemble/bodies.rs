//! Bodies of an ensemble on their way through lanes.

use core::marker::PhantomData;
use core::slice::Chunks;

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
fn begun<'a, const N: usize, T: Lanes, M: InLanes<N>>(
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

/// Bodies that wait for a lane, begun eight at once.
pub(super) struct Waiting<'a, 'p, const N: usize, T, M: InLanes<N>> {
    course: (&'p Plan, f64),
    others: Chunks<'p, (usize, &'a M, &'a M::Point<f64>)>,
    begun: Vec<Begun<'a, N, M>>,
    /// Of those that have begun, so many have a lane.
    taken: usize,
    lanes: PhantomData<T>,
}

impl<'a, 'p, const N: usize, T: Lanes, M: InLanes<N>> Waiting<'a, 'p, N, T, M> {
    /// Bodies from their points, each with its place among the starts and its model.
    pub(super) fn new(course: (&'p Plan, f64), points: &'p [(usize, &'a M, &'a M::Point<f64>)]) -> Self {
        Self { course, others: points.chunks(EIGHT), begun: Vec::new(), taken: 0, lanes: PhantomData }
    }

    /// The next body; lent, since bodies are long.
    pub(super) fn next(&mut self) -> Option<&Begun<'a, N, M>> {
        while self.taken == self.begun.len() {
            (self.begun, self.taken) = (begun::<N, T, M>(self.course, self.others.next()?), 0);
        }
        self.taken += 1;
        self.begun.get(self.taken - 1)
    }
}

/// Bodies in lanes, with the ends of their steps.
pub(super) struct Watched<'a, const N: usize, T: Lanes, M: InLanes<N>> {
    pub(super) bodies: Bodies<N, T, &'a M>,
    t0: f64,
    /// Where events are looked for.
    ends: Option<EndsInLanes<'a, N, M>>,
}

impl<'a, const N: usize, T: Lanes, M: InLanes<N>> Watched<'a, N, T, M> {
    /// The first bodies, one in every lane, and which they are; lanes that are left rest where the first of them is. None without
    /// bodies.
    pub(super) fn filled(
        (plan, t_end): (&Plan, f64),
        (within_steps, has_events): (bool, bool),
        waiting: &mut Waiting<'a, '_, N, T, M>,
    ) -> Option<(Self, [Option<usize>; EIGHT])> {
        let first = waiting.next()?;
        let together = Together::of(|_| (first.model, first.constants));
        let bodies = Bodies::new(together, (plan, t_end), within_steps);
        let ends = has_events.then(|| EndsInLanes::new(EIGHT, (first.model, first.point)));
        let mut watched = Self { bodies, t0: plan.t0, ends };
        (0..EIGHT).for_each(|lane| watched.put(lane, first));
        let mut numbers = [None; EIGHT];
        numbers[0] = Some(first.body);
        for (lane, number) in numbers.iter_mut().enumerate().skip(1) {
            match waiting.next() {
                Some(next) => {
                    watched.put(lane, next);
                    *number = Some(next.body);
                }
                None => watched.bodies.rest(lane),
            }
        }
        Some((watched, numbers))
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
