//! The longest step in which a term of a power series stays below a tolerance.

use super::{ErrorNorm, Measure};
use crate::roughly::{ln, ln_of_normal};
use affine_core::__private::numerics::{IN_RANGE, norm, square};

impl ErrorNorm {
    /// `ln h` of the longest `h` with `|c| h^j <= tolerance s_g` for each group `g` of two coefficients `c`, given with their
    /// orders `j`, at a state `y`; `s_g = max(|g|, 0.1 mu_g/h)` as in [`ErrorNorm`], so that there are bounds of `h^j` and of
    /// `h^(j + 1)`. In steps shorter than `lasting` errors of momenta are held against `0.1 mu_g/lasting`. Time is measured in a
    /// `unit`. Infinite where nothing bounds it, NaN where a coefficient is none.
    #[inline(always)]
    pub(crate) fn longest(
        &self,
        y: &[f64],
        terms: [(&[f64], usize); 2],
        (tolerance, unit, lasting): (f64, f64, f64),
    ) -> f64 {
        let (ln_tolerance, lasting) = (ln(tolerance), ln(lasting / unit));
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
                    // Not by `map`, which is compiled apart from what it is for, and called.
                    [ln(own), ln(norm(parts[1])), ln(norm(parts[2])), ln(floor)]
                }
            };
            for (coefficient, j) in [(one, terms[0].1), (other, terms[1].1)] {
                let within = |scale: f64, j: usize| (ln_tolerance + (scale - coefficient)) / j as f64;
                let (of_size, of_moved) = (within(own, j), within(floor, j + 1));
                let of_floor = if of_moved < lasting { within(floor - lasting, j) } else { of_moved };
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

#[cfg(test)]
mod tests {
    use super::super::{ErrorNorm, norm};
    use affine_core::model::{Group, Quantity};

    const GROUPS: &[Group] = &[
        Group::new(Quantity::Position, 1),
        Group::new(Quantity::Placement, 2),
        Group::new(Quantity::MeanLogStretch, 1),
        Group::new(Quantity::CanonicalMomentum, 2),
        Group::new(Quantity::Work, 1),
    ];
    const ORDERS: [usize; 2] = [12, 11];
    const TOLERANCE: f64 = 1e-9;

    /// The norm where `Pi` has inertia 2.
    fn measure() -> ErrorNorm {
        ErrorNorm { inertia: [0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0], ..ErrorNorm::new(GROUPS) }
    }

    fn longest(y: &[f64; 7], terms: [&[f64; 7]; 2], unit: f64) -> f64 {
        longest_after(y, terms, (unit, 0.0))
    }

    /// The same where errors last for a time.
    fn longest_after(y: &[f64; 7], terms: [&[f64; 7]; 2], (unit, lasting): (f64, f64)) -> f64 {
        let terms = [(&terms[0][..], ORDERS[0]), (&terms[1][..], ORDERS[1])];
        measure().longest(y, terms, (TOLERANCE, unit, lasting)).exp()
    }

    /// The larger of both terms over the tolerance, in a step of length `h`, by the norm itself.
    fn excess(y: &[f64; 7], terms: [&[f64; 7]; 2], h: f64, lasting: f64) -> f64 {
        let of = |term: &[f64; 7], j: usize| {
            measure().largest(h.max(lasting), y, y, |r| norm(&term[r])) * libm::pow(h, j as f64) / TOLERANCE
        };
        of(terms[0], ORDERS[0]).max(of(terms[1], ORDERS[1]))
    }

    #[test]
    fn the_larger_term_just_meets_the_tolerance() {
        let y = [0.3, 3.0, 4.0, 7.0, 1e-3, 2e-3, 5.0];
        let plain = [0.2, 1.0, -2.0, 0.5, 0.7, 0.1, 1e9];
        let without = |kept: usize| {
            let mut term = plain;
            (0..6).filter(|k| *k != kept).for_each(|k| term[k] *= 1e-9);
            term
        };
        let mut states = Vec::from([(y, plain, plain)]);
        // Each group alone, the first or the second term; the momentum bounded by its size, or by what it moves.
        for kept in 0..6 {
            let moving = [0.3, 3.0, 4.0, 7.0, 30.0, 4.0, 5.0];
            states.extend([(y, without(kept), [1e-30; 7]), (y, [1e-30; 7], without(kept))]);
            states.push((moving, without(kept), without(5 - kept)));
        }
        // Numbers whose squares leave the range, and a momentum that is zero.
        states.push((y.map(|v| v * 1e-170), plain.map(|v| v * 1e-170), [1e-190; 7]));
        states.push((y.map(|v| v * 1e160), plain.map(|v| v * 1e160), [1e150; 7]));
        states.push(([0.3, 3.0, 4.0, 7.0, 0.0, 0.0, 0.0], plain, plain));
        for (y, one, other) in &states {
            let h = longest(y, [one, other], 1.0);
            for lasting in [0.0, 0.5 * h, 3.0 * h, 100.0 * h] {
                let h = longest_after(y, [one, other], (1.0, lasting));
                let excess = excess(y, [one, other], h, lasting);
                assert!((excess - 1.0).abs() < 1e-3, "{y:?} {one:?} {other:?}, {lasting}: {excess}");
            }
            // In another unit of time, the same step.
            let in_unit = |term: &[f64; 7], j: usize| term.map(|v| v * libm::pow(0.25, j as f64));
            let [one, other] = [in_unit(one, ORDERS[0]), in_unit(other, ORDERS[1])];
            assert!((longest(y, [&one, &other], 0.25) * 0.25 / h - 1.0).abs() < 1e-4);
        }
    }

    #[test]
    fn zero_and_not_finite_terms() {
        let (y, zero) = ([0.3, 3.0, 4.0, 7.0, 0.0, 0.0, 0.0], [0.0; 7]);
        assert_eq!(longest(&y, [&zero, &zero], 1.0), f64::INFINITY, "nothing bounds the step");
        assert_eq!(longest(&zero, [&zero, &zero], 1.0), f64::INFINITY);
        let mut bad = [0.1; 7];
        bad[2] = f64::INFINITY;
        assert_eq!(longest(&y, [&bad, &zero], 1.0), 0.0);
        for position in 0..6 {
            bad = [0.1; 7];
            bad[position] = f64::NAN;
            assert!(longest(&y, [&zero, &bad], 1.0).is_nan(), "NaN in component {position} is not dropped");
            // `q` is measured against 1.
            assert!(
                longest(&bad, [&y.map(|v| v + 1.0), &y], 1.0).is_nan() == (position != 3),
                "{position} of the state"
            );
        }
    }
}
