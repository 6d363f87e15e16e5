//! The norm of errors of several bodies at once: lane by lane the numbers of [`ErrorNorm`], operation by operation.

use core::ops::Range;

use super::{ErrorNorm, GROUPS, IN_RANGE, Measure, PART_OF_DISPLACEMENT, scaled_norm};
use crate::lanes::Lanes;
use crate::model::Group;
use crate::scalar::Scalar;

/// [`ErrorNorm`] with inertias for each lane.
///
/// Its loops over lanes become vector instructions in a function that is compiled for them: all here is inlined into it,
/// and there are no closures, which are not.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NormInLanes<T> {
    layout: ErrorNorm,
    inertia: [T; GROUPS],
}

impl<T: Lanes> NormInLanes<T> {
    /// The norm for states that consist of `groups`, without inertias.
    pub(crate) fn new(groups: &'static [Group]) -> Self {
        Self { layout: ErrorNorm::new(groups), inertia: [T::zero(); GROUPS] }
    }

    /// Puts the norm of another body into a lane.
    pub(crate) fn set_lane(&mut self, lane: usize, norm: &ErrorNorm) {
        for (lanes, inertia) in self.inertia.iter_mut().zip(norm.inertia) {
            lanes.set_lane(lane, inertia);
        }
    }

    /// The groups.
    #[inline(always)]
    pub(crate) fn groups(&self) -> &'static [Group] {
        self.layout.groups
    }

    /// The larger of `largest` and of `value` over the scale of group `k` for steps of lengths `h`: a turn of the loop of
    /// [`ErrorNorm::largest`].
    #[inline(always)]
    pub(crate) fn larger(
        &self,
        largest: T,
        (k, range): (usize, Range<usize>),
        value: T,
        h: T,
        (before, after): (&[T], &[T]),
    ) -> T {
        let Some(group) = self.layout.groups.get(k) else { return largest };
        let measure = self.layout.measure(k, group);
        if measure == Measure::Nothing {
            return largest;
        }
        let (a, b) = match measure {
            Measure::One | Measure::Nothing => (T::one(), T::one()),
            Measure::Position => (self.extent(range.clone(), before), self.extent(range, after)),
            Measure::Size => (norm(before, range.clone()), norm(after, range)),
        };
        let inertia = self.inertia.get(k).copied().unwrap_or(T::zero());
        let mut larger = T::zero();
        for lane in 0..T::LANES {
            let (a, b, inertia) = (a.lane(lane), b.lane(lane), inertia.lane(lane));
            let floor = if inertia == 0.0 { 0.0 } else { PART_OF_DISPLACEMENT * inertia / h.lane(lane) };
            let scale = if a >= b { a } else { b };
            larger.set_lane(lane, relative(value.lane(lane), scale, floor, largest.lane(lane)));
        }
        larger
    }

    #[inline(always)]
    fn extent(&self, configuration: Range<usize>, y: &[T]) -> T {
        let own = norm(y, configuration.clone());
        match self.layout.phi {
            Some((start, end)) if start != configuration.start => own + norm(y, start..end),
            _ => own,
        }
    }
}

/// The larger of what was found so far and of `value` over its scale; NaN where one is.
#[inline(always)]
fn relative(value: f64, scale: f64, floor: f64, largest: f64) -> f64 {
    let no_error = value == 0.0 && scale.is_finite();
    let scale = if floor > scale { floor } else { scale };
    let relative = if scale.is_finite() { value / scale } else { f64::NAN };
    let larger = if relative <= largest { largest } else { relative };
    if no_error || largest.is_nan() { largest } else { larger }
}

/// Euclidean norms.
#[inline(always)]
fn norm<T: Lanes>(y: &[T], range: Range<usize>) -> T {
    let mut squares = T::zero();
    for component in &y[range.clone()] {
        squares += *component * *component;
    }
    let (mut norms, mut all_in_range) = (T::zero(), true);
    for lane in 0..T::LANES {
        let squares = squares.lane(lane);
        norms.set_lane(lane, Scalar::sqrt(squares));
        all_in_range &= IN_RANGE.contains(&squares);
    }
    if all_in_range { norms } else { scaled(&y[range], squares, norms) }
}

/// Norms whose squares leave the range in some lane.
#[cold]
#[inline(never)]
fn scaled<T: Lanes>(components: &[T], squares: T, norms: T) -> T {
    T::from_lanes(|lane| match IN_RANGE.contains(&squares.lane(lane)) {
        true => norms.lane(lane),
        false => scaled_norm(components.iter().map(|component| component.lane(lane))),
    })
}
