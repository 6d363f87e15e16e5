//! The norm of several errors at one state, for steps of any length.

use core::ops::Range;

use super::{ErrorNorm, GROUPS, Measure, PART_OF_DISPLACEMENT, norm};

/// Errors at one state over its own size: everything that the length of the step has no part in.
pub(crate) struct AtAState<const K: usize> {
    /// The largest relative errors of the groups without a floor.
    fixed: [f64; K],
    /// Momenta with their inertias and errors.
    momenta: [(f64, f64, [f64; K]); GROUPS],
    count: usize,
}

impl ErrorNorm {
    /// Several values at one state, whose own size is measured once.
    #[inline(always)]
    pub(crate) fn at_a_state<const K: usize>(
        &self,
        y: &[f64],
        values: impl Fn(Range<usize>) -> [f64; K],
    ) -> AtAState<K> {
        let mut errors = AtAState { fixed: [0.0; K], momenta: [(0.0, 0.0, [0.0; K]); GROUPS], count: 0 };
        let mut start = 0;
        for (k, group) in self.groups.iter().enumerate() {
            let range = start..start + group.len;
            start = range.end;
            let own = match self.measure(k, group) {
                Measure::Nothing => continue,
                Measure::One => 1.0,
                Measure::Position => self.extent(range.clone(), y),
                Measure::Size => norm(&y[range.clone()]),
            };
            let values = values(range);
            match (self.inertia.get(k), errors.momenta.get_mut(errors.count)) {
                (Some(inertia), Some(momentum)) if *inertia != 0.0 => {
                    *momentum = (own, *inertia, values);
                    errors.count += 1;
                }
                _ => enter(&mut errors.fixed, own, own, values),
            }
        }
        errors
    }
}

impl<const K: usize> AtAState<K> {
    /// [`ErrorNorm::largest`] of each value, for a step of length `h`.
    #[inline(always)]
    pub(crate) fn largest(&self, h: f64) -> [f64; K] {
        let mut largest = self.fixed;
        for (own, inertia, values) in &self.momenta[..self.count.min(GROUPS)] {
            let floor = PART_OF_DISPLACEMENT * inertia / h;
            enter(&mut largest, *own, if floor > *own { floor } else { *own }, *values);
        }
        largest
    }
}

/// Takes the errors of a group of size `own` into account, relative to `scale`.
#[inline(always)]
fn enter<const K: usize>(largest: &mut [f64; K], own: f64, scale: f64, values: [f64; K]) {
    for (largest, value) in largest.iter_mut().zip(values) {
        let relative = if value == 0.0 && own.is_finite() {
            0.0
        } else if scale.is_finite() {
            value / scale
        } else {
            f64::NAN
        };
        // A NaN is kept.
        *largest = if relative <= *largest || largest.is_nan() { *largest } else { relative };
    }
}
