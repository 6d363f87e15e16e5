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

/// A body before its first step, lent by those that wait: what is known of it is long.
pub(super) struct Begun<'w, 'a, const N: usize, M: InLanes<N>> {
    pub(super) body: usize,
    model: &'a M,
    point: &'a M::Point<f64>,
    state: &'w M::Reduced<f64>,
    constants: &'w M::Constants<f64>,
    start: &'w Start<M::Reduced<f64>>,
}

/// Bodies that wait for a lane, begun eight at once.
pub(super) struct Waiting<'a, 'p, const N: usize, T, M: InLanes<N>> {
    course: (&'p Plan, f64),
    others: Chunks<'p, (usize, &'a M, &'a M::Point<f64>)>,
    /// Those that have begun, with their states, constants and starts; of one that cannot begin in lanes there is none.
    begun: &'p [(usize, &'a M, &'a M::Point<f64>)],
    states: Vec<M::Reduced<f64>>,
    constants: Vec<M::Constants<f64>>,
    starts: Vec<Option<Start<M::Reduced<f64>>>>,
    /// So many of them have a lane, or none at all.
    taken: usize,
    lanes: PhantomData<T>,
}

impl<'a, 'p, const N: usize, T: Lanes, M: InLanes<N>> Waiting<'a, 'p, N, T, M> {
    /// Bodies from their points, each with its place among the starts and its model.
    pub(super) fn new(course: (&'p Plan, f64), points: &'p [(usize, &'a M, &'a M::Point<f64>)]) -> Self {
        Self {
            course,
            others: points.chunks(EIGHT),
            begun: &[],
            states: Vec::new(),
            constants: Vec::new(),
            starts: Vec::new(),
            taken: 0,
            lanes: PhantomData,
        }
    }

    /// The next body that begins in lanes.
    pub(super) fn next(&mut self) -> Option<Begun<'_, 'a, N, M>> {
        let place = loop {
            match self.starts.get(self.taken) {
                Some(start) => {
                    self.taken += 1;
                    if start.is_some() {
                        break self.taken - 1;
                    }
                }
                None => {
                    let next = self.others.next()?;
                    self.begin(next);
                }
            }
        };
        let (body, model, point) = self.begun[place];
        let (state, constants) = (&self.states[place], &self.constants[place]);
        self.starts[place].as_ref().map(|start| Begun { body, model, point, state, constants, start })
    }

    /// As many bodies as there are lanes, or fewer, at their start.
    fn begin(&mut self, points: &'p [(usize, &'a M, &'a M::Point<f64>)]) {
        let (plan, t_end) = self.course;
        let t0 = plan.t0;
        (self.begun, self.taken) = (points, 0);
        self.states.clear();
        self.constants.clear();
        for (_, model, point) in points {
            let (state, constants) = model.reduce(t0, point);
            self.states.push(state);
            self.constants.push(constants);
        }
        let last = points.len() - 1;
        let body = |lane: usize| (points[lane.min(last)].1, self.constants[lane.min(last)]);
        let together = Together::<N, T, &M>::of(body);
        let mut in_lanes = M::Reduced::<T>::zeros();
        for (k, component) in in_lanes.as_mut().iter_mut().enumerate() {
            *component = gathered(&self.states, |state: &M::Reduced<f64>| state.as_ref()[k]);
        }
        self.starts.clear();
        let starts = starts_in_lanes(&together, (t0, &in_lanes), t_end, plan.tolerance);
        self.starts.extend(starts.take(points.len()));
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
        let together = Together::of(|_| (first.model, *first.constants));
        let bodies = Bodies::new(together, (plan, t_end), within_steps);
        let ends = has_events.then(|| EndsInLanes::new(EIGHT, (first.model, first.point)));
        let mut watched = Self { bodies, t0: plan.t0, ends };
        (0..EIGHT).for_each(|lane| watched.put(lane, &first));
        let mut numbers = [None; EIGHT];
        numbers[0] = Some(first.body);
        for (lane, number) in numbers.iter_mut().enumerate().skip(1) {
            match waiting.next() {
                Some(next) => {
                    watched.put(lane, &next);
                    *number = Some(next.body);
                }
                None => watched.bodies.rest(lane),
            }
        }
        Some((watched, numbers))
    }

    /// Puts a body into a lane.
    pub(super) fn put(&mut self, lane: usize, begun: &Begun<'_, 'a, N, M>) {
        self.bodies.set_model(lane, begun.model, *begun.constants);
        self.bodies.start(lane, (self.t0, begun.state), begun.start);
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
