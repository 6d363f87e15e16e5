//! What a step is judged by: numbers, whatever is integrated. It is compiled once for each pair of methods, and not again for
//! every model and for the vectors of every processor.

use crate::error_norm::ErrorNorm;
use crate::widest::{Work, widest};
use affine_core::__private::Vectors;
use affine_core::__private::numerics::{IN_RANGE, larger, sum_of_squares};
use affine_core::scalar::Scalar;

/// An attempted step.
#[derive(Clone, Copy, Debug)]
pub struct Judged<'s> {
    pub(super) error_norm: &'s ErrorNorm,
    /// The time in which what an error of a momentum moves counts.
    pub(super) lasting: f64,
    /// Where it begins and ends.
    pub(super) states: [&'s [f64]; 2],
    /// Differences, divided by the length, of the solution to the embedded ones.
    pub(super) slopes: [&'s [f64]; 2],
}

impl Judged<'_> {
    /// The largest error of a group of components, divided by the length of the step.
    #[inline(always)]
    pub(super) fn largest(&self, error: impl Fn((f64, f64)) -> f64) -> f64 {
        widest(Largest { judged: self, error })
    }
}

/// Sums of squares on the vectors of a processor.
struct Largest<'j, 's, F> {
    judged: &'j Judged<'s>,
    error: F,
}

impl<F: Fn((f64, f64)) -> f64> Work for Largest<'_, '_, F> {
    type Output = f64;
    #[inline(always)]
    fn run(self, _: impl Vectors) -> f64 {
        let Self { judged: &Judged { error_norm, lasting, states: [before, after], slopes }, error } = self;
        error_norm.largest(lasting, before, after, |range| {
            let slopes = slopes.map(|slopes| &slopes[range.clone()]);
            let squares = (sum_of_squares(slopes[0]), sum_of_squares(slopes[1]));
            if IN_RANGE.contains(&squares.0) { error(squares) } else { scaled_error(slopes, &error) }
        })
    }
}

/// The error estimate of a group whose squares leave the range of numbers; NaN where one of its components is.
#[cold]
fn scaled_error(slopes: [&[f64]; 2], error: &impl Fn((f64, f64)) -> f64) -> f64 {
    let largest = slopes.into_iter().flatten().map(|v| Scalar::abs(*v)).fold(0.0, larger);
    if largest == 0.0 || !largest.is_finite() {
        return largest;
    }
    let squares = slopes.map(|slopes| slopes.iter().map(|v| (v / largest) * (v / largest)).sum());
    largest * error((squares[0], squares[1]))
}
