//! Steps of which the ends tell that nothing happens in between.

use super::told::{Along, Step};
use super::{At, Watcher};
use crate::error::Reason;
use crate::inner::larger;
use crate::simulate::cubic::Knot;
use crate::simulate::layout::placement_in;
use crate::simulate::mechanics::Mechanics;
use crate::simulate::standing::{Side, Standing};
use crate::state::Phase;

/// A step as its ends alone tell it.
pub(in super::super) struct Ends<'p, P> {
    /// Where it begins.
    pub(in super::super) begin: f64,
    /// Its end, and the point there.
    pub(in super::super) end: (f64, &'p P),
    /// The points after each quarter, on a cubic between the ends that tells the motion.
    pub(in super::super) quarters: Option<&'p [P; 3]>,
}

impl<const N: usize, P: Phase<N>> Watcher<'_, N, P> {
    /// The same, where steps follow: what [`passes`](Self::passes) has to know of the motion there.
    pub(in super::super) fn begin_steps(&mut self, model: &dyn Mechanics<N, P>, point: &P) {
        let knots = self.knots.get_or_insert_with(|| [Knot::none(), Knot::none()].map(Box::new));
        model.knot(self.begin.t, point, &mut knots[1]);
    }

    /// Goes to the end of a step if its ends [tell](Self::goes_by) that it may. What rates are at least is known.
    ///
    /// # Errors
    /// Those of `at`.
    pub(in super::super) fn passes(
        &mut self,
        model: &dyn Mechanics<N, P>,
        (end, least): (f64, f64),
        at: &mut At<'_, P>,
    ) -> Result<Step<P>, Reason> {
        let Some(mut knots) = self.knots.take() else { return Ok(Step::Open(None)) };
        let (point, _) = at(end)?;
        knots.swap(0, 1);
        model.knot(end, &point, &mut knots[1]);
        let [from, to] = &knots;
        let quarters = model.on_cubic([from, to]);
        let ends = Ends { begin: from.t, end: (end, &point), quarters: quarters.as_ref() };
        let placement = || placement_in(model.description().full, N).unwrap_or_default();
        let step = self.goes_by(&ends, least, || from.turning(placement()));
        self.knots = Some(knots);
        Ok(step)
    }

    /// Goes to the end of a step if its ends tell that nothing happens on the way: the step is short for the motion, and on the
    /// cubic between them no function comes near zero. Elsewhere samples have to be [looked](Self::look) at, that at the end
    /// alone where functions go straight through zero. What rates are at least is known, and how the body turns at the begin.
    pub(in super::super) fn goes_by(
        &mut self,
        ends: &Ends<'_, P>,
        least: f64,
        turning: impl FnOnce() -> f64,
    ) -> Step<P> {
        let told = self.told(ends);
        if let Some((false, stay)) = told {
            match stay {
                true => core::mem::swap(&mut self.begin, &mut self.end),
                false => self.pass(),
            }
            self.has_passed = true;
            return Step::Quiet;
        }
        if core::mem::take(&mut self.has_passed) {
            self.begin.rate = larger(least, turning());
        }
        self.are_told = told.is_some();
        let (_, point) = ends.end;
        if self.are_told { Step::Crossed(*point) } else { Step::Open(Some(*point)) }
    }

    /// Whether a function goes beyond zero where that counts, and whether all stay on their sides of it; `None` where one has no
    /// side at an end of the step, comes near zero on the cubic in between, or goes there and back.
    fn told(&mut self, ends: &Ends<'_, P>) -> Option<(bool, bool)> {
        let Self { events, memory, bases, begin, end, ways, .. } = self;
        let (bases, from, to) = (bases.as_ref(), begin.t, ends.end.0);
        end.t = to;
        let [first, second, third] = ends.quarters.filter(|_| from == ends.begin)?;
        let [quarter, half, three_quarters] = [0.25, 0.5, 0.75].map(|part| from + part * (to - from));
        let (mut crosses, mut stay) = (false, true);
        let values = begin.values.iter().zip(&mut end.values);
        for (((event, memory), (from, to)), way) in events.iter().zip(memory).zip(values).zip(ways) {
            let at = |t, point| event.at(t, point, bases);
            *to = at(ends.end.0, ends.end.1);
            let (Standing::On(begin), end) = (memory.standing, Side::of(*to)?) else { return None };
            *way = Along([*from, at(quarter, first), at(half, second), at(three_quarters, third), *to]);
            if !way.is_plain() {
                return None;
            }
            stay &= begin == end;
            crosses |= begin != end && event.counts(end);
        }
        Some((crosses, stay))
    }
}
