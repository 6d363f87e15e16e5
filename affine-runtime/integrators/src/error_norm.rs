//! The norm in which integrators measure errors.

#[cfg(feature = "std")]
mod in_lanes;
mod longest;

#[cfg(feature = "std")]
pub(crate) use in_lanes::{
    Measured, NormInLanes, Squares, are_in_range, has_size, measure_again, with_squares,
};

use core::ops::Range;

use affine_core::__private::numerics::{larger, norm, square};
use affine_core::model::{Group, Quantity, StateVector};
use affine_core::scalar::Scalar;

/// A state vector has at most so many groups with a floor of their own.
pub(crate) const GROUPS: usize = 8;
/// An error of a momentum is tolerated that moves the placement, over one step, by this part of what the
/// placement's own error may be. Ten times less than the balance, for what adds up over an oscillation.
const PART_OF_DISPLACEMENT: f64 = 0.1;

/// Largest relative error of the geometric objects in a state vector.
///
/// `max over groups g of |e_g| / s_g`, `|.|` the Frobenius norm and `s_g` the larger of `|g|` before and after the
/// step, so that neither rotations of space nor units change it. Some groups have a scale of their own:
///
/// * `x`, a position, is measured against `|x| + |phi|`: it may start at zero, its origin is arbitrary, and under
///   affine maps of space it transforms as the columns of `phi` do;
/// * `q`, logarithms of stretches, is measured against 1: an error of `q` is a relative error of `exp q`;
/// * momenta, all groups but these and `phi`, are measured against `|g|` or `0.1 mu_g/h`, whichever is larger,
///   where `mu_g/h` is the momentum that moves the placement by its own size within a step of length `h`, or one of those before,
///   if these were longer. Without that, a body that vibrates by `1e-9` would need its momentum to digits that the forces do not
///   have, and one at rest would take ever shorter steps. By shorter steps alone a body would leave a wall with any momentum.
///
/// `work`, which nothing depends on, is not measured: it is an integral over velocities, and about as good as these. Stiff friction makes
/// them small beside forces, and what it takes is then known less well than the placement.
///
/// The inertia `mu_g` is found at the start from the equations themselves, as the least `|dg| |phi|/|d phi'|`
/// over single components of `g` (with `x` in place of `phi` for the groups `p` and `p_hat`).
///
/// Groups between about 1e-150 and 1e150 in norm: sums of squares of errors are formed without scaling.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorNorm {
    groups: &'static [Group],
    /// Where `phi` is, if anywhere.
    phi: Option<(usize, usize)>,
    inertia: [f64; GROUPS],
    /// By name, once and for all steps.
    measures: [Measure; GROUPS],
}

/// What a group is measured against.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Measure {
    /// The size of the group.
    Size,
    /// The size of the group, and that of the placement.
    Position,
    /// Against 1.
    One,
    /// The group is not measured.
    Nothing,
}

impl Measure {
    fn of(group: &Group) -> Self {
        match group.quantity {
            Quantity::MeanLogStretch | Quantity::LogStretches => Self::One,
            Quantity::Position => Self::Position,
            Quantity::Work => Self::Nothing,
            _ => Self::Size,
        }
    }
}

impl ErrorNorm {
    /// The norm for a state vector that consists of `groups`, one after the other, without inertias.
    #[must_use]
    pub fn new(groups: &'static [Group]) -> Self {
        let mut measures = [Measure::Size; GROUPS];
        for (measure, group) in measures.iter_mut().zip(groups) {
            *measure = Measure::of(group);
        }
        let unplaced = Self { groups, phi: None, inertia: [0.0; GROUPS], measures };
        Self { phi: unplaced.placement().map(|range| (range.start, range.end)), ..unplaced }
    }

