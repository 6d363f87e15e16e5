//! The motion over a step as its ends alone tell it.

use super::layout::placement_in;
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
}

/// The cubic through two knots that has their rates there.
#[derive(Clone, Copy)]
pub(super) struct Cubic<'k> {
    pub(super) begin: &'k Knot,
    pub(super) end: &'k Knot,
}

impl Cubic<'_> {
    /// The step is short for the motion: what each group of numbers rises by is what the rates at both ends make of it by the
    /// trapezoidal rule, as of no oscillation that the step passes over, and the placement does not go far.
    pub(super) fn is_plain<const N: usize, M: Model<N>>(self) -> bool {
        let Self { begin, end } = self;
        let h = end.t - begin.t;
        let begins = begin.numbers.iter().zip(&begin.rates);
        let mut numbers = begins.zip(end.numbers.iter().zip(&end.rates));
        let are_plain = M::DESCRIPTION.full.iter().all(|group| {
            // Squares of numbers, of what the rates make of them, and of what that leaves.
            let (mut size, mut rise, mut left) = (0.0, 0.0, 0.0);
            for ((from, leaving), (to, arriving)) in numbers.by_ref().take(group.len) {
                let unexplained = to - from - 0.5 * h * (leaving + arriving);
                size += from * from + to * to;
                rise += leaving * leaving + arriving * arriving;
                left += unexplained * unexplained;
            }
            let is_near = h * h * rise <= FURTHEST * FURTHEST * size && SQUARES.contains(&size);
            left <= UNEXPLAINED * UNEXPLAINED * size
                && size < f64::INFINITY
                && (is_near || !group.quantity.is_placement())
        });
        are_plain && const { placement_in(M::DESCRIPTION.full, N).is_some() && M::Full::<f64>::LEN <= MOST }
    }

    /// The phase point after a part of the step, unchecked.
    pub(super) fn point<const N: usize, M: Model<N>>(self, model: &M, part: f64) -> M::Point<f64> {
        let Self { begin, end } = self;
        let (h, left) = (end.t - begin.t, 1.0 - part);
        let rising = part * part * (1.0 + 2.0 * left);
        let (leaving, arriving) = (h * part * left * left, h * part * part * left);
        let mut full = M::Full::<f64>::zeros();
        let ends = begin.numbers.iter().zip(&begin.rates).zip(end.numbers.iter().zip(&end.rates));
        for (number, ((from, at_begin), (to, at_end))) in full.as_mut().iter_mut().zip(ends) {
            *number = from + rising * (to - from) + leaving * at_begin - arriving * at_end;
        }
        model.unflatten(&full)
    }
}
