//! The motion over a step as its ends alone tell it.

use core::ops::Range;

use super::layout::placement_in;
use crate::inner::norm;
use crate::lanes::Lanes;
use crate::model::{Model, Quantity, StateVector};
use crate::scalar::Scalar;

/// Part of the numbers of a group by which their rise over a step may differ from what the rates at its ends make of it: an
/// oscillation turns by 0.7 radians then, and the cubic is off by 7e-4 of its amplitude.
const UNEXPLAINED: f64 = 1.0 / 32.0;
/// `|phi_dot| dt` over a step, relative to `|phi|`.
const FURTHEST: f64 = 1.0;
/// Sums of squares of placements that have all their digits.
const SQUARES: core::ops::RangeInclusive<f64> = 1e-200..=1e200;
/// The most numbers that a phase point has.
pub(super) const MOST: usize = 24;

/// The numbers of a phase point, as the model's plain array has them, and their rates: of one body, or of one in every lane.
#[derive(Clone, Copy)]
pub(super) struct Knot<T = f64> {
    /// Not a number before it is set.
    pub(super) t: T,
    pub(super) numbers: [T; MOST],
    pub(super) rates: [T; MOST],
}

impl<T: Scalar> Knot<T> {
    pub(super) fn none() -> Self {
        Self { t: T::constant(f64::NAN, 0.0), numbers: [T::zero(); MOST], rates: [T::zero(); MOST] }
    }
}

impl Knot {
    /// That of a point at a time: its rates are Hamilton's equations.
    pub(super) fn set<const N: usize, M: Model<N>>(&mut self, model: &M, t: f64, point: &M::Point<f64>) {
        let full = model.flatten(point);
        let rates = model.hamilton_equations(t, &full);
        self.t = t;
        self.numbers.iter_mut().zip(full.as_ref()).for_each(|(own, number)| *own = *number);
        self.rates.iter_mut().zip(rates.as_ref()).for_each(|(own, rate)| *own = *rate);
    }

    /// `|phi_dot|/|phi|` there: what the body turns by, in radians, and its log-stretches change by in a unit of time.
    pub(super) fn turning(&self, placement: Range<usize>) -> f64 {
        let [phi_dot, phi] =
            [&self.rates, &self.numbers].map(|own| norm(own.get(placement.clone()).unwrap_or(&[])));
        if phi_dot.is_nan() || phi == 0.0 { 0.0 } else { phi_dot / phi }
    }
}

impl<T: Lanes> Knot<T> {
    /// That in a lane.
    pub(super) fn of_lane(&self, lane: usize) -> Knot {
        let of_lane = |own: &[T; MOST]| own.map(|number| number.lane(lane));
        Knot { t: self.t.lane(lane), numbers: of_lane(&self.numbers), rates: of_lane(&self.rates) }
    }
}

/// Of sums of squares over a group, see [`quarters`]: its numbers rise by what the rates at both ends make of it by the trapezoidal
/// rule, as of no oscillation that the step passes over, and the placement does not go far.
#[inline(always)]
pub(super) fn are_plain(of: Quantity, [size, rise, left]: [f64; 3]) -> bool {
    let is_near = rise <= FURTHEST * FURTHEST * size && SQUARES.contains(&size);
    left <= UNEXPLAINED * UNEXPLAINED * size && size < f64::INFINITY && (is_near || !of.is_placement())
}

/// A number after each quarter of a step of length `h`, on the cubic that has its rates at both ends; and squares: of the number,
/// of what the rates make of it, and of what that leaves of its rise.
///
/// With `d` the rise of the number, `s` and `b` the sum and the difference of its rates times `h`, the cubic is `m + b/8` in the
/// middle `m` of its values, and `m + 3 b/32 -+ (11 d/32 - 3 s/64)` a quarter before and after it.
#[inline(always)]
pub(super) fn quarters(h: f64, [from, to]: [f64; 2], rates: [f64; 2]) -> ([f64; 3], [f64; 3]) {
    let [leaving, arriving] = rates.map(|rate| h * rate);
    let (rise, both, bend) = (to - from, leaving + arriving, leaving - arriving);
    let (middle, left) = (0.5 * (from + to), rise - 0.5 * both);
    let (even, odd) = (middle + 3.0 / 32.0 * bend, 11.0 / 32.0 * rise - 3.0 / 64.0 * both);
    let squares = [from * from + to * to, leaving * leaving + arriving * arriving, left * left];
    ([even - odd, middle + 0.125 * bend, even + odd], squares)
}

/// The numbers of the phase points after each quarter of the step between two knots, unchecked, if that is short for the motion.
#[inline(always)]
pub(super) fn on_cubic<const N: usize, M: Model<N>>(
    [begin, end]: [&Knot; 2],
    points: &mut [M::Full<f64>; 3],
) -> bool {
    let h = end.t - begin.t;
    let [first, second, third] = points;
    let (first, second, third) = (first.as_mut(), second.as_mut(), third.as_mut());
    let [mut sizes, mut rises, mut lefts] = [[0.0; MOST]; 3];
    for i in 0..const { at_most(M::Full::<f64>::LEN) } {
        let ends = [begin.numbers[i], end.numbers[i]];
        let (on, squares) = quarters(h, ends, [begin.rates[i], end.rates[i]]);
        [first[i], second[i], third[i]] = on;
        [sizes[i], rises[i], lefts[i]] = squares;
    }
    let (mut is_plain, mut start) = (are_told::<N, M>(), 0);
    for group in M::DESCRIPTION.full {
        let range = start..MOST.min(start + group.len);
        start = range.end;
        let sums = [&sizes, &rises, &lefts].map(|own| own[range.clone()].iter().sum::<f64>());
        is_plain &= are_plain(group.quantity, sums);
    }
    is_plain
}

/// Steps of a model are told by their ends: it has a placement, and no more numbers than a knot.
#[inline(always)]
pub(super) const fn are_told<const N: usize, M: Model<N>>() -> bool {
    const { placement_in(M::DESCRIPTION.full, N).is_some() && M::Full::<f64>::LEN <= MOST }
}

/// Numbers that a knot has, of so many.
const fn at_most(len: usize) -> usize {
    if len < MOST { len } else { MOST }
}
