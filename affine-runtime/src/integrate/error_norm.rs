//! The norm in which integrators measure errors.

use core::ops::Range;

use crate::model::Group;
use crate::scalar::Real;

/// Largest relative error of the geometric objects in a state vector.
///
/// `max over groups g of |e_g| / s_g`, `|.|` the Frobenius norm and `s_g` the larger of `|g|` before and after the
/// step, so that neither rotations of space nor units change it. Two groups have a scale of their own:
///
/// * `x`, a position, is measured against `|x| + |phi|`: it may start at zero, its origin is arbitrary, and under
///   affine maps of space it transforms as the columns of `phi` do;
/// * `q`, logarithms of stretches, is measured against 1: an error of `q` is a relative error of `exp q`.
///
/// Sums of squares are formed without scaling: groups between about 1e-150 and 1e150 in norm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorNorm {
    groups: &'static [Group],
}

impl ErrorNorm {
    /// The norm for a state vector that consists of `groups`, one after the other.
    #[must_use]
    pub const fn new(groups: &'static [Group]) -> Self {
        Self { groups }
    }

    /// `max_g value(range of g) / s_g`; zero where `value` is, and NaN where a scale is not finite.
    pub(crate) fn largest(&self, before: &[f64], after: &[f64], value: impl Fn(Range<usize>) -> f64) -> f64 {
        let mut largest = 0.0;
        let mut start = 0;
        for group in self.groups {
            let range = start..start + group.len;
            start = range.end;
            let scale = self.scale(group, range.clone(), before, after);
            let value = value(range);
            if value != 0.0 || !scale.is_finite() {
                let relative = if scale.is_finite() { value / scale } else { f64::NAN };
                // Not `f64::max`, which would drop a NaN.
                largest = if relative <= largest { largest } else { relative };
                if largest.is_nan() {
                    return largest;
                }
            }
        }
        largest
    }

    fn scale(&self, group: &Group, range: Range<usize>, before: &[f64], after: &[f64]) -> f64 {
        let larger = |r: Range<usize>| {
            let (a, b) = (norm(&before[r.clone()]), norm(&after[r]));
            if a >= b { a } else { b }
        };
        match group.name {
            "q" => 1.0,
            "x" => larger(range) + self.range_of("phi").map_or(0.0, larger),
            _ => larger(range),
        }
    }

    fn range_of(&self, name: &str) -> Option<Range<usize>> {
        let mut start = 0;
        for group in self.groups {
            if group.name == name {
                return Some(start..start + group.len);
            }
            start += group.len;
        }
        None
    }
}

/// Euclidean norm.
pub(crate) fn norm(components: &[f64]) -> f64 {
    Real::sqrt(sum_of_squares(components))
}

/// Sum of squares.
pub(crate) fn sum_of_squares(components: &[f64]) -> f64 {
    components.iter().map(|v| v * v).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    const GROUPS: &[Group] =
        &[Group { name: "x", len: 2 }, Group { name: "phi", len: 2 }, Group { name: "q", len: 1 }];

    fn error(before: [f64; 5], after: [f64; 5], error: [f64; 5]) -> f64 {
        ErrorNorm::new(GROUPS).largest(&before, &after, |r| norm(&error[r]))
    }

    #[test]
    fn each_group_has_its_scale() {
        let (before, after) = ([0.0, 0.0, 3.0, 4.0, 7.0], [0.0, 5.0, 0.0, 1.0, 9.0]);
        assert_eq!(error(before, after, [3.0, 4.0, 0.0, 0.0, 0.0]), 0.5, "|e| = 5 against |x| + |phi| = 10");
        assert_eq!(error(before, after, [0.0, 0.0, 0.0, 1.0, 0.0]), 0.2, "against |phi| = 5 before the step");
        assert_eq!(error(before, after, [0.0, 0.0, 0.0, 0.0, 0.25]), 0.25, "against 1");
        assert_eq!(error(before, after, [3.0, 4.0, 0.0, 1.0, 0.25]), 0.5, "the largest");
    }

    #[test]
    fn zero_and_not_finite_states() {
        assert_eq!(error([0.0; 5], [0.0; 5], [0.0; 5]), 0.0, "at rest at zero");
        assert_eq!(error([0.0; 5], [0.0; 5], [0.0, 0.0, 1.0, 0.0, 0.0]), f64::INFINITY);
        for bad in [f64::INFINITY, f64::NAN] {
            let after = [0.0, 0.0, bad, 0.0, 0.0];
            assert!(error([1.0; 5], after, [0.0; 5]).is_nan(), "a state that is {bad} has no error");
            assert!(error([1.0; 5], [1.0; 5], [bad, 0.0, 0.0, 0.0, 0.0]) >= f64::INFINITY || bad.is_nan());
        }
        assert!(error([1.0; 5], [1.0; 5], [f64::NAN, 0.0, 0.0, 0.0, 1.0]).is_nan(), "NaN is not dropped");
    }
}
