//! The motion over a step as its ends alone tell it.

use core::ops::Range;

use super::layout::placement_in;
use crate::inner::norm;
use crate::model::{Model, StateVector};

/// Part of the numbers of a group by which their rise over a step may differ from what the rates at its ends make of it: an
/// oscillation turns by 0.7 radians then, and the cubic is off by 7e-4 of its amplitude.
const UNEXPLAINED: f64 = 1.0 / 32.0;
/// `|phi_dot| dt` over a step, relative to `|phi|`.
const FURTHEST: f64 = 1.0;
/// Sums of squares of placements that have all their digits.
const SQUARES: core::ops::RangeInclusive<f64> = 1e-200..=1e200;
/// The most numbers that a phase point has.
const MOST: usize = 24;

/// The numbers of a phase point, as the model's plain array has them, and their rates.
#[derive(Clone, Copy)]
pub(super) struct Knot {
    /// Not a number before it is set.
    pub(super) t: f64,
    numbers: [f64; MOST],
    rates: [f64; MOST],
}

impl Knot {
    pub(super) const NONE: Self = Self { t: f64::NAN, numbers: [0.0; MOST], rates: [0.0; MOST] };

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

/// The cubic through two knots that has their rates there.
#[derive(Clone, Copy)]
pub(super) struct Cubic<'k> {
    pub(super) begin: &'k Knot,
    pub(super) end: &'k Knot,
}

impl Cubic<'_> {
    /// The numbers of the phase points after each quarter of the step, if that is short for the motion: what each group of
    /// numbers rises by is what the rates at both ends make of it by the trapezoidal rule, as of no oscillation that the step
    /// passes over, and the placement does not go far. Points are unchecked.
    ///
    /// With `h` the length of the step, `d` the rise of a number, `s` and `b` the sum and the difference of its rates times
    /// `h`, the cubic is `m + b/8` in the middle `m` of its values, and `m + 3 b/32 -+ (11 d/32 - 3 s/64)` a quarter before and
    /// after it.
    #[inline(always)]
    pub(super) fn quarters<const N: usize, M: Model<N>>(self, quarters: &mut [M::Full<f64>; 3]) -> bool {
        let Self { begin, end } = self;
        let h = end.t - begin.t;
        let [first, second, third] = quarters;
        let (first, second, third) = (first.as_mut(), second.as_mut(), third.as_mut());
        // Squares of numbers, of what the rates make of them, and of what that leaves.
        let [mut sizes, mut rises, mut lefts] = [[0.0; MOST]; 3];
        for i in 0..const { at_most(M::Full::<f64>::LEN) } {
            let (from, to) = (begin.numbers[i], end.numbers[i]);
            let (leaving, arriving) = (h * begin.rates[i], h * end.rates[i]);
            let (rise, both, bend) = (to - from, leaving + arriving, leaving - arriving);
            let (middle, left) = (0.5 * (from + to), rise - 0.5 * both);
            let (even, odd) = (middle + 3.0 / 32.0 * bend, 11.0 / 32.0 * rise - 3.0 / 64.0 * both);
            (first[i], second[i], third[i]) = (even - odd, middle + 0.125 * bend, even + odd);
            sizes[i] = from * from + to * to;
            rises[i] = leaving * leaving + arriving * arriving;
            lefts[i] = left * left;
        }
        let mut start = 0;
        let are_plain = M::DESCRIPTION.full.iter().all(|group| {
            let range = start..MOST.min(start + group.len);
            start = range.end;
            let [size, rise, left] =
                [&sizes, &rises, &lefts].map(|own| own[range.clone()].iter().sum::<f64>());
            let is_near = rise <= FURTHEST * FURTHEST * size && SQUARES.contains(&size);
            left <= UNEXPLAINED * UNEXPLAINED * size
                && size < f64::INFINITY
                && (is_near || !group.quantity.is_placement())
        });
        are_plain && const { placement_in(M::DESCRIPTION.full, N).is_some() && M::Full::<f64>::LEN <= MOST }
    }
}

/// Numbers that a knot has, of so many.
const fn at_most(len: usize) -> usize {
    if len < MOST { len } else { MOST }
}
