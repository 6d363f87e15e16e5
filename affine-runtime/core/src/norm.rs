//! Euclidean norms of any size, and the largest of numbers.

use crate::scalar::Scalar;

/// Sums of squares within these bounds have neither overflowed nor lost digits to underflow.
pub const IN_RANGE: core::ops::RangeInclusive<f64> = 1e-280..=1e300;

/// Euclidean norm.
#[inline(always)]
pub fn norm(components: &[f64]) -> f64 {
    let sum = sum_of_squares(components);
    if IN_RANGE.contains(&sum) { Scalar::sqrt(sum) } else { scaled_norm(components.iter().copied()) }
}

/// The same of numbers whose squares leave the range; NaN where one is.
#[cold]
pub fn scaled_norm(components: impl Iterator<Item = f64> + Clone) -> f64 {
    let largest = components.clone().map(Scalar::abs).fold(0.0, larger);
    if largest == 0.0 || !largest.is_finite() {
        return largest;
    }
    let scaled = components.map(|v| square(v / largest)).sum::<f64>();
    largest * Scalar::sqrt(scaled)
}

/// Sum of squares: of every fourth component first, so that none of four additions waits for another.
#[inline(always)]
pub fn sum_of_squares(components: &[f64]) -> f64 {
    // Groups are short, and a loop over a few numbers takes longer to begin than they do.
    let squares = |four: &[f64; 4]| [square(four[0]), square(four[1]), square(four[2]), square(four[3])];
    let (fours, rest) = components.as_chunks::<4>();
    let plus = |a: [f64; 4], b: [f64; 4]| [a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]];
    let [a, b, c, d] = match fours {
        [] => [0.0; 4],
        [only] => squares(only),
        [first, second] => plus(squares(first), squares(second)),
        _ => fours.iter().fold([0.0; 4], |sums, four| plus(sums, squares(four))),
    };
    let sum = (a + c) + (b + d);
    match *rest {
        [] => sum,
        [x] => sum + square(x),
        [x, y] => (sum + square(x)) + square(y),
        _ => rest.iter().fold(sum, |sum, v| sum + square(*v)),
    }
}

/// A square.
#[inline(always)]
pub fn square(value: f64) -> f64 {
    value * value
}

/// The larger of two numbers; NaN where one is, which `f64::max` would drop.
#[inline(always)]
pub fn larger(a: f64, b: f64) -> f64 {
    if a >= b || a.is_nan() { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn norms_of_any_size() {
        for unit in [1.0, 1e200, 1e-200] {
            assert!((norm(&[3.0 * unit, 0.0, -4.0 * unit]) / unit - 5.0).abs() < 1e-14);
        }
        assert_eq!(norm(&[0.0, 0.0]), 0.0);
        assert_eq!(norm(&[f64::NEG_INFINITY, 0.0]), f64::INFINITY);
        assert!(norm(&[f64::NAN, 1.0]).is_nan() && norm(&[1e300, f64::NAN]).is_nan());
    }

    #[test]
    fn nothing_is_larger_than_what_is_no_number() {
        assert_eq!((larger(1.0, 2.0), larger(2.0, 1.0), larger(-1.0, 0.0)), (2.0, 2.0, 0.0));
        let lists = [[f64::NAN, 1.0, 2.0], [1.0, f64::NAN, 2.0], [1.0, 2.0, f64::NAN]];
        assert!(lists.iter().all(|list| list.iter().copied().fold(0.0, larger).is_nan()));
    }
}
