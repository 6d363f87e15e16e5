//! The longest step in which a term of a power series stays below a tolerance.

use super::{ErrorNorm, IN_RANGE, Measure, norm, square};
use crate::integrate::roughly::{ln, ln_of_normal};

impl ErrorNorm {
    /// `ln h` of the longest `h` with `|c| h^j <= tolerance s_g` for each group `g` of two coefficients `c`, given with their
    /// orders `j`, at a state `y`; `s_g = max(|g|, 0.1 mu_g/h)` as in [`ErrorNorm`], so that there are bounds of `h^j` and of
    /// `h^(j + 1)`. Time is measured in a `unit`. Infinite where nothing bounds it, NaN where a coefficient is none.
    #[inline(always)]
    pub(crate) fn longest(
        &self,
        y: &[f64],
        terms: [(&[f64], usize); 2],
        (tolerance, unit): (f64, f64),
    ) -> f64 {
        let ln_tolerance = ln(tolerance);
        let mut longest = f64::INFINITY;
        let mut start = 0;
        for (k, group) in self.groups.iter().enumerate() {
            let range = start..start + group.len;
            start = range.end;
            let measure = self.measure(k, group);
            if measure == Measure::Nothing {
                continue;
            }
            let parts = [y, terms[0].0, terms[1].0].map(|values| &values[range.clone()]);
            let floor = self.floor(k, unit);
            let has_floor = floor > 0.0;
            let mut squares = [0.0, 0.0, 0.0, if has_floor { square(floor) } else { 1.0 }];
            for ((own, one), other) in parts[0].iter().zip(parts[1]).zip(parts[2]) {
                squares[0] += square(*own);
                squares[1] += square(*one);
                squares[2] += square(*other);
            }
            let are_usual = squares.map(|square| IN_RANGE.contains(&square)) == [true; 4];
            let [own, one, other, floor] = match are_usual && measure == Measure::Size {
                true => squares.map(|square| 0.5 * ln_of_normal(square)),
                false => {
                    let own = self.scale(measure, range, y, y);
                    [own, norm(parts[1]), norm(parts[2]), floor].map(ln)
                }
            };
            for (coefficient, j) in [(one, terms[0].1), (other, terms[1].1)] {
                let within = |scale: f64, j: usize| (ln_tolerance + (scale - coefficient)) / j as f64;
                let (of_size, of_floor) = (within(own, j), within(floor, j + 1));
                let bound = if has_floor && of_floor > of_size { of_floor } else { of_size };
                // Zero is no bound, whatever it is measured against; a NaN is kept.
                if coefficient != f64::NEG_INFINITY && !(longest <= bound || longest.is_nan()) {
                    longest = bound;
                }
            }
        }
        longest
    }
}
