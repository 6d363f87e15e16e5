//! Changes of sign between samples.

mod passes;
mod told;

use super::accumulation::Changes;
use super::cubic::Knot;
use super::departure::departure;
use super::event::{Action, Direction, Event};
use super::motion::WithWork;
use super::point::check;
use super::root::root;
use super::standing::{Left, Memory, Side, Standing};
use crate::error::Reason;
use crate::inner::larger;
use crate::metrics::Bases;
use crate::state::Phase;
pub(super) use passes::Ends;
use told::Along;
pub(super) use told::Step;

/// What the body may turn, in radians, or its log-stretches change by between two samples.
const TURN: f64 = 0.5;
/// Part of the values on both sides of a change of sign that is zero where the sign has changed: a function that jumps is not
/// there.
const AT_ZERO: f64 = 1e-3;
/// Part of these values that rounding may make of zero.
const ROUNDED: f64 = 1e-12;
/// Roundings of a function that a change of its sign may be from zero.
const ROUNDINGS: f64 = 16.0;
/// Part of the rate at which a function came to zero that is no rate at which it goes on.
const AT_REST: f64 = 1e-6;
/// Part of the rate at one sample that is expected at the next: an oscillation is slow where it turns, and fast again after that.
const EXPECTED: f64 = 0.75;
/// Equal parts of a step at whose ends functions are looked at, where its length follows the error.
pub(super) const WITHIN_A_STEP: u32 = told::PARTS as u32;

/// The phase point at a time, and the work.
pub(super) type At<'m, P> = dyn FnMut(f64) -> Result<WithWork<P>, Reason> + 'm;

/// A change of sign that counts.
#[derive(Clone, Copy)]
pub(super) struct Met<P> {
    pub(super) t: f64,
    /// Index of the event.
    pub(super) event: usize,
    /// The side to which the function goes.
    pub(super) to: Side,
    /// The size of its rate, about.
    pub(super) rate: f64,
    /// A time on the way to zero and the point, where a change asks for it; none where the function has been there all along.
    before: Option<(f64, P)>,
    pub(super) point: P,
    pub(super) work: f64,
}

/// Where and on which side the way of a function through a part begins.
struct Way {
    /// Time and value.
    begin: (f64, f64),
    from: Side,
}

/// Where samples are taken.
#[derive(Clone, Copy)]
pub(super) struct Sampling {
    /// At the ends of at least so many equal parts.
    pub(super) parts: u32,
    /// The ends of a stretch may tell that nothing happens in between, where steps follow the error.
    pub(super) by_ends: bool,
    /// What angles and log-stretches change by in a unit of time, at least; the velocity is looked at besides.
    pub(super) rate: f64,
}

/// The values of all events at a time.
struct Sample {
    t: f64,
    values: Vec<f64>,
    /// What angles and log-stretches change by in a unit of time.
    rate: f64,
}

/// The events of a run between two samples.
pub(super) struct Watcher<'a, const N: usize, P> {
    pub(super) events: Vec<Event<'a, N, P>>,
    /// Those of the model's metrics.
    bases: Option<Bases<N>>,
    /// What is known of them at the sample where the part begins, and of those that have happened within it.
    memory: Vec<Memory>,
    begin: Sample,
    end: Sample,
    /// The motion at both ends of a step, where there are events.
    knots: Option<[Box<Knot>; 2]>,
    /// The values of each function along it.
    ways: Vec<Along>,
    /// They are all there is to know.
    are_told: bool,
    /// The rate where the part begins is not known yet.
    has_passed: bool,
    /// Events that are still at zero at the end of the part.
    stays: Vec<bool>,
    /// An event whose change has left its function at rest at zero: [`Reason::Accumulation`].
    rests: Option<Reason>,
}

