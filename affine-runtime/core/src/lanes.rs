//! Several doubles side by side as one number.

use crate::scalar::{Real, Scalar};

/// A number of several lanes.
pub trait Lanes: Scalar {
    /// The number in one lane.
    type Lane: Real;

    /// Lanes that hold the same numbers, each with a multiply-add that is rounded once.
    type Fused: Lanes;

    /// A multiply-add is rounded once, whatever the target promises.
    const IS_FUSED: bool;

    /// Number of lanes.
    const LANES: usize;

    /// The lanes, from a function of their index.
    fn from_lanes(lane: impl FnMut(usize) -> f64) -> Self;

    /// A lane; NaN beyond the last.
    fn lane(&self, index: usize) -> f64;

    /// Puts a number into a lane; does nothing beyond the last.
    fn set_lane(&mut self, index: usize, value: f64);

    /// The numbers in the lanes.
    fn as_slice(&self) -> &[f64];

    /// The same, to be changed.
    fn as_mut_slice(&mut self) -> &mut [f64];
}

/// An entry of several records, one to a lane; the last record fills what is left of them.
pub fn gathered<T: Lanes, C>(records: &[C], entry: impl Fn(&C) -> f64) -> T {
    T::from_lanes(|lane| records.get(lane).or(records.last()).map_or(f64::NAN, &entry))
}

/// Puts the entries of a record into a lane.
pub fn set_entries<T: Lanes>(lanes: &mut [T], lane: usize, record: &[f64]) {
    lanes.iter_mut().zip(record).for_each(|(lanes, entry)| lanes.set_lane(lane, *entry));
}

/// What stands in a lane.
#[inline(always)]
pub fn in_lane<T: Lanes>(lanes: &T, lane: usize) -> T::Lane {
    T::Lane::from_f64(lanes.lane(lane))
}
