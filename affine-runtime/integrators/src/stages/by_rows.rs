//! The same combinations by rows that are data, of states with any number of components. They take longer, and are not
//! compiled for every model again.

use crate::vectors::Baseline;
use crate::widest::{Work, widest};
use affine_core::__private::Vectors;

/// `sum_j a_j k_j` with the bits of [`combination`](super::combination), or with those of the same sum in vectors.
#[inline(never)]
pub(crate) fn combination(in_vectors: bool, sum: &mut [f64], stages: &[&[f64]], row: &[(usize, f64)]) {
    rounded(in_vectors, Combination { sum, stages, row });
}

/// `y + h sum_j a_j k_j` in place of `y`, with the bits of [`moved`](super::moved), or with those of the same sum in vectors.
#[inline(never)]
pub(crate) fn moved(in_vectors: bool, y: &mut [f64], h: f64, stages: &[&[f64]], row: &[(usize, f64)]) {
    rounded(in_vectors, Moved { y, h, stages, row });
}

/// The work done as sums in vectors are, which may be fused where sums of numbers are not.
#[inline(always)]
fn rounded(in_vectors: bool, work: impl Work<Output = ()>) {
    if in_vectors { widest(work) } else { work.run(Baseline) }
}

struct Combination<'s> {
    sum: &'s mut [f64],
    stages: &'s [&'s [f64]],
    row: &'s [(usize, f64)],
}

impl Work for Combination<'_> {
    type Output = ();
    #[inline(always)]
    fn run(self, vectors: impl Vectors) {
        let Self { sum, stages, row } = self;
        let (fours, rest) = sum.as_chunks_mut();
        let done = 4 * fours.len();
        for (k, four) in fours.iter_mut().enumerate() {
            *four = of_four(vectors, stages, row, k).unwrap_or_default();
        }
        for (i, sum) in rest.iter_mut().enumerate() {
            *sum = of_one(vectors, stages, row, done + i).unwrap_or_default();
        }
    }
}

struct Moved<'s> {
    y: &'s mut [f64],
    h: f64,
    stages: &'s [&'s [f64]],
    row: &'s [(usize, f64)],
}

impl Work for Moved<'_> {
    type Output = ();
    #[inline(always)]
    fn run(self, vectors: impl Vectors) {
        let Self { y, h, stages, row } = self;
        let Some(((last, newest), earlier)) = row.split_last() else { return };
        let (fours, rest) = y.as_chunks_mut();
        let done = 4 * fours.len();
        for (k, four) in fours.iter_mut().enumerate() {
            if let Some(sum) = of_four(vectors, stages, earlier, k) {
                *four = vectors.plus_product(*four, sum, [h; 4]);
            }
            *four = vectors.plus_product(*four, four_of(stages, *last, k), [h * newest; 4]);
        }
        for (i, y) in rest.iter_mut().enumerate() {
            if let Some(sum) = of_one(vectors, stages, earlier, done + i) {
                *y = vectors.plus_one(*y, sum, h);
            }
            *y = vectors.plus_one(*y, one_of(stages, *last, done + i), h * newest);
        }
    }
}

/// The `k`th four of the combination; `None` of no stages.
#[inline(always)]
fn of_four(vectors: impl Vectors, stages: &[&[f64]], row: &[(usize, f64)], k: usize) -> Option<[f64; 4]> {
    let ((first, leading), rest) = row.split_first()?;
    // `-0 + x` is `x`.
    let mut sum = vectors.plus_product([-0.0; 4], four_of(stages, *first, k), [*leading; 4]);
    for (stage, coefficient) in rest {
        sum = vectors.plus_product(sum, four_of(stages, *stage, k), [*coefficient; 4]);
    }
    Some(sum)
}

/// Its component `i`.
#[inline(always)]
fn of_one(vectors: impl Vectors, stages: &[&[f64]], row: &[(usize, f64)], i: usize) -> Option<f64> {
    let ((first, leading), rest) = row.split_first()?;
    let mut sum = one_of(stages, *first, i) * leading;
    for (stage, coefficient) in rest {
        sum = vectors.plus_one(sum, one_of(stages, *stage, i), *coefficient);
    }
    Some(sum)
}

/// Stages are counted from 1.
#[inline(always)]
fn four_of(stages: &[&[f64]], stage: usize, k: usize) -> [f64; 4] {
    stages.get(stage - 1).and_then(|stage| stage.as_chunks().0.get(k)).copied().unwrap_or_default()
}

#[inline(always)]
fn one_of(stages: &[&[f64]], stage: usize, i: usize) -> f64 {
    stages.get(stage - 1).and_then(|stage| stage.get(i)).copied().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stages;

    #[test]
    fn rows_that_are_data_round_the_same() {
        let stages: [[f64; 11]; 3] =
            core::array::from_fn(|k| core::array::from_fn(|i| libm::sin((11 * k + i) as f64)));
        let slices = stages.each_ref().map(|stage| stage.as_slice());
        let y: [f64; 11] = core::array::from_fn(|i| libm::cos(i as f64));
        fn check<const TERMS: usize>(
            y: [f64; 11],
            stages: &[[f64; 11]; 3],
            slices: &[&[f64]],
            row: [(usize, f64); TERMS],
        ) {
            let mut sum = [f64::NAN; 11];
            combination(false, &mut sum, slices, &row);
            assert_eq!(sum.map(f64::to_bits), stages::combination(stages, &row).map(f64::to_bits));
            let mut at = y;
            moved(false, &mut at, 0.3, slices, &row);
            let newest = row.last().map_or(&y, |(stage, _)| &stages[stage - 1]);
            let expected = stages::moved(&y, 0.3, (stages, newest), &row);
            assert_eq!(at.map(f64::to_bits), expected.map(f64::to_bits));
        }
        check(y, &stages, &slices, []);
        check(y, &stages, &slices, [(2, 0.7)]);
        check(y, &stages, &slices, [(1, 0.1), (2, -1.7), (3, 0.9)]);
    }
}
