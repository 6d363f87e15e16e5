//! The norm of errors of several bodies at once: lane by lane the numbers of [`ErrorNorm`], operation by operation.

use core::ops::Range;

use super::{ErrorNorm, GROUPS, Measure, PART_OF_DISPLACEMENT};
use crate::lanes::Lanes;
use crate::model::{Group, StateVector};

/// [`ErrorNorm`] with inertias for each lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NormInLanes<T> {
    layout: ErrorNorm,
    inertia: [T; GROUPS],
}

impl<T: Lanes> NormInLanes<T> {
    /// The norm with the inertias at `(t, y)`, where `f(t, y) = slope`.
    pub(crate) fn probed<S: StateVector<T>>(
        groups: &'static [Group],
        f: &impl Fn(T, &S) -> S,
        (t, y, slope): (T, &S, &S),
    ) -> Self {
        let layout = ErrorNorm::new(groups);
        let mut probed = Self { layout, inertia: [T::zero(); GROUPS] };
        for (k, group) in groups.iter().enumerate().take(GROUPS) {
            let Some(moved) = layout.moved_by(group) else { continue };
            let own = layout.range(k);
            let size = norm(&y.as_ref()[own.clone()]);
            let change = each::<T>(|lane| if size.lane(lane) > 0.0 { size.lane(lane) } else { 1.0 });
            let mut response = T::zero();
            for component in own {
                let mut changed = *y;
                changed.as_mut()[component] += change;
                let changed = f(t, &changed);
                let mut squares = T::zero();
                for i in moved.clone() {
                    let difference = changed.as_ref()[i] - slope.as_ref()[i];
                    squares += difference * difference;
                }
                let of_component = squares.sqrt();
                response = larger(of_component, response);
            }
            let inertia = change * probed.extent(moved, y.as_ref()) / response;
            probed.inertia[k] =
                each(|lane| if inertia.lane(lane).is_finite() { inertia.lane(lane) } else { 0.0 });
        }
        probed
    }

    /// [`ErrorNorm::largest`], lane by lane.
    #[inline(always)]
    pub(crate) fn largest(&self, h: T, before: &[T], after: &[T], value: impl Fn(Range<usize>) -> T) -> T {
        let mut largest = T::zero();
        let mut start = 0;
        for (k, group) in self.layout.groups.iter().enumerate() {
            let range = start..start + group.len;
            start = range.end;
            let measure = self.layout.measure(k, group);
            if measure == Measure::Nothing {
                continue;
            }
            let inertia = self.inertia.get(k).copied().unwrap_or(T::zero());
            let floor = T::constant(PART_OF_DISPLACEMENT, 0.0) * inertia / h;
            let scale = self.scale(measure, range.clone(), before, after);
            let value = value(range);
            largest = each(|lane| {
                relative(value.lane(lane), scale.lane(lane), floor.lane(lane), largest.lane(lane))
            });
        }
        largest
    }

    #[inline(always)]
    fn scale(&self, measure: Measure, range: Range<usize>, before: &[T], after: &[T]) -> T {
        let (a, b) = match measure {
            Measure::One => return T::one(),
            Measure::Position => (self.extent(range.clone(), before), self.extent(range, after)),
            Measure::Size | Measure::Nothing => (norm(&before[range.clone()]), norm(&after[range])),
        };
        each(|lane| if a.lane(lane) >= b.lane(lane) { a.lane(lane) } else { b.lane(lane) })
    }

    #[inline(always)]
    fn extent(&self, configuration: Range<usize>, y: &[T]) -> T {
        let own = norm(&y[configuration.clone()]);
        match self.layout.phi {
            Some((start, end)) if start != configuration.start => own + norm(&y[start..end]),
            _ => own,
        }
    }
}

/// The larger of what was found so far and of `value` over its scale; NaN where one is.
#[inline(always)]
fn relative(value: f64, scale: f64, floor: f64, largest: f64) -> f64 {
    if (value == 0.0 && scale.is_finite()) || largest.is_nan() {
        return largest;
    }
    let scale = if floor > scale { floor } else { scale };
    let relative = if scale.is_finite() { value / scale } else { f64::NAN };
    if relative <= largest { largest } else { relative }
}

/// `a` unless `b` is at least as large.
fn larger<T: Lanes>(a: T, b: T) -> T {
    each(|lane| if a.lane(lane) <= b.lane(lane) { b.lane(lane) } else { a.lane(lane) })
}

#[inline(always)]
fn each<T: Lanes>(lane: impl FnMut(usize) -> f64) -> T {
    T::from_lanes(lane)
}

/// Euclidean norm.
#[inline(always)]
pub(crate) fn norm<T: Lanes>(components: &[T]) -> T {
    sum_of_squares(components).sqrt()
}

/// Sum of squares.
#[inline(always)]
pub(crate) fn sum_of_squares<T: Lanes>(components: &[T]) -> T {
    let mut sum = T::zero();
    for component in components {
        sum += *component * *component;
    }
    sum
}
