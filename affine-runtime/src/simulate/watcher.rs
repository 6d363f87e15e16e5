//! Changes of sign within a step.

use super::event::{Direction, Event};
use super::halt::Reason;
use super::motion::WithWork;
use super::point::check;
use super::root::root;
use crate::state::Phase;

/// A change of sign that counts.
pub(super) struct Met<P> {
    pub(super) t: f64,
    /// Index of the event.
    pub(super) event: usize,
    pub(super) rising: bool,
    pub(super) point: P,
    pub(super) work: f64,
}

/// The events of a run, with their values where the next step begins.
pub(super) struct Watcher<'a, const N: usize, P> {
    pub(super) events: Vec<Event<'a, N, P>>,
    t: f64,
    values: Vec<f64>,
}

impl<'a, const N: usize, P: Phase<N>> Watcher<'a, N, P> {
    pub(super) fn new(events: Vec<Event<'a, N, P>>) -> Self {
        Self { values: vec![f64::NAN; events.len()], t: f64::NAN, events }
    }

    pub(super) fn is_idle(&self) -> bool {
        self.events.is_empty()
    }

    /// Begins at a point; the event that led there is looked at from the next sample on, since rounding decides on which
    /// side of it the point is.
    pub(super) fn begin(&mut self, t: f64, point: &P, changed_by: Option<usize>) {
        self.t = t;
        self.values = self.events.iter().map(|event| (event.function)(t, point)).collect();
        if let Some(value) = changed_by.and_then(|event| self.values.get_mut(event)) {
            *value = 0.0;
        }
    }

    /// All that happens on the way to `t_end`, in the order of the run, from samples at the ends of equal parts of it.
    ///
    /// # Errors
    /// Those of `at`, which gives the phase point at a time on the way, and the work.
    pub(super) fn advance(
        &mut self,
        t_end: f64,
        parts: u32,
        at: &mut dyn FnMut(f64) -> Result<WithWork<P>, Reason>,
    ) -> Result<Vec<Met<P>>, Reason> {
        let mut met = Vec::new();
        let begin = self.t;
        if t_end == begin {
            return Ok(met);
        }
        let sign = if t_end < begin { -1.0 } else { 1.0 };
        for part in 1..=parts {
            let t = match part == parts {
                true => t_end,
                false => begin + (t_end - begin) * (f64::from(part) / f64::from(parts)),
            };
            let (point, _) = at(t)?;
            let first = met.len();
            for (index, event) in self.events.iter().enumerate() {
                let (before, value) = (self.values[index], event.value(t, &point)?);
                self.values[index] = value;
                let Some(rising) = crossing(before, value).filter(|rising| event.counts(*rising)) else {
                    continue;
                };
                let function = |t: f64| at(t).and_then(|(point, _)| event.value(t, &point));
                let time = root(function, (self.t, before), (t, value))?;
                let (point, work) = at(time)?;
                // One of few: put in its place, after those of the same time.
                let is_before = |other: &Met<P>| sign * other.t <= sign * time;
                let place = first + met[first..].partition_point(is_before);
                met.insert(place, Met { t: time, event: index, rising, point, work });
            }
            self.t = t;
        }
        Ok(met)
    }
}

impl<const N: usize, P: Phase<N>> Event<'_, N, P> {
    /// What it is at a point, unless that is none: the run finds out for itself.
    fn value(&self, t: f64, point: &P) -> Result<f64, Reason> {
        let value = (self.function)(t, point);
        if value.is_nan() && check(t, point).is_ok() {
            return Err(Reason::Event { event: self.name, t });
        }
        Ok(value)
    }

    fn counts(&self, rising: bool) -> bool {
        match self.direction {
            Direction::Rising => rising,
            Direction::Falling => !rising,
            Direction::Any => true,
        }
    }
}

/// Whether the sign changes, and how.
fn crossing(before: f64, value: f64) -> Option<bool> {
    if before < 0.0 && value >= 0.0 {
        Some(true)
    } else if before > 0.0 && value <= 0.0 {
        Some(false)
    } else {
        None
    }
}