    /// The norm with the inertias at `(t, y)`, where `f(t, y) = slope`; and the number of evaluations that took,
    /// one for each component of a momentum.
    #[doc(hidden)]
    pub fn probed<S: StateVector<f64>>(
        groups: &'static [Group],
        f: &dyn Fn(f64, &S) -> S,
        (t, y, slope): (f64, &S, &S),
    ) -> (Self, u64) {
        let mut probed = Self::new(groups);
        let mut evaluations = 0;
        for (k, group) in groups.iter().enumerate().take(GROUPS) {
            let Some(moved) = probed.moved_by(group) else { continue };
            let own = probed.range(k);
            let size = size(&y.as_ref()[own.clone()]);
            // Any change will do where the group is zero: the equations are linear in momenta, or nearly so.
            let change = if size > 0.0 { size } else { 1.0 };
            let mut response = 0.0;
            for component in own {
                let mut changed = *y;
                changed.as_mut()[component] += change;
                let changed = f(t, &changed);
                evaluations += 1;
                let of_component = distance(&changed.as_ref()[moved.clone()], &slope.as_ref()[moved.clone()]);
                response = if of_component <= response { response } else { of_component };
            }
            let inertia = change * probed.reach(moved, y.as_ref()) / response;
            probed.inertia[k] = if inertia.is_finite() { inertia } else { 0.0 };
        }
        (probed, evaluations)
    }

    /// The largest size of a value in a group over that of the state there. As all that is asked once a run, a function of
    /// components of any number, compiled for none of them again.
    #[inline(never)]
    pub(crate) fn over_size(&self, state: &[f64], value: &[f64]) -> f64 {
        self.largest(f64::INFINITY, state, state, |range| norm(&value[range]))
    }

    /// The same over the larger sizes of two states.
    #[inline(never)]
    pub(crate) fn over_sizes(&self, [before, after]: [&[f64]; 2], value: &[f64]) -> f64 {
        self.largest(f64::INFINITY, before, after, |range| norm(&value[range]))
    }

    /// The largest rate at which a group changes by its size, where a momentum may be zero: what changes it moves the
    /// placement by its own size in `sqrt(mu_g/|g'|)`. Infinite where something else is zero and moves.
    #[cold]
    #[inline(never)]
    pub(crate) fn rate_from_rest(&self, state: &[f64], slope: &[f64]) -> f64 {
        let mut fastest = 0.0;
        let mut start = 0;
        for (k, group) in self.groups.iter().enumerate() {
            let range = start..start + group.len;
            start = range.end;
            let (measure, value) = (self.measure(k, group), norm(&slope[range.clone()]));
            if measure == Measure::Nothing || value == 0.0 {
                continue;
            }
            let size = self.scale(measure, range, state, state);
            let inertia = self.inertia.get(k).copied().unwrap_or(0.0);
            let rate = if size > 0.0 { value / size } else { Scalar::sqrt(value / inertia) };
            fastest = larger(fastest, rate);
        }
        fastest
    }

    /// [`ErrorNorm::extent`].
    #[inline(never)]
    fn reach(&self, configuration: Range<usize>, y: &[f64]) -> f64 {
        self.extent(configuration, y)
    }

    /// The norm without `1/D`, where that is computed anew from the placement.
    pub(crate) fn without_carried(mut self) -> Self {
        for (measure, group) in self.measures.iter_mut().zip(self.groups) {
            if group.quantity == Quantity::InverseDilatation {
                *measure = Measure::Nothing;
            }
        }
        self
    }

    /// The size of a value of the work, which the norm does not measure, over that of the work or of twice the kinetic energy,
    /// `sum |g| |phi'|`, whichever is larger. The momentum is at least the error that the tolerance allows it in a time: forces that
    /// begin as a power of `t` have done no work where a body rests, and its first terms are no part of any. Zero where there is
    /// neither.
    #[inline(never)]
    pub(crate) fn over_energy(
        &self,
        [before, after]: [&[f64]; 2],
        slope: &[f64],
        value: &[f64],
        (tolerance, h): (f64, f64),
    ) -> f64 {
        let Some(work) = self.range_of(Quantity::Work) else { return 0.0 };
        let energies = self.groups.iter().enumerate().filter_map(|(k, group)| {
            let moved = self.moved_by(group)?;
            let least = PART_OF_DISPLACEMENT * self.extent(moved.clone(), after) / h;
            Some(norm(&after[self.range(k)]) * norm(&slope[moved]) + tolerance * self.floor(k, h) * least)
        });
        let done = larger(norm(&before[work.clone()]), norm(&after[work.clone()]));
        let scale = larger(energies.sum(), done);
        if scale == 0.0 { 0.0 } else { norm(&value[work]) / scale }
    }

