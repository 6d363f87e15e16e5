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
        let forever = T::constant(f64::INFINITY, 0.0);
        let (mut largest, mut start) = (T::zero(), 0);
        for (g, group) in self.layout.groups.iter().enumerate() {
            let range = start..start + group.len;
            start = range.end;
            let value = norm(simd, change.as_ref(), range.clone());
            let states = (forever, y.as_ref(), end.as_ref());
            largest = self.larger(simd, largest, (g, group, range), value, states);
        }
        largest
    }

    /// Puts the norm of another body into a lane.
    pub(crate) fn set_lane(&mut self, lane: usize, norm: &ErrorNorm) {
        for (lanes, inertia) in self.inertia.iter_mut().zip(norm.inertia) {
            lanes.set_lane(lane, inertia);
        }
    }

    /// The larger of `largest` and of `value` over the scale of group `g` for steps of lengths `h`: a turn of the loop of
    /// [`ErrorNorm::largest`].
    #[inline(always)]
    pub(crate) fn larger<V: Simd>(
        &self,
        simd: V,
        mut largest: T,
        (g, group, range): (usize, &Group, Range<usize>),
        value: T,
        (h, before, after): (T, &[T], &[T]),
    ) -> T {
        let (a, b) = match self.layout.measure(g, group) {
            Measure::Nothing => return largest,
            Measure::One => (T::one(), T::one()),
            Measure::Position => (self.extent(simd, range.clone(), before), self.extent(simd, range, after)),
            Measure::Size => (norm(simd, before, range.clone()), norm(simd, after, range)),
        };
        let inertia = self.inertia.get(g).copied().unwrap_or(T::zero());
        for k in 0..parts::<V, T>() {
            let (a, b, inertia) = (part(simd, &a, k), part(simd, &b, k), part(simd, &inertia, k));
            let floor = simd.mul_f64s(simd.splat_f64s(PART_OF_DISPLACEMENT), inertia);
            let floor = simd.div_f64s(floor, part(simd, &h, k));
            let zero = simd.splat_f64s(0.0);
            let floor = simd.select_f64s(simd.equal_f64s(inertia, zero), zero, floor);
            let size = simd.select_f64s(simd.greater_than_or_equal_f64s(a, b), a, b);
            let larger = relative(simd, (part(simd, &value, k), size, floor), part(simd, &largest, k));
            set_part(simd, &mut largest, k, larger);
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

/// Sums of squares of the components of several states, in the order of [`sum_of_squares`](super::sum_of_squares). No
/// closures: those are not made part of the function that is compiled for the processor's vectors.
pub(crate) struct Squares<V: Simd, const K: usize> {
    /// Components that are summed by fours.
    whole: usize,
    fours: [[V::f64s; K]; 4],
    rest: [[V::f64s; K]; 3],
}

impl<V: Simd, const K: usize> Squares<V, K> {
    /// Of so many components.
    #[inline(always)]
    pub(crate) fn new(simd: V, len: usize) -> Self {
        let zero = [simd.splat_f64s(0.0); K];
        Self { whole: len - len % 4, fours: [zero; 4], rest: [zero; 3] }
    }

    /// Adds component `i` of each state.
    #[inline(always)]
    pub(crate) fn add(&mut self, simd: V, i: usize, components: [V::f64s; K]) {
        let sums = if i < self.whole { &mut self.fours[i % 4] } else { &mut self.rest[i - self.whole] };
        for k in 0..K {
            sums[k] = simd.add_f64s(sums[k], simd.mul_f64s(components[k], components[k]));
        }
    }

    /// The sums.
    #[inline(always)]
    pub(crate) fn sums(self, simd: V) -> [V::f64s; K] {
        let [a, b, c, d] = self.fours;
        let mut sums = a;
        for k in 0..K {
            sums[k] = simd.add_f64s(simd.add_f64s(a[k], c[k]), simd.add_f64s(b[k], d[k]));
            for rest in &self.rest {
                sums[k] = simd.add_f64s(sums[k], rest[k]);
            }
        }
        sums
    }
}

/// Euclidean norms.
#[inline(always)]
fn norm<V: Simd, T: Lanes>(simd: V, y: &[T], range: Range<usize>) -> T {
    let (mut squares, mut norms, mut doubt) = (T::zero(), T::zero(), simd.splat_f64s(0.0));
    for k in 0..parts::<V, T>() {
        let components = &y[range.clone()];
        let mut squared = Squares::<V, 1>::new(simd, components.len());
        for (i, component) in components.iter().enumerate() {
            squared.add(simd, i, [part(simd, component, k)]);
        }
        let [sum] = squared.sums(simd);
        let (least, most) = (simd.splat_f64s(*IN_RANGE.start()), simd.splat_f64s(*IN_RANGE.end()));
        let above = simd.greater_than_or_equal_f64s(sum, least);
        let in_range = simd.and_m64s(above, simd.less_than_or_equal_f64s(sum, most));
        doubt = simd.select_f64s(in_range, doubt, simd.splat_f64s(1.0));
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
