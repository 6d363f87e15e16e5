//! Steps of which the ends tell that nothing happens in between.

use super::told::{Step, Told};
use super::{At, Watcher};
use crate::error::Reason;
use crate::inner::larger;
use crate::simulate::cubic::{Cubic, Knot};
use crate::simulate::layout::placement_in;
use crate::simulate::mechanics::Mechanics;
use crate::simulate::standing::{Side, Standing};
use crate::state::Phase;

impl<const N: usize, P: Phase<N>> Watcher<'_, N, P> {
    /// The same, where steps follow: what [`passes`](Self::passes) has to know of the motion there.
    pub(in super::super) fn begin_steps(&mut self, model: &dyn Mechanics<N, P>, point: &P) {
        let knots = self.knots.get_or_insert_with(|| [Knot::NONE, Knot::NONE].map(Box::new));
        model.knot(self.begin.t, point, &mut knots[1]);
    }

    /// Goes to the end of a step if its ends tell that nothing happens on the way: the step is short for the motion, and on the
    /// cubic between them no function comes near zero. Elsewhere samples have to be [looked](Self::look) at, that at the end
    /// alone where functions go straight through zero. What rates are at least is known.
    ///
    /// # Errors
    /// Those of `at`.
    pub(in super::super) fn passes(
        &mut self,
        model: &dyn Mechanics<N, P>,
        (end, least): (f64, f64),
        at: &mut At<'_, P>,
    ) -> Result<Step<P>, Reason> {
        let Some(knots) = &mut self.knots else { return Ok(Step::Open(None)) };
        let (point, _) = at(end)?;
        knots.swap(0, 1);
        model.knot(end, &point, &mut knots[1]);
        self.end.t = end;
        let crosses = self.ends(&point);
        let is_told = crosses.is_some() && self.are_told(model);
        if is_told && crosses == Some(false) {
            self.pass();
            self.has_passed = true;
            return Ok(Step::Quiet);
        }
        if let (true, Some([begin, _])) = (core::mem::take(&mut self.has_passed), &self.knots) {
            let placement = placement_in(model.description().full, N).unwrap_or_default();
            self.begin.rate = larger(least, begin.turning(placement));
        }
        if is_told {
            return Ok(Step::Crossed(point));
        }
        self.ways.clear();
        Ok(Step::Open(Some(point)))
    }

    /// Looks at the end of a step: whether a function is beyond zero there that counts; `None` where one has no side of zero
    /// there or at the begin.
    fn ends(&mut self, point: &P) -> Option<bool> {
        let (t, bases) = (self.end.t, self.bases.as_ref());
        let events = self.events.iter().zip(&self.memory).zip(&mut self.end.values);
        let mut crosses = false;
        for ((event, memory), value) in events {
            *value = event.at(t, point, bases);
            let (Standing::On(from), to) = (memory.standing, Side::of(*value)?) else { return None };
            crosses |= from != to && event.counts(to);
        }
        Some(crosses)
    }

    /// The cubic between the ends of a step tells that no function comes near zero, or goes there and back.
    fn are_told(&mut self, model: &dyn Mechanics<N, P>) -> bool {
        let Self { events, bases, begin, end, ways, knots: Some([from, to]), .. } = self else {
            return false;
        };
        let (t, bases) = (begin.t, bases.as_ref());
        ways.clear();
        ways.extend(begin.values.iter().zip(&end.values).map(|(begin, end)| Told::between(*begin, *end)));
        let mut each = |quarter: u8, point: &P| {
            let t = t + 0.25 * f64::from(quarter) * (end.t - t);
            events
                .iter()
                .zip(ways.iter_mut())
                .for_each(|(event, way)| way.set(quarter, event.at(t, point, bases)));
        };
        begin.t == from.t
            && model.on_cubic(Cubic { begin: from, end: to }, &mut each)
            && ways.iter().all(Told::is_plain)
    }
}
