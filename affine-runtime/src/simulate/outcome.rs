//! What a run gives.

use core::fmt;

use super::trajectory::Trajectory;
use crate::error::{Error, Stop};

/// A run that did not reach its end: the stop, and the trajectory up to there.
#[derive(Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Halt<const N: usize, P> {
    /// Why, when and at which step.
    pub stop: Stop,
    /// The outputs before the stop; [`Trajectory::end`] is the last good phase point.
    pub trajectory: Box<Trajectory<N, P>>,
}

/// What a run gives: its trajectory as a rule.
pub type Outcome<const N: usize, P, R = Trajectory<N, P>> = core::result::Result<R, Halt<N, P>>;

impl<const N: usize, P> fmt::Display for Halt<N, P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.stop.fmt(f)
    }
}

/// As it is displayed: a `main` that returns an error prints that.
impl<const N: usize, P> fmt::Debug for Halt<N, P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl<const N: usize, P> core::error::Error for Halt<N, P> {}

impl<const N: usize, P> From<Halt<N, P>> for Error {
    /// Keeps the stop and drops the trajectory.
    fn from(halt: Halt<N, P>) -> Self {
        Error::Stopped(halt.stop)
    }
}