impl<'a, const N: usize, P: Phase<N>> Watcher<'a, N, P> {
    pub(super) fn new(events: Vec<Event<'a, N, P>>, bases: Option<Bases<N>>) -> Self {
        let nowhere = || Sample { t: f64::NAN, values: vec![f64::NAN; events.len()], rate: 0.0 };
        let (begin, end, stays) = (nowhere(), nowhere(), vec![false; events.len()]);
        let ways = vec![Along::NONE; events.len()];
        let (memory, knots, rests, are_told, has_passed) = (Vec::new(), None, None, false, false);
        Self { memory, begin, end, knots, ways, are_told, has_passed, stays, rests, events, bases }
    }

    pub(super) fn is_idle(&self) -> bool {
        self.events.is_empty()
    }

    /// The time up to which all that happens is known.
    pub(super) fn t(&self) -> f64 {
        self.begin.t
    }

    /// What a run that goes on from there has to know.
    pub(super) fn memory(&self) -> &[Memory] {
        &self.memory
    }

    /// Begins at a point, at the start of a run without a memory.
    pub(super) fn begin(&mut self, t: f64, point: &P, rate: f64, memory: &[Memory]) {
        let bases = self.bases.as_ref();
        let values: Vec<f64> = self.events.iter().map(|event| event.at(t, point, bases)).collect();
        self.memory = match memory {
            [] => self.events.iter().zip(&values).map(|(event, value)| event.first(*value)).collect(),
            _ => memory.to_vec(),
        };
        self.begin = Sample { t, values, rate };
        (self.has_passed, self.are_told) = (false, false);
    }

    /// The number of parts of at most the length that samples allow, on the way to a time.
    pub(super) fn parts_to(&self, end: f64) -> f64 {
        ((end - self.begin.t).abs() * self.begin.rate / TURN).ceil()
    }

    /// The time of the next sample on the way to the end of a stretch from `start`.
    pub(super) fn next(&self, start: f64, end: f64, sampling: Sampling) -> f64 {
        let left = end - self.begin.t;
        let parts = (f64::from(sampling.parts) * left / (end - start)).round();
        let parts = larger(parts, self.parts_to(end));
        let t = self.begin.t + left / parts;
        // Also where times are as close as their rounding.
        if parts <= 1.0 || t == self.begin.t { end } else { t }
    }

    /// All that happens on the way to a sample, whose point may be known, in the order of the run.
    ///
    /// # Errors
    /// Those of `at`; [`Reason::Event`] for a function that is no number.
    pub(super) fn look(
        &mut self,
        (t, known): (f64, Option<P>),
        rate: impl Fn(&P) -> f64,
        at: &mut At<'_, P>,
    ) -> Result<Vec<Met<P>>, Reason> {
        let bases = self.bases;
        let bases = bases.as_ref();
        let point = known.map_or_else(|| at(t).map(|(point, _)| point), Ok)?;
        (self.end.t, self.end.rate) = (t, larger(rate(&point), EXPECTED * self.begin.rate));
        if self.are_where_they_were(&point) {
            return Ok(Vec::new());
        }
        let mut met = Vec::new();
        for index in 0..self.events.len() {
            let value = self.events[index].value(t, &point, bases)?;
            self.end.values[index] = value;
            let Some(Way { begin, from }) = self.way(index, at, &mut met)? else { continue };
            let event = &self.events[index];
            // Zero has been reached, a number that is none has not.
            if value.is_nan() || Side::of(value) == Some(from) || !event.counts(from.opposite()) {
                continue;
            }
            let function = |t: f64| at(t).and_then(|(point, _)| event.value(t, &point, bases));
            let first = if self.are_told { self.ways[index].zero() } else { 0.5 };
            let time = root(function, begin, (t, value), first)?;
            let (point, work) = at(time)?;
            let (mut rate, mut before) = (0.0, None);
            if matches!(event.action, Action::Change(_)) {
                let middle = begin.0 + 0.5 * (time - begin.0);
                let (point, _) = at(middle)?;
                rate = (event.value(middle, &point, bases)? / (time - middle)).abs();
                before = Some((middle, point));
            }
            let to = from.opposite();
            self.insert(&mut met, Met { t: time, event: index, to, rate, before, point, work });
        }
        if self.rests.is_some() {
            met.retain(|met| met.t == self.begin.t);
        }
        Ok(met)
    }