    /// How large components of a state in some coordinates are, by their groups; of a momentum that is zero, what moves the placement
    /// by a tenth of itself in a step of length `h`. Coordinates of a placement that are zero are those of a chart, without a unit.
    pub(crate) fn extents<S: StateVector<f64>>(&self, h: f64, state: &S, coordinates: &S) -> S {
        let (mut extents, mut start) = (S::zeros(), 0);
        for (k, group) in self.groups.iter().enumerate() {
            let range = start..start + group.len;
            start = range.end;
            let is_chart = group.quantity.is_placement() && norm(&coordinates.as_ref()[range.clone()]) == 0.0;
            let size = self.scale(self.measure(k, group), range.clone(), state.as_ref(), state.as_ref());
            let own = if is_chart { 1.0 } else { size };
            extents.as_mut()[range].fill(if own > 0.0 { own } else { self.floor(k, h) });
        }
        extents
    }

    /// The groups that the norm measures, one after the other.
    pub(crate) fn groups(&self) -> &'static [Group] {
        self.groups
    }

    /// The norm without the groups after so many components.
    pub(crate) fn of_the_first(self, components: usize) -> Self {
        let mut end = 0;
        let within = self.groups.iter().take_while(|group| {
            end += group.len;
            end <= components
        });
        Self { groups: &self.groups[..within.count()], ..self }
    }

    /// `max_g value(range of g) / s_g` where errors of momenta last for the time `h`; zero where `value` is, and NaN where a scale
    /// is not finite.
    #[inline(always)]
    #[doc(hidden)]
    pub fn largest(&self, h: f64, before: &[f64], after: &[f64], value: impl Fn(Range<usize>) -> f64) -> f64 {
        self.largest_within(h, &[f64::INFINITY; GROUPS], before, after, value)
    }

    /// What errors of momenta may be because of what they move in a time.
    pub(crate) fn floors(&self, h: f64) -> [f64; GROUPS] {
        core::array::from_fn(|k| self.floor(k, h))
    }

    /// The same, where what an error of a momentum may be is at most a bound of its group: in a short step any momentum moves
    /// the placement by little, and one that is larger than the body has had cannot be meant.
    #[inline(always)]
    pub(crate) fn largest_within(
        &self,
        h: f64,
        bounds: &[f64; GROUPS],
        before: &[f64],
        after: &[f64],
        value: impl Fn(Range<usize>) -> f64,
    ) -> f64 {
        let mut largest = 0.0;
        let mut start = 0;
        for (k, group) in self.groups.iter().enumerate() {
            let range = start..start + group.len;
            start = range.end;
            let measure = self.measure(k, group);
            if measure == Measure::Nothing {
                continue;
            }
            let (floor, bound) = (self.floor(k, h), bounds.get(k).copied().unwrap_or(f64::INFINITY));
            let floor = if floor < bound { floor } else { bound };
            let scale = self.scale(measure, range.clone(), before, after);
            let value = value(range);
            if value != 0.0 || !scale.is_finite() {
                let scale = if floor > scale { floor } else { scale };
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

    /// What an error of a momentum may be because of what it moves in a time `h`.
    #[inline(always)]
    fn floor(&self, k: usize, h: f64) -> f64 {
        match self.inertia.get(k) {
            Some(inertia) if *inertia != 0.0 => PART_OF_DISPLACEMENT * inertia / h,
            _ => 0.0,
        }
    }

    #[inline(always)]
    fn measure(&self, k: usize, group: &Group) -> Measure {
        self.measures.get(k).copied().unwrap_or_else(|| Measure::of(group))
    }

    #[inline(always)]
    fn scale(&self, measure: Measure, range: Range<usize>, before: &[f64], after: &[f64]) -> f64 {
        let (a, b) = match measure {
            Measure::One | Measure::Nothing => return 1.0,
            Measure::Position => (self.extent(range.clone(), before), self.extent(range, after)),
            Measure::Size => (norm(&before[range.clone()]), norm(&after[range])),
        };
        // A NaN is kept.
        if a >= b { a } else { b }
    }

    /// Size of the placement, and of the position with it where that is asked for.
    #[inline(always)]
    fn extent(&self, configuration: Range<usize>, y: &[f64]) -> f64 {
        let own = norm(&y[configuration.clone()]);
        match self.phi {
            Some((start, end)) if start != configuration.start => own + norm(&y[start..end]),
            _ => own,
        }
    }

    /// Components of the configuration that a momentum moves; `None` for what is no momentum.
    fn moved_by(&self, group: &Group) -> Option<Range<usize>> {
        match group.quantity {
            Quantity::Position
            | Quantity::Placement
            | Quantity::IsochoricPlacement
            | Quantity::MeanLogStretch
            | Quantity::LogStretches
            | Quantity::InverseDilatation
            | Quantity::Work
            | Quantity::TangentVector => None,
            Quantity::LinearMomentum | Quantity::LogStretchMomenta | Quantity::ComovingLinearMomentum => {
                self.range_of(Quantity::Position)
            }
            _ => self.placement(),
        }
    }

    fn placement(&self) -> Option<Range<usize>> {
        self.groups.iter().position(|group| group.quantity.is_placement()).map(|k| self.range(k))
    }

    fn range_of(&self, quantity: Quantity) -> Option<Range<usize>> {
        self.groups.iter().position(|group| group.quantity == quantity).map(|k| self.range(k))
    }

    fn range(&self, k: usize) -> Range<usize> {
        let start = self.groups[..k].iter().map(|group| group.len).sum();
        start..start + self.groups[k].len
    }
}

/// [`norm`].
#[inline(never)]
fn size(components: &[f64]) -> f64 {
    norm(components)
}

/// Euclidean norm of a difference.
#[inline(never)]
fn distance(a: &[f64], b: &[f64]) -> f64 {
    Scalar::sqrt(a.iter().zip(b).map(|(a, b)| square(a - b)).sum::<f64>())
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAYOUT: &[Group] = &[
        Group::new(Quantity::Position, 2),
        Group::new(Quantity::Placement, 2),
        Group::new(Quantity::MeanLogStretch, 1),
    ];

    fn error(before: [f64; 5], after: [f64; 5], error: [f64; 5]) -> f64 {
        ErrorNorm::new(LAYOUT).largest(1.0, &before, &after, |r| norm(&error[r]))
    }

    #[test]
    fn each_group_has_its_scale() {
        let (before, after) = ([0.0, 0.0, 3.0, 4.0, 7.0], [0.0, 5.0, 0.0, 5.0, 9.0]);
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
        }
        assert_eq!(error([1.0; 5], [1.0; 5], [f64::INFINITY, 0.0, 0.0, 0.0, 0.0]), f64::INFINITY);
        assert!(error([1.0; 5], [1.0; 5], [f64::NAN, 0.0, 0.0, 0.0, 1.0]).is_nan(), "NaN is not dropped");
    }

    #[test]
    fn momenta_are_held_against_what_they_move() {
        const LAYOUT: &[Group] = &[
            Group::new(Quantity::Position, 1),
            Group::new(Quantity::Placement, 2),
            Group::new(Quantity::LinearMomentum, 1),
            Group::new(Quantity::CanonicalMomentum, 2),
        ];
        // x' = p/4, phi' = (Pi_1/2, Pi_2): masses 4, 2 and 1, the least of Pi is 1.
        let f = |_: f64, y: &[f64; 6]| [y[3] / 4.0, y[4] / 2.0, y[5], 0.0, 0.0, 0.0];
        let y = [5.0, 3.0, 4.0, 0.0, 8.0, 0.0];
        let (norm_at_y, evaluations) = ErrorNorm::probed(LAYOUT, &f, (0.0, &y, &f(0.0, &y)));
        assert_eq!(evaluations, 3, "one per component of p and Pi");
        let error = |h: f64, e: [f64; 6]| norm_at_y.largest(h, &y, &y, |r| norm(&e[r]));
        // |x| + |phi| = 10 and the mass 4: p moves x by that in a step of 0.5 when it is 80.
        assert!((error(0.5, [0.0, 0.0, 0.0, 1.0, 0.0, 0.0]) - 1.0 / 8.0).abs() < 1e-15);
        // |phi| = 5 and the mass 1: Pi = 500 in a step of 0.01, a tenth of which is more than |Pi| = 8.
        assert!((error(0.01, [0.0, 0.0, 0.0, 0.0, 0.0, 1.0]) - 1.0 / 50.0).abs() < 1e-15);
        // In a step of 1 it is less.
        assert_eq!(error(1.0, [0.0, 0.0, 0.0, 0.0, 0.0, 1.0]), 1.0 / 8.0);
    }
}
