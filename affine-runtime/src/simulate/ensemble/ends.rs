//! What the ends of steps tell, of eight bodies at once.

use core::ptr;

use crate::inner::vectorized;
use crate::lanes::{F64x8, Lanes};
use crate::model::{Model, StateVector};
use crate::simulate::cubic::{Knot, MOST, are_plain, are_told, quarters};
use crate::simulate::layout::placement_in;
use crate::simulate::watcher::Ends;

/// Lanes that are looked at together: every kind of lanes has whole ones of these.
const EIGHT: usize = F64x8::LANES;

/// The ends of the last steps of eight bodies.
struct Eight<'a, const N: usize, M: Model<N>> {
    models: [&'a M; EIGHT],
    points: [M::Point<f64>; EIGHT],
    knots: [Box<Knot<F64x8>>; 2],
    /// On the cubics between the knots.
    quarters: [M::Full<F64x8>; 3],
    /// Cubics tell the motions.
    are_plain: [bool; EIGHT],
}

/// The ends of the last steps in lanes.
pub(super) struct EndsInLanes<'a, const N: usize, M: Model<N>>(Vec<Eight<'a, N, M>>);

impl<'a, const N: usize, M: Model<N>> EndsInLanes<'a, N, M> {
    /// Of so many lanes, before there are bodies in them.
    pub(super) fn new(lanes: usize, (model, point): (&'a M, &M::Point<f64>)) -> Self {
        let eight = || Eight {
            models: [model; EIGHT],
            points: [*point; EIGHT],
            knots: [Knot::none(), Knot::none()].map(Box::new),
            quarters: [M::Full::zeros(); 3],
            are_plain: [false; EIGHT],
        };
        Self((0..lanes / EIGHT).map(|_| eight()).collect())
    }

    /// A body begins in a lane.
    pub(super) fn begin(&mut self, lane: usize, model: &'a M, (t, point): (f64, &M::Point<f64>)) {
        let Eight { models, knots: [_, end], .. } = &mut self.0[lane / EIGHT];
        let (lane, full) = (lane % EIGHT, model.flatten(point));
        models[lane] = model;
        end.t.set_lane(lane, t);
        set_lane(&mut end.numbers, lane, &full);
        set_lane(&mut end.rates, lane, &model.hamilton_equations(t, &full));
    }

    /// Goes to the ends of the next steps: times, and the points there. A lane without one stays where it is.
    pub(super) fn step(&mut self, end: impl Fn(usize) -> Option<(f64, M::Point<f64>)>) {
        for (k, Eight { models, points, knots, quarters, are_plain }) in self.0.iter_mut().enumerate() {
            knots.swap(0, 1);
            let [from, to] = knots;
            for lane in 0..EIGHT {
                let end = end(EIGHT * k + lane);
                to.t.set_lane(lane, end.map_or(from.t.lane(lane), |(t, _)| t));
                if let Some((_, point)) = end {
                    set_lane(&mut to.numbers, lane, &models[lane].flatten(&point));
                    points[lane] = point;
                } else {
                    set_lane(&mut to.numbers, lane, &numbers::<M::Full<f64>>(&from.numbers, lane));
                }
            }
            vectorized(
                #[inline(always)]
                || {
                    set_rates(models, to);
                    *are_plain = set_quarters::<N, M>(from, to, quarters);
                },
            );
        }
    }

    /// What `look` finds at the ends of the step in a lane, given how the body turns at the begin.
    pub(super) fn of_lane<R>(
        &self,
        lane: usize,
        look: impl FnOnce(&Ends<'_, M::Point<f64>>, &dyn Fn() -> f64) -> R,
    ) -> R {
        let Eight { models, points, knots: [from, to], quarters, are_plain } = &self.0[lane / EIGHT];
        let lane = lane % EIGHT;
        let ([first, second, third], model) = (quarters, models[lane]);
        let quarters = [point(model, first, lane), point(model, second, lane), point(model, third, lane)];
        let ends = Ends {
            begin: from.t.lane(lane),
            end: (to.t.lane(lane), &points[lane]),
            quarters: are_plain[lane].then_some(&quarters),
        };
        let placement = const { placement_in(M::DESCRIPTION.full, N) };
        look(&ends, &|| from.of_lane(lane).turning(placement.clone().unwrap_or_default()))
    }
}

/// The point in a lane. Called, so that its numbers go through registers one by one.
#[inline(never)]
fn point<const N: usize, M: Model<N>>(model: &M, lanes: &M::Full<F64x8>, lane: usize) -> M::Point<f64> {
    model.unflatten(&numbers(lanes.as_ref(), lane))
}

/// The numbers in a lane.
#[inline(always)]
fn numbers<S: StateVector<f64>>(lanes: &[F64x8], lane: usize) -> S {
    let mut numbers = S::zeros();
    numbers.as_mut().iter_mut().zip(lanes).for_each(|(own, lanes)| *own = lanes.lane(lane));
    numbers
}

/// Puts numbers into a lane.
#[inline(always)]
fn set_lane(lanes: &mut [F64x8], lane: usize, numbers: &impl StateVector<f64>) {
    lanes.iter_mut().zip(numbers.as_ref()).for_each(|(own, number)| own.set_lane(lane, *number));
}

/// Sets the rates of eight knots, Hamilton's equations by the model of each lane: of one model for all lanes at once, which takes
/// a third of the instructions.
#[inline(always)]
fn set_rates<const N: usize, M: Model<N>>(models: &[&M; EIGHT], knot: &mut Knot<F64x8>) {
    let first = models[0];
    if models.iter().all(|model| ptr::eq(*model, first)) {
        let mut full = M::Full::<F64x8>::zeros();
        full.as_mut().iter_mut().zip(&knot.numbers).for_each(|(own, number)| *own = *number);
        let rates = first.hamilton_equations(knot.t, &full);
        knot.rates.iter_mut().zip(rates.as_ref()).for_each(|(own, rate)| *own = *rate);
        return;
    }
    for lane in 0..EIGHT {
        let rates = models[lane].hamilton_equations(knot.t.lane(lane), &numbers(&knot.numbers, lane));
        set_lane(&mut knot.rates, lane, &rates);
    }
}

/// Sets the numbers after each quarter of eight steps, in loops over lanes, which compilers turn into vector instructions;
/// whether the steps are short for the motions.
#[inline(always)]
fn set_quarters<const N: usize, M: Model<N>>(
    begin: &Knot<F64x8>,
    end: &Knot<F64x8>,
    on: &mut [M::Full<F64x8>; 3],
) -> [bool; EIGHT] {
    let [first, second, third] = on;
    let (first, second, third) = (first.as_mut(), second.as_mut(), third.as_mut());
    let (mut plain, mut start) = ([are_told::<N, M>(); EIGHT], 0);
    for group in M::DESCRIPTION.full {
        let [mut sizes, mut rises, mut lefts] = [[0.0; EIGHT]; 3];
        let range = start..MOST.min(start + group.len);
        start = range.end;
        for i in range {
            for lane in 0..EIGHT {
                let h = end.t.lane(lane) - begin.t.lane(lane);
                let numbers = [begin.numbers[i].lane(lane), end.numbers[i].lane(lane)];
                let rates = [begin.rates[i].lane(lane), end.rates[i].lane(lane)];
                let ([a, b, c], [size, rise, left]) = quarters(h, numbers, rates);
                first[i].set_lane(lane, a);
                second[i].set_lane(lane, b);
                third[i].set_lane(lane, c);
                sizes[lane] += size;
                rises[lane] += rise;
                lefts[lane] += left;
            }
        }
        for lane in 0..EIGHT {
            plain[lane] &= are_plain(group.quantity, [sizes[lane], rises[lane], lefts[lane]]);
        }
    }
    plain
}