    /// Every function has a side of zero and is still there at the end of the part, as at most samples.
    fn are_where_they_were(&mut self, point: &P) -> bool {
        let (t, bases) = (self.end.t, self.bases.as_ref());
        let events = self.events.iter().zip(&self.memory).zip(&mut self.end.values);
        events.into_iter().all(|((event, memory), value)| {
            *value = event.at(t, point, bases);
            match memory.standing {
                Standing::On(Side::Negative) => *value < 0.0,
                Standing::On(Side::Positive) => *value > 0.0,
                Standing::Open | Standing::Leaving { .. } => false,
            }
        })
    }

    /// Where the run ends after all that happens on the way to the sample: an event that would happen again at once.
    pub(super) fn rest(&mut self) -> Result<(), Reason> {
        self.rests.take().map_or(Ok(()), Err)
    }

    /// The way of an event through the part; `None` where no change of sign can follow. One that begins at zero may happen
    /// there.
    fn way(
        &mut self,
        index: usize,
        at: &mut At<'_, P>,
        met: &mut Vec<Met<P>>,
    ) -> Result<Option<Way>, Reason> {
        let bases = self.bases.as_ref();
        let (event, memory) = (&self.events[index], &mut self.memory[index]);
        let begin = (self.begin.t, self.begin.values[index]);
        let (from, changed) = match memory.standing {
            Standing::On(from) => return Ok(Some(Way { begin, from })),
            Standing::Open => return Ok(None),
            Standing::Leaving { from, left } => (from, left),
        };
        // What stays at zero for a while has gone on by then: its rate is that since its change.
        let origin = changed.map_or(begin, Left::place);
        let mut function = |t: f64| at(t).and_then(|(point, _)| event.value(t, &point, bases));
        // One that rests is not looked at as closely as one that may move.
        let middle = begin.0 + 0.5 * (self.end.t - begin.0);
        let is_still = self.end.values[index] == origin.1 && function(middle)? == origin.1;
        let left = if is_still { None } else { departure(function, origin, (begin.0, self.end.t))? };
        self.stays[index] = left.is_none();
        let Some(left) = left else { return Ok(None) };
        let is_beyond = left.side != from;
        if let Some(came) = changed
            && is_beyond
            && left.rate.is_none_or(|rate| rate < AT_REST * came.rate())
        {
            let (event, count) = (event.name, memory.changes.count);
            self.rests = Some(Reason::Accumulation { event, t: begin.0, count });
            return Ok(None);
        }
        if is_beyond && changed.is_none() && event.counts(left.side) {
            let (t, to, rate) = (begin.0, left.side, left.rate.unwrap_or(0.0));
            let (point, work) = at(t)?;
            self.insert(met, Met { t, event: index, to, rate, before: None, point, work });
        } else {
            memory.standing = Standing::On(left.side);
        }
        Ok(Some(Way { begin: (left.t, left.value), from: left.side }))
    }

    /// Puts one of few events in its place, after those of the same time.
    fn insert(&self, met: &mut Vec<Met<P>>, one: Met<P>) {
        let sign = if self.end.t < self.begin.t { -1.0 } else { 1.0 };
        let place = met.partition_point(|other| sign * other.t <= sign * one.t);
        met.insert(place, one);
    }

    /// An event has happened.
    pub(super) fn happened(&mut self, met: &Met<P>) {
        self.memory[met.event].standing = Standing::On(met.to);
    }

    /// The next part begins where this one ends.
    pub(super) fn pass(&mut self) {
        let all = self.memory.iter_mut().zip(&mut self.stays).zip(&self.end.values);
        for ((memory, stays), value) in all {
            if !core::mem::take(stays) {
                memory.standing = Standing::of(*value);
            }
        }
        core::mem::swap(&mut self.begin, &mut self.end);
    }

