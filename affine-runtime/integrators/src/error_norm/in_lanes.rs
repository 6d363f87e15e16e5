//! The norm of errors of several bodies at once: lane by lane the numbers of [`ErrorNorm`], operation by operation.

use core::ops::Range;

use pulp::Simd;

use super::{ErrorNorm, GROUPS, Measure, PART_OF_DISPLACEMENT};
use crate::lanes::Lanes;
use crate::lanes::equations::Equations;
use crate::lanes::parts::{part, parts, set_part};
use affine_core::__private::numerics::{IN_RANGE, scaled_norm};
use affine_core::model::{Group, StateVector};

/// [`ErrorNorm`] with inertias for each lane.
///
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

    /// The norm with the inertias at `(t, y)`, where `f(t, y) = slope`: [`ErrorNorm::probed`].
    #[inline(always)]
    pub(crate) fn probed<V: Simd, S: StateVector<T>, F: Equations<T, S>>(
        simd: V,
        f: &F,
        (t, y, slope): (T, &S, &S),
    ) -> Self {
        let mut probed = Self::new(F::GROUPS);
        let (mut changed, mut rates) = (*y, S::zeros());
        for (g, group) in F::GROUPS.iter().enumerate().take(GROUPS) {
            let Some(moved) = probed.layout.moved_by(group) else { continue };
            let own = probed.layout.range(g);
            let mut change = norm(simd, y.as_ref(), own.clone());
            for size in change.as_mut_slice() {
                *size = if *size > 0.0 { *size } else { 1.0 };
            }
            let mut response = T::zero();
            for component in own {
                changed.as_mut()[component] += change;
                f.slope(t, &changed, &mut rates);
                changed.as_mut()[component] = y.as_ref()[component];
                let mut squares = T::zero();
                for i in moved.clone() {
                    let difference = rates.as_ref()[i] - slope.as_ref()[i];
                    squares += difference * difference;
                }
                for (response, found) in response.as_mut_slice().iter_mut().zip(squares.sqrt().as_slice()) {
                    *response = if *found <= *response { *response } else { *found };
                }
            }
            let mut inertia = change * probed.extent(simd, moved, y.as_ref()) / response;
            for inertia in inertia.as_mut_slice() {
                *inertia = if inertia.is_finite() { *inertia } else { 0.0 };
            }
            probed.inertia[g] = inertia;
        }
        probed
    }

    /// The norm of the body in a lane.
    pub(crate) fn lane(&self, lane: usize) -> ErrorNorm {
        ErrorNorm { inertia: self.inertia.each_ref().map(|inertia| inertia.lane(lane)), ..self.layout }
    }

    /// The largest size, over the scales of the groups, of what moves a state at the rates `change` to `end`.
    #[inline(always)]
    pub(crate) fn rate<V: Simd, S: StateVector<T>>(&self, simd: V, change: &S, y: &S, end: &S) -> T {
        let (mut measured, mut start) = ([Measured::nothing(); GROUPS], 0);
        for (own, group) in measured.iter_mut().zip(self.layout.groups) {
            let range = start..start + group.len;
            start = range.end;
            own.value = norm(simd, change.as_ref(), range.clone());
            own.sizes = [norm(simd, y.as_ref(), range.clone()), norm(simd, end.as_ref(), range)];
        }
        self.largest(simd, T::constant(f64::INFINITY, 0.0), self.layout.groups, &measured)
    }

    /// Puts the norm of another body into a lane.
    pub(crate) fn set_lane(&mut self, lane: usize, norm: &ErrorNorm) {
        for (lanes, inertia) in self.inertia.iter_mut().zip(norm.inertia) {
            lanes.set_lane(lane, inertia);
        }
    }

    /// The largest value over the scale of its group, for steps of lengths `h`: [`ErrorNorm::largest`].
    #[inline(always)]
    pub(crate) fn largest<V: Simd>(
        &self,
        simd: V,
        h: T,
        groups: &'static [Group],
        measured: &[Measured<T>; GROUPS],
    ) -> T {
        let mut largest = T::zero();
        for (g, group) in groups.iter().enumerate().take(GROUPS) {
            let [a, b] = match Measure::of(group) {
                Measure::Nothing => continue,
                Measure::One => [T::one(); 2],
                Measure::Position => extents(groups, g, measured),
                Measure::Size => measured[g].sizes,
            };
            for k in 0..parts::<V, T>() {
                let (a, b) = (part(simd, &a, k), part(simd, &b, k));
                let inertia = part(simd, &self.inertia[g], k);
                let floor = simd.mul_f64s(simd.splat_f64s(PART_OF_DISPLACEMENT), inertia);
                let floor = simd.div_f64s(floor, part(simd, &h, k));
                let zero = simd.splat_f64s(0.0);
                let floor = simd.select_f64s(simd.equal_f64s(inertia, zero), zero, floor);
                let size = simd.select_f64s(simd.greater_than_or_equal_f64s(a, b), a, b);
                let value = part(simd, &measured[g].value, k);
                let larger = relative(simd, (value, size, floor), part(simd, &largest, k));
                set_part(simd, &mut largest, k, larger);
            }
        }
        largest
    }

    #[inline(always)]
    fn extent<V: Simd>(&self, simd: V, configuration: Range<usize>, y: &[T]) -> T {
        let own = norm(simd, y, configuration.clone());
        match self.layout.phi {
            Some((start, end)) if start != configuration.start => own + norm(simd, y, start..end),
            _ => own,
        }
    }
}

/// A group of the states before and after a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Measured<T> {
    /// The size of an error over the length of the step, or of a rate, in this group.
    pub(crate) value: T,
    /// Norms of the group before and after.
    pub(crate) sizes: [T; 2],
}

