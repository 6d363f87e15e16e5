//! Steps of which the ends tell that nothing happens in between.

use super::told::Told;
use super::{At, WITHIN_A_STEP, Watcher};
use crate::error::Reason;
use crate::simulate::cubic::{Cubic, Knot};
use crate::simulate::mechanics::Mechanics;
use crate::simulate::standing::{Side, Standing};
use crate::state::Phase;

/// Where samples stand within a step.
const PARTS: [f64; WITHIN_A_STEP as usize - 1] = [0.25, 0.5, 0.75];

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