    /// An event has changed the point: what is known of all of them where the next integration begins is noted, and the time
    /// returned at which its changes accumulate, if they do, with their number.
    ///
    /// A function that has come to zero at that time, or is zero now, is decided by where it goes from there; a jump is no
    /// change of its sign.
    pub(super) fn change(&mut self, met: &Met<P>, changed: &P) -> Option<(f64, u64)> {
        let bases = self.bases.as_ref();
        let mut accumulation = None;
        self.rests = None;
        for (index, event) in self.events.iter().enumerate() {
            let [before, after] = [&met.point, changed].map(|point| event.at(met.t, point, bases));
            let (own, size) =
                (index == met.event, larger(self.begin.values[index].abs(), self.end.values[index].abs()));
            // The last flights before a rest are some roundings high, and some roundings of time long.
            let came = if own { f64::EPSILON * met.rate * met.t.abs() } else { 0.0 };
            let rounding = larger(event.rounding(met.before.unwrap_or((met.t, met.point)), bases), came);
            let near = larger(AT_ZERO * size, ROUNDINGS * rounding);
            let was_at_zero = before.abs() <= near || own && met.before.is_none();
            let Memory { standing, changes } = &mut self.memory[index];
            let (mut side, mut left) = (standing.side(), None);
            if own {
                (side, left) = (Some(met.to.opposite()), Some(Left::at((met.t, after), met.rate)));
                accumulation = changes.happen(met.t, was_at_zero).map(|t| (t, changes.count));
            }
            // It has come to zero at this very time, and the change has left it there.
            let has_come = was_at_zero && side.is_some_and(|side| Side::of(before) != Some(side));
            let is_left = after.abs() <= larger(2.0 * before.abs(), ROUNDED * size);
            let from = if was_at_zero { side } else { event.start().or(side) };
            *standing = match from {
                Some(from) if has_come && is_left || after == 0.0 => Standing::Leaving { from, left },
                _ => Standing::of(after),
            };
        }
        accumulation
    }
}

impl<const N: usize, P: Phase<N>> Event<'_, N, P> {
    /// Its function.
    fn at(&self, t: f64, point: &P, bases: Option<&Bases<N>>) -> f64 {
        (self.function)(t, point, bases)
    }

    /// What that is at a point, unless the point is none: the run finds out for itself.
    fn value(&self, t: f64, point: &P, bases: Option<&Bases<N>>) -> Result<f64, Reason> {
        let value = self.at(t, point, bases);
        if value.is_nan() && check(t, point).is_ok() {
            return Err(Reason::Event { event: self.name, t });
        }
        Ok(value)
    }

    /// What rounding of the time and of the numbers of a point makes of its function, about.
    fn rounding(&self, (t, point): (f64, P), bases: Option<&Bases<N>>) -> f64 {
        let mut numbers = Vec::new();
        point.entries(&mut |number| numbers.push(number));
        // Each of them by another one, so that differences of equal numbers show it.
        let mut rounded = (1_u32..).zip(numbers);
        let beside = point.with_entries(&mut || {
            rounded.next().map_or(f64::NAN, |(k, number)| number * (1.0 + f64::from(k) * f64::EPSILON))
        });
        (self.at(t * (1.0 + f64::EPSILON), &beside, bases) - self.at(t, &point, bases)).abs()
    }

    fn counts(&self, to: Side) -> bool {
        match self.direction {
            Direction::Rising => to == Side::Positive,
            Direction::Falling => to == Side::Negative,
            Direction::Any => true,
        }
    }

    /// The side to which zero counts where nothing is known of before.
    fn start(&self) -> Option<Side> {
        match self.direction {
            Direction::Rising => Some(Side::Negative),
            Direction::Falling => Some(Side::Positive),
            Direction::Any => None,
        }
    }

    /// What is known at the start of a run.
    fn first(&self, value: f64) -> Memory {
        let leaving = self.start().filter(|_| value == 0.0);
        let standing = leaving.map_or(Standing::of(value), |from| Standing::Leaving { from, left: None });
        Memory { standing, changes: Changes::default() }
    }
}