impl<T: Lanes> Measured<T> {
    #[inline(always)]
    pub(crate) fn nothing() -> Self {
        Self { value: T::zero(), sizes: [T::zero(); 2] }
    }
}

/// Sizes of a position with that of the placement, if there is one.
#[inline(always)]
fn extents<T: Lanes>(groups: &[Group], position: usize, measured: &[Measured<T>; GROUPS]) -> [T; 2] {
    let mut sizes = measured[position].sizes;
    for (group, placement) in groups.iter().zip(measured) {
        if group.quantity.is_placement() {
            for (size, of_placement) in sizes.iter_mut().zip(placement.sizes) {
                *size += of_placement;
            }
            break;
        }
    }
    sizes
}

/// Errors of a group are measured against a size: its own, or with that of the placement.
#[inline(always)]
pub(crate) fn has_size(group: &Group) -> bool {
    matches!(Measure::of(group), Measure::Size | Measure::Position)
}

/// Norms of the groups of a state before and after a step, where the squares of one of them leave the range of numbers.
#[cold]
#[inline(never)]
pub(crate) fn measure_again<V: Simd, T: Lanes>(
    simd: V,
    groups: &[Group],
    [before, after]: [&[T]; 2],
    measured: &mut [Measured<T>; GROUPS],
) {
    let mut start = 0;
    for (own, group) in measured.iter_mut().zip(groups) {
        let range = start..start + group.len;
        start = range.end;
        own.sizes = [norm(simd, before, range.clone()), norm(simd, after, range)];
    }
}

/// The larger of what was found so far and of a value over its scale, a size or a floor; NaN where one is.
#[inline(always)]
fn relative<V: Simd>(
    simd: V,
    (value, size, floor): (V::f64s, V::f64s, V::f64s),
    largest: V::f64s,
) -> V::f64s {
    let is_finite = |number| simd.less_than_or_equal_f64s(simd.abs_f64s(number), simd.splat_f64s(f64::MAX));
    let no_error = simd.and_m64s(simd.equal_f64s(value, simd.splat_f64s(0.0)), is_finite(size));
    let scale = simd.select_f64s(simd.greater_than_f64s(floor, size), floor, size);
    let relative = simd.div_f64s(value, scale);
    let relative = simd.select_f64s(is_finite(scale), relative, simd.splat_f64s(f64::NAN));
    let larger = simd.select_f64s(simd.less_than_or_equal_f64s(relative, largest), largest, relative);
    let larger = simd.select_f64s(simd.equal_f64s(largest, largest), larger, largest);
    simd.select_f64s(no_error, largest, larger)
}

/// Sums of squares of the components of several states, in the order of [`sum_of_squares`](super::sum_of_squares): first of
/// whole fours, then of the rest. No closures: those are not made part of the function that is compiled for the processor's
/// vectors.
pub(crate) struct Squares<V: Simd, const K: usize>([[V::f64s; K]; 4]);

impl<V: Simd, const K: usize> Squares<V, K> {
    #[inline(always)]
    pub(crate) fn new(simd: V) -> Self {
        Self([[simd.splat_f64s(0.0); K]; 4])
    }

    /// Adds one of four components of each state. Which one is known where this is compiled, so that sums stay in registers.
    #[inline(always)]
    pub(crate) fn add(&mut self, simd: V, of_four: usize, components: [V::f64s; K]) {
        self.0[of_four] = with_squares(simd, self.0[of_four], components);
    }

    /// The sums over the fours.
    #[inline(always)]
    pub(crate) fn sums(self, simd: V) -> [V::f64s; K] {
        let [a, b, c, d] = self.0;
        let mut sums = a;
        for k in 0..K {
            sums[k] = simd.add_f64s(simd.add_f64s(a[k], c[k]), simd.add_f64s(b[k], d[k]));
        }
        sums
    }
}

/// Sums with the square of one more component of each state.
#[inline(always)]
pub(crate) fn with_squares<V: Simd, const K: usize>(
    simd: V,
    mut sums: [V::f64s; K],
    components: [V::f64s; K],
) -> [V::f64s; K] {
    for k in 0..K {
        sums[k] = simd.add_f64s(sums[k], simd.mul_f64s(components[k], components[k]));
    }
    sums
}

/// Where squares are in the range in which they are summed as they are.
#[inline(always)]
pub(crate) fn are_in_range<V: Simd>(simd: V, squares: V::f64s) -> V::m64s {
    let above = simd.greater_than_or_equal_f64s(squares, simd.splat_f64s(*IN_RANGE.start()));
    simd.and_m64s(above, simd.less_than_or_equal_f64s(squares, simd.splat_f64s(*IN_RANGE.end())))
}

/// Euclidean norms.
#[inline(always)]
fn norm<V: Simd, T: Lanes>(simd: V, y: &[T], range: Range<usize>) -> T {
    let (mut squares, mut norms, mut doubt) = (T::zero(), T::zero(), simd.splat_f64s(0.0));
    let (fours, rest) = y[range.clone()].as_chunks::<4>();
    for k in 0..parts::<V, T>() {
        let mut squared = Squares::<V, 1>::new(simd);
        for four in fours {
            for (i, component) in four.iter().enumerate() {
                squared.add(simd, i, [part(simd, component, k)]);
            }
        }
        let mut sums = squared.sums(simd);
        for component in rest {
            sums = with_squares(simd, sums, [part(simd, component, k)]);
        }
        let [sum] = sums;
        doubt = simd.select_f64s(are_in_range(simd, sum), doubt, simd.splat_f64s(1.0));
        set_part(simd, &mut squares, k, sum);
        set_part(simd, &mut norms, k, simd.sqrt_f64s(sum));
    }
    if simd.reduce_max_f64s(doubt) == 0.0 { norms } else { scaled(&y[range], squares, norms) }
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
