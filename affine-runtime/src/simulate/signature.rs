//! A mass matrix that depends on the placement keeps its signature along a motion, or the run ends.

use crate::error::Reason;
use crate::model::Regularity;

/// Where a run cannot go on and the weakest pivot is this small, that is why: velocities grow without bound there, and
/// steps shrink below the resolution of time when the pivot is the square root to cube root of eps.
const VANISHING: f64 = 1e-5;

/// The signature at the start; `None` where it is the same at every placement.
#[derive(Clone, Copy, Debug)]
pub(super) struct Signature(Option<usize>);

impl Signature {
    pub(super) fn of(start: Option<Regularity>) -> Self {
        Self(start.map(|found| found.negative))
    }

    /// Does it have to be looked after?
    pub(super) fn may_change(self) -> bool {
        self.0.is_some()
    }

    /// Holds an accepted step against it.
    pub(super) fn kept(self, now: Option<Regularity>, t: f64) -> Result<(), Reason> {
        match (self.0, now) {
            (Some(negative), Some(now)) if now.negative != negative || !now.is_regular() => {
                Err(Reason::Degenerate { weakest: now.weakest, t })
            }
            _ => Ok(()),
        }
    }

    /// Why no step leads on from a placement, if it is for this reason.
    pub(super) fn failing(self, now: Option<Regularity>, t: f64) -> Option<Reason> {
        let now = now.filter(|now| now.weakest < VANISHING)?;
        self.0.map(|_| Reason::Degenerate { weakest: now.weakest, t })
    }
}
