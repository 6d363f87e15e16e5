//! The end of a step in lanes, with what is estimated of its error: one pass over the slopes.

use core::ops::Range;

use pulp::Simd;

use super::attempt::{AT_END, Attempt, combination};
use crate::error_norm::{GROUPS, Measured, Squares, are_in_range, has_size, measure_again, with_squares};
use crate::lanes::Lanes;
use crate::lanes::equations::Equations;
use crate::lanes::parts::{part, parts, plus, set_part};
use crate::runge_kutta::dormand_prince_853::{B, B3, E5};
use affine_core::model::StateVector;

/// Sums over a group: of squares of errors of orders 5 and 3 and of components before and after the step, and of sizes of
/// errors of order 5.
struct Sums<V: Simd> {
    squares: [V::f64s; 4],
    sizes: V::f64s,
}

impl<T: Lanes, S: StateVector<T>, F: Equations<T, S>> Attempt<'_, T, S, F> {
    /// The trial states at the end of the step, rounded once, and their slopes. Measures errors over the length of the step; 1
    /// where squares of errors leave the range of numbers, so that a body has to be looked at alone.
    #[inline(always)]
    pub(super) fn end<V: Simd>(&mut self, simd: V, measured: &mut [Measured<T>; GROUPS]) -> T {
        let (mut doubt, mut out_of_range) = (T::zero(), simd.splat_f64s(0.0));
        let (zero, one) = (simd.splat_f64s(0.0), simd.splat_f64s(1.0));
        for k in 0..parts::<V, T>() {
            let (mut start, mut of_errors) = (0, zero);
            for (own, group) in measured.iter_mut().zip(F::GROUPS) {
                let range = start..start + group.len;
                start = range.end;
                let Sums { squares: [fifth, third, before, after], sizes } = self.group(simd, range, k);
                // As the pair has it.
                let size = simd.add_f64s(fifth, simd.mul_f64s(simd.splat_f64s(0.01), third));
                let error = simd.div_f64s(fifth, simd.sqrt_f64s(size));
                let is_zero = simd.equal_f64s(fifth, zero);
                set_part(simd, &mut own.value, k, simd.select_f64s(is_zero, zero, error));
                set_part(simd, &mut own.sizes[0], k, simd.sqrt_f64s(before));
                set_part(simd, &mut own.sizes[1], k, simd.sqrt_f64s(after));
                let is_plain = simd.or_m64s(are_in_range(simd, fifth), simd.equal_f64s(sizes, zero));
                of_errors = simd.select_f64s(is_plain, of_errors, one);
                if has_size(group) {
                    let are_plain = simd.and_m64s(are_in_range(simd, before), are_in_range(simd, after));
                    out_of_range = simd.select_f64s(are_plain, out_of_range, one);
                }
            }
            set_part(simd, &mut doubt, k, of_errors);
        }
        if simd.reduce_max_f64s(out_of_range) != 0.0 {
            measure_again(simd, F::GROUPS, [self.y.as_ref(), self.trial.as_ref()], measured);
        }
        self.f.slope(self.end, self.trial, &mut self.stages[AT_END]);
        doubt
    }

    /// The end of the step of a group in a vector of lanes.
    #[inline(always)]
    fn group<V: Simd>(&mut self, simd: V, Range { start, end }: Range<usize>, k: usize) -> Sums<V> {
        let (mut fours, mut sizes) = (Squares::<V, 4>::new(simd), simd.splat_f64s(0.0));
        let rest = end - (end - start) % 4;
        for first in (start..rest).step_by(4) {
            for of_four in 0..4 {
                let components = self.component(simd, first + of_four, k);
                sizes = simd.add_f64s(sizes, simd.abs_f64s(components[0]));
                fours.add(simd, of_four, components);
            }
        }
        let mut squares = fours.sums(simd);
        for i in rest..end {
            let components = self.component(simd, i, k);
            sizes = simd.add_f64s(sizes, simd.abs_f64s(components[0]));
            squares = with_squares(simd, squares, components);
        }
        Sums { squares, sizes }
    }

    /// The end of the step of component `i` in a vector of lanes: its errors of orders 5 and 3 over the length, and the component
    /// before and after.
    #[inline(always)]
    fn component<V: Simd>(&mut self, simd: V, i: usize, k: usize) -> [V::f64s; 4] {
        let slope = combination(simd, self.stages, (i, k), &B, B.len());
        let fifth = combination(simd, self.stages, (i, k), &E5, E5.len());
        let third = simd.sub_f64s(slope, combination(simd, self.stages, (i, k), &B3, B3.len()));
        let before = part(simd, &self.y.as_ref()[i], k);
        let after = plus::<V, T>(simd, slope, part(simd, &self.h, k), before);
        set_part(simd, &mut self.trial.as_mut()[i], k, after);
        [fifth, third, before, after]
    }
}
