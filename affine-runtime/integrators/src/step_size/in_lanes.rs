//! Times and step sizes of several bodies, each with its own: lane by lane the numbers of [`Controller`], operation by
//! operation.

use super::{Controller, next_time, shortest};
use crate::lanes::Lanes;

/// Where the lanes are in time, and how they go on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Clocks<T> {
    /// Time reached.
    pub(crate) t: T,
    /// End of the step that is tried.
    pub(crate) end: T,
    /// Length of the next step; 0 in a lane in which nothing moves.
    length: T,
    /// Accepted steps on the way to the end.
    steps: T,
    previous: T,
    /// 1 after a rejected step, or 0.
    rejected: T,
    /// The longest of the steps before, each shortened for every step since.
    pub(crate) lasting: T,
    /// Before the first step.
    fresh: Controller,
    t_end: f64,
    max_steps: f64,
}

/// What becomes of a lane by a step, as the number in its lane.
pub(crate) mod fate {
    /// The lane goes on with another step.
    pub(crate) const UNDER_WAY: f64 = 0.0;
    /// It has come to the end.
    pub(crate) const ARRIVED: f64 = 1.0;
    /// It cannot go on.
    pub(crate) const STUCK: f64 = 2.0;
    /// It has taken as many steps as it may.
    pub(crate) const LIMITED: f64 = 3.0;
}

impl<T: Lanes> Clocks<T> {
    /// Lanes at rest at the end.
    pub(crate) fn new(fresh: Controller, t_end: f64, max_steps: u64) -> Self {
        let (zero, t) = (T::zero(), T::constant(t_end, 0.0));
        let max_steps = max_steps as f64;
        let (length, steps, previous, rejected, lasting) = (zero, zero, zero, zero, zero);
        Self { t, end: t, length, steps, previous, rejected, lasting, fresh, t_end, max_steps }
    }

    /// Goes on to another end, with the lengths that steps have; what rests stays at rest.
    pub(crate) fn aim(&mut self, t_end: f64, max_steps: u64) {
        (self.t_end, self.max_steps) = (t_end, max_steps as f64);
        for lane in 0..T::LANES {
            let (t, length) = (self.t.lane(lane), self.length.lane(lane));
            self.t.set_lane(lane, if length == 0.0 { t_end } else { t });
            self.end.set_lane(lane, if length == 0.0 { t_end } else { next_time(t, length, t_end) });
            self.steps.set_lane(lane, 0.0);
        }
    }

    /// Sets a lane to the start of a body.
    pub(crate) fn start(&mut self, lane: usize, t: f64, length: f64) {
        self.t.set_lane(lane, t);
        self.end.set_lane(lane, next_time(t, length, self.t_end));
        self.length.set_lane(lane, length);
        self.previous.set_lane(lane, self.fresh.previous);
        self.rejected.set_lane(lane, 0.0);
        self.lasting.set_lane(lane, 0.0);
        self.steps.set_lane(lane, 0.0);
    }

    /// Nothing moves in a lane from now on.
    pub(crate) fn rest(&mut self, lane: usize) {
        self.start(lane, self.t_end, 0.0);
    }

    /// Turns to the next steps: where errors are at most 1 from the ends of those that were tried, elsewhere, also where an
    /// error is NaN, from where these began. What becomes of the lanes; those that `unsound` is not 0 for cannot go on from
    /// the end of an accepted step. A lane at the end stays as it is.
    #[inline(always)]
    pub(crate) fn turn(&mut self, error: T, unsound: T) -> T {
        let Self { fresh, t_end, max_steps, .. } = *self;
        let mut next = *self;
        let mut fates = T::zero();
        for lane in 0..T::LANES {
            let (t, end, error) = (self.t.lane(lane), self.end.lane(lane), error.lane(lane));
            let (previous, rejected) = (self.previous.lane(lane), self.rejected.lane(lane));
            let accepted = error <= 1.0;
            let lasting = self.lasting.lane(lane);
            let mut controller = Controller { previous, rejected: rejected != 0.0, lasting, ..fresh };
            let tried = (end - t).abs();
            let length = tried * controller.factor(accepted, error);
            controller.took(tried);
            let steps = self.steps.lane(lane) + if accepted { 1.0 } else { 0.0 };
            let has_arrived = if end == t_end { fate::ARRIVED } else { fate::UNDER_WAY };
            let goes_on = if steps >= max_steps && end != t_end { fate::LIMITED } else { has_arrived };
            let after = if unsound.lane(lane) == 0.0 { goes_on } else { fate::STUCK };
            let again = if length <= shortest(t, t_end) { fate::STUCK } else { fate::UNDER_WAY };
            let fate = if accepted { after } else { again };
            // What is lost in the rounding of times is no step.
            let fate = if end == t { fate::STUCK } else { fate };
            let is_at_end = t == t_end;
            fates.set_lane(lane, if is_at_end { fate::UNDER_WAY } else { fate });
            let t = if accepted { end } else { t };
            next.t.set_lane(lane, t);
            next.end.set_lane(lane, next_time(t, length, t_end));
            let kept = |before: f64, after: f64| if is_at_end { before } else { after };
            next.length.set_lane(lane, kept(self.length.lane(lane), length));
            next.previous.set_lane(lane, kept(previous, controller.previous));
            next.rejected.set_lane(lane, kept(rejected, if accepted { 0.0 } else { 1.0 }));
            next.lasting.set_lane(lane, kept(lasting, if accepted { controller.lasting } else { lasting }));
            next.steps.set_lane(lane, steps);
        }
        *self = next;
        fates
    }
}
