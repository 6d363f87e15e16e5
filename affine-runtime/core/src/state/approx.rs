//! Phase points that are nearly equal, number by number.

use approx::{AbsDiffEq, RelativeEq, UlpsEq};

use super::PhasePoint;
use crate::frames::Frame;
use crate::parts::{Basis, Translation};
use crate::state::Phase;

/// All numbers of two points are, as they stand: in the model's own frame, and in its bases.
fn all<const N: usize, F: Frame, C: Translation<N, f64>, B: Basis>(
    one: &PhasePoint<N, F, C, f64, B>,
    other: &PhasePoint<N, F, C, f64, B>,
    equal: impl Fn(f64, f64) -> bool,
) -> bool {
    let (mut numbers, mut filled) = ([0.0; 24], 0);
    one.entries(&mut |number| {
        numbers[filled] = number;
        filled += 1;
    });
    let (mut are_equal, mut place) = (true, 0);
    other.entries(&mut |number| {
        are_equal &= equal(numbers[place], number);
        place += 1;
    });
    are_equal
}

impl<const N: usize, F: Frame, C: Translation<N, f64>, B: Basis> AbsDiffEq for PhasePoint<N, F, C, f64, B> {
    type Epsilon = f64;
    fn default_epsilon() -> f64 {
        f64::default_epsilon()
    }
    fn abs_diff_eq(&self, other: &Self, epsilon: f64) -> bool {
        all(self, other, |a, b| a.abs_diff_eq(&b, epsilon))
    }
}

impl<const N: usize, F: Frame, C: Translation<N, f64>, B: Basis> RelativeEq for PhasePoint<N, F, C, f64, B> {
    fn default_max_relative() -> f64 {
        f64::default_max_relative()
    }
    fn relative_eq(&self, other: &Self, epsilon: f64, max_relative: f64) -> bool {
        all(self, other, |a, b| a.relative_eq(&b, epsilon, max_relative))
    }
}

impl<const N: usize, F: Frame, C: Translation<N, f64>, B: Basis> UlpsEq for PhasePoint<N, F, C, f64, B> {
    fn default_max_ulps() -> u32 {
        f64::default_max_ulps()
    }
    fn ulps_eq(&self, other: &Self, epsilon: f64, max_ulps: u32) -> bool {
        all(self, other, |a, b| a.ulps_eq(&b, epsilon, max_ulps))
    }
}
