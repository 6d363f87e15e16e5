//! Steps whose last two coefficients do not tell what they leave out.

use crate::error_norm::ErrorNorm;
use affine_core::__private::numerics::{HIGHEST_ORDER, larger, square, sum_of_squares};
use affine_core::model::StateVector;

/// Series of lower orders may end before the first term after a gap: `x'' = -x^7` from `x = 0` has `t^1`, `t^9`, `t^17`.
const TOLD_BY_TERMS: usize = 8;
/// Terms of a series without gaps are so near a geometric sequence, above or below it.
const NEARLY_GEOMETRIC: f64 = 50.0;

/// The quotient of a geometric sequence from 1 to the tolerance at the order.
pub(super) fn quotient(tolerance: f64, order: usize) -> f64 {
    libm::exp(libm::log(tolerance) / order as f64)
}

/// The last two coefficients may say too little of a step.
///
/// The largest of the terms of the third quarter of a series, of the last quarter and of the last two are nearly a geometric
/// sequence where there is a pole, and fall a little faster where there is none. Of a series with gaps, in which `k - 1` of `k`
/// terms vanish or nearly so, the last two may be much less than those before let expect. That matters where one of those is
/// above the geometric sequence that ends at the tolerance: a step is too long then.
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
    let ratio = square(h / (unit * quotient));
    let (mut weights, mut weight) = ([0.0; HIGHEST_ORDER + 1], 1.0);
    for place in &mut weights[1..=order] {
        weight *= ratio;
        *place = weight;
    }
    let (third, last_two) = (order / 2, order - 1);
    let last = (third + last_two) / 2;
    let y = coefficients[0].as_ref();
    let excess = error_norm.largest(h.abs(), y, y, |range| {
        let of_order = |j: usize| weights[j] * sum_of_squares(&coefficients[j].as_ref()[range.clone()]);
        let [a, b, c] = [third..last, last..last_two, last_two..order + 1]
            .map(|window| window.map(of_order).fold(0.0, larger));
        let (middle, ends, slack) = (b * b, a * c, square(NEARLY_GEOMETRIC));
        let is_regular = middle <= slack * ends && ends <= slack * middle;
        if is_regular { 0.0 } else { libm::sqrt(larger(a, b)) }
    });
    excess > 1.0
}
