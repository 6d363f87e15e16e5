//! Steps of which the ends tell that nothing happens in between.

use super::{At, Standing, WITHIN_A_STEP, Watcher};
use crate::error::Reason;
use crate::simulate::cubic::{Cubic, Knot};
use crate::simulate::mechanics::Mechanics;
use crate::simulate::standing::Side;
use crate::state::Phase;

/// Part of what a function changes by in a step: a cubic tells that it is further than that from zero.
const NEAR_ZERO: f64 = 0.125;
/// Where samples stand within a step.
const PARTS: [f64; WITHIN_A_STEP as usize - 1] = [0.25, 0.5, 0.75];

/// The way of a function through a step, by its distances beyond zero: positive on the side of the end.
#[derive(Clone, Copy)]
pub(super) struct Told {
    side: f64,
    begin: f64,
    last: f64,
    least: f64,
    most: f64,
    /// The least rise from one sample to the next.
    rise: f64,
}

impl Told {
    fn between(begin: f64, end: f64) -> Self {
        let side = end.signum();
        let begin = begin * side;
        Self { side, begin, last: begin, least: begin, most: begin, rise: f64::INFINITY }
    }

    /// To its next value, if that is a number.
    fn goes(&mut self, value: f64) -> bool {
        let distance = value * self.side;
        let rise = distance - self.last;
        self.rise = if rise < self.rise { rise } else { self.rise };
        self.least = if distance < self.least { distance } else { self.least };
        self.most = if distance > self.most { distance } else { self.most };
        self.last = distance;
        !distance.is_nan()
    }

    /// It does not come near zero, or goes through it without turning.
    fn ends_plainly(&mut self, value: f64) -> bool {
        let near = |told: &Self| NEAR_ZERO * (told.most - told.least);
        self.goes(value) && if self.begin > 0.0 { self.least > near(self) } else { self.rise > near(self) }
    }
}

impl<const N: usize, P: Phase<N>> Watcher<'_, N, P> {
    /// The same, where steps follow: what [`passes`](Self::passes) has to know of the motion there.
    pub(in super::super) fn begin_steps(&mut self, model: &dyn Mechanics<N, P>, point: &P) {
        let knots = self.knots.get_or_insert_with(|| [Knot::NONE, Knot::NONE].map(Box::new));
        model.knot(self.begin.t, point, &mut knots[1]);
    }

    /// Goes to the end of a step if its ends tell that nothing happens on the way: the step is short for the motion, and on the
    /// cubic between them no function comes near zero. Elsewhere samples have to be [looked](Self::look) at.
    ///
    /// # Errors
    /// Those of `at`.
    pub(in super::super) fn passes(
        &mut self,
        model: &dyn Mechanics<N, P>,
        end: f64,
        rate: impl Fn(&P) -> f64,
        at: &mut At<'_, P>,
    ) -> Result<bool, Reason> {
        let Some(knots) = &mut self.knots else { return Ok(false) };
        let (point, _) = at(end)?;
        knots.swap(0, 1);
        model.knot(end, &point, &mut knots[1]);
        self.end.t = end;
        let passes = self.may_pass(&point) && self.are_told(model);
        let before = self.passed.take();
        if passes {
            self.pass();
            self.passed = Some(point);
        } else if let Some(before) = before {
            self.begin.rate = rate(&before);
        }
        Ok(passes)
    }

    /// Every function begins on a side of zero, and is there at the end, or where it may come uncounted.
    fn may_pass(&mut self, point: &P) -> bool {
        let (t, bases) = (self.end.t, self.bases.as_ref());
        let events = self.events.iter().zip(&self.memory).zip(&mut self.end.values);
        events.into_iter().all(|((event, memory), value)| {
            *value = event.at(t, point, bases);
            let is_left =
                |to| matches!(memory.standing, Standing::On(from) if from == to || !event.counts(to));
            Side::of(*value).is_some_and(is_left)
        })
    }

    /// The cubic between the ends of a step tells that no function comes near zero, or goes there and back.
    fn are_told(&mut self, model: &dyn Mechanics<N, P>) -> bool {
        let Self { events, bases, begin, end, ways, knots: Some([from, to]), .. } = self else {
            return false;
        };
        let (t, bases) = (begin.t, bases.as_ref());
        ways.clear();
        ways.extend(begin.values.iter().zip(&end.values).map(|(begin, end)| Told::between(*begin, *end)));
        let mut are_numbers = |part: f64, point: &P| {
            let t = t + part * (end.t - t);
            events.iter().zip(ways.iter_mut()).all(|(event, way)| way.goes(event.at(t, point, bases)))
        };
        let is_cubic =
            begin.t == from.t && model.on_cubic(Cubic { begin: from, end: to }, &PARTS, &mut are_numbers);
        is_cubic && ways.iter_mut().zip(&end.values).all(|(way, end)| way.ends_plainly(*end))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_told(values: [f64; 5]) -> bool {
        let [begin, within @ .., end] = values;
        let mut told = Told::between(begin, end);
        within.into_iter().all(|value| told.goes(value)) && told.ends_plainly(end)
    }

    #[test]
    fn what_stays_away_from_zero_is_told() {
        for side in [1.0, -1.0] {
            let is_told = |values: [f64; 5]| is_told(values.map(|value| side * value));
            assert!(is_told([1.0; 5]) && is_told([1.0, 0.5, 0.3, 0.6, 2.0]));
            assert!(!is_told([1.0, 0.5, 0.1, 0.6, 2.0]), "near zero for how it moves");
            assert!(!is_told([1.0, 0.5, -0.3, 0.6, 2.0]), "there and back");
            assert!(!is_told([1.0, f64::NAN, 1.0, 1.0, 1.0]) && !is_told([1.0, 1.0, 1.0, 1.0, f64::NAN]));
        }
    }

    #[test]
    fn what_goes_through_zero_is_told_if_it_does_not_turn() {
        for side in [1.0, -1.0] {
            let is_told = |values: [f64; 5]| is_told(values.map(|value| side * value));
            assert!(is_told([-1.0, -0.5, 0.1, 0.5, 1.0]) && is_told([-1.0, -0.7, -0.4, 0.0, 0.5]));
            assert!(!is_told([-1.0, -0.5, 0.2, 0.1, 1.0]) && !is_told([-1.0, -1.1, -0.4, 0.0, 0.5]));
            assert!(!is_told([-1.0, 0.5, 0.6, 0.7, 1.0]), "hardly rises");
        }
    }
}
