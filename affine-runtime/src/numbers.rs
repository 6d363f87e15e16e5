//! Phase points as arrays of numbers.

use crate::state::Phase;

/// The numbers of a phase point, of which there are as many in three dimensions.
pub(crate) type Numbers = [f64; 24];

/// The numbers of a phase point, as [`Phase::entries`] has them.
pub(crate) fn numbers<const N: usize, P: Phase<N>>(point: &P) -> Numbers {
    let (mut numbers, mut filled) = ([0.0; 24], 0);
    point.entries(&mut |entry| {
        numbers[filled] = entry;
        filled += 1;
    });
    numbers
}
