//! How far a run has come, and who is told.

use core::ops::ControlFlow;

/// How far a run has come.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Progress {
    /// Time of the start.
    pub t0: f64,
    /// Time reached.
    pub t: f64,
    /// Time to reach.
    pub t_end: f64,
    /// Accepted steps so far; output times so far for a closed form, since an event has changed the point.
    pub steps: u64,
}

impl Progress {
    /// Part of the time interval that is done, 0 to 1.
    #[must_use]
    pub fn fraction(&self) -> f64 {
        if self.t == self.t_end { 1.0 } else { (self.t - self.t0) / (self.t_end - self.t0) }
    }
}

/// Called with how far a run has come.
pub(super) type Watch<'a> = Box<dyn FnMut(&Progress) -> ControlFlow<()> + 'a>;
/// Called with an output.
pub(super) type Observe<'a, P> = Box<dyn FnMut(f64, &P) -> ControlFlow<()> + 'a>;
