//! Steps whose last two coefficients do not tell what they leave out, or are lost themselves.

use core::ops::Range;

use crate::error_norm::ErrorNorm;
use affine_core::__private::numerics::{HIGHEST_ORDER, larger, norm, square, sum_of_squares};
use affine_core::model::StateVector;
use affine_core::scalar::Scalar;

/// Series of lower orders may end before the first term after a gap: `x'' = -x^7` from `x = 0` has `t^1`, `t^9`, `t^17`.
const TOLD_BY_TERMS: usize = 8;
/// Terms of a series without gaps are so near a geometric sequence, above or below it.
const NEARLY_GEOMETRIC: f64 = 50.0;
/// Terms that are so many times those a third of the series before grow, and are no rounding.
const GROWN: f64 = 10.0;

/// The quotient of a geometric sequence from 1 to the tolerance at the order.
pub(super) fn quotient(tolerance: f64, order: usize) -> f64 {
    libm::exp(libm::log(tolerance) / order as f64)
}

/// The last two coefficients may say too little of a step.
///
/// The largest of the terms of the third quarter of a series, of the last quarter and of the last two are nearly a geometric
/// sequence where there is a pole, and fall a little faster where there is none. Of a series with gaps, in which `k - 1` of `k`
/// terms vanish or nearly so, the last two may be much less than those before let expect. That matters where one of those is
/// above the geometric sequence that ends at the tolerance: a step is too long then. Terms that grow go on growing, however
/// small they are: on the way to a steep wall, `exp(-1000 x)`, those after the last ones are larger than all before.
#[inline(always)]
pub(super) fn hides_terms<S: StateVector<f64>>(
    coefficients: &[S],
    error_norm: &ErrorNorm,
    (h, unit, quotient): (f64, f64, f64),
) -> bool {
    let order = coefficients.len() - 1;
    if order < TOLD_BY_TERMS {
        return true;
    }
    let ratio = h.abs() / (unit * quotient);
    let (mut weights, mut weight) = ([0.0; HIGHEST_ORDER + 1], 1.0);
    for place in &mut weights[..=order] {
        *place = weight;
        weight *= ratio;
    }
    let (third, last_two) = (order / 2, order - 1);
    let last = (third + last_two) / 2;
    // One by one: what arrays are mapped by is not compiled for the vectors of the processor.
    let a = largest(&coefficients[third..last], &weights[third..last]);
    let b = largest(&coefficients[last..last_two], &weights[last..last_two]);
    let c = largest(&coefficients[last_two..], &weights[last_two..]);
    let (y, terms) = (coefficients[0].as_ref(), [a.as_ref(), b.as_ref(), c.as_ref()]);
    let growth = (last..=order).fold(1.0 / GROWN, |growth, _| growth * quotient);
    grow(a.as_ref(), c.as_ref(), growth) || are_irregular(error_norm, h, y, terms)
}

/// The last terms of a component are [so many times](GROWN) larger than those a third of the series before, the weights of both
/// aside.
#[inline(always)]
fn grow(before: &[f64], last: &[f64], growth: f64) -> bool {
    before.iter().zip(last).fold(false, |grow, (before, last)| grow | (growth * last > *before))
}

/// What the coefficients are made of grows along the series, or is no number. The branch point of a function within the
/// equations, the root of `x^2 + 1e-30` at `x = 0`, may be nearer than the end of a step although the motion has none there: its
/// terms cancel in those of the motion, and these are what rounding leaves. A value is held to its first terms, of even and of odd
/// orders. Series of lower orders [are not believed](TOLD_BY_TERMS) anyway.
#[inline(always)]
pub(super) fn outgrows<R: StateVector<f64>>(rows: &[R], ratio: f64) -> bool {
    let ([zero, one, two, three, ..], [.., before, last], TOLD_BY_TERMS..) = (rows, rows, rows.len()) else {
        return false;
    };
    let first = [zero.as_ref(), one.as_ref(), two.as_ref(), three.as_ref()];
    ends_above(first, [before.as_ref(), last.as_ref()], ratio, rows.len() as f64)
}

/// A term of the last two orders is larger than those of the first four. A function of numbers alone, as the one below.
#[inline(never)]
fn ends_above(
    [zero, one, two, three]: [&[f64]; 4],
    [before, last]: [&[f64]; 2],
    ratio: f64,
    orders: f64,
) -> bool {
    let end = libm::pow(ratio, orders - 2.0);
    let firsts = zero.iter().zip(one).zip(two).zip(three);
    firsts.zip(before.iter().zip(last)).fold(false, |above, ((((zero, one), two), three), (before, last))| {
        let first = zero.abs() + ratio * (one.abs() + ratio * (two.abs() + ratio * three.abs()));
        let last = end * (before.abs() + ratio * last.abs());
        above | (last > first) | last.is_nan()
    })
}

/// The largest terms are no geometric sequence, and one of those before the last two is above that which ends at the tolerance. A
/// function of numbers alone: it is compiled once for all models.
#[inline(never)]
fn are_irregular(error_norm: &ErrorNorm, h: f64, y: &[f64], [a, b, c]: [&[f64]; 3]) -> bool {
    let is_regular = |range: &Range<usize>| {
        let (a, b) = (sum_of_squares(&a[range.clone()]), sum_of_squares(&b[range.clone()]));
        let (middle, ends, slack) = (b * b, a * sum_of_squares(&c[range.clone()]), square(NEARLY_GEOMETRIC));
        middle <= slack * ends && ends <= slack * middle
    };
    let mut start = 0;
    let are_regular = error_norm.groups().iter().all(|group| {
        let range = start..start + group.len;
        start = range.end;
        is_regular(&range)
    });
    // As a rule.
    if are_regular {
        return false;
    }
    let excess = error_norm.largest(h.abs(), y, y, |range| match is_regular(&range) {
        true => 0.0,
        false => larger(norm(&a[range.clone()]), norm(&b[range])),
    });
    excess > 1.0
}

/// The largest of some terms, component by component: in vectors, where sizes of groups would be single numbers.
#[inline(always)]
fn largest<S: StateVector<f64>>(coefficients: &[S], weights: &[f64]) -> S {
    let mut largest = S::zeros();
    for (coefficient, weight) in coefficients.iter().zip(weights) {
        for (largest, component) in largest.as_mut().iter_mut().zip(coefficient.as_ref()) {
            let term = weight * Scalar::abs(*component);
            *largest = if term > *largest { term } else { *largest };
        }
    }
    largest
}
