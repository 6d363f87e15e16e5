//! What is asked of an ensemble.

use crate::error::Stop;
use crate::model::Handle;
use crate::simulate::event::{Event, Occurrence};
use crate::simulate::motion::PointOf;
use crate::simulate::output::Schedule;
use crate::simulate::settings::Plan;

/// A member of an ensemble: a body from its start to its end.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Member<P, A> {
    /// Its place among the starts, counted from 0; whatever shard it was in.
    pub number: u64,
    /// Where it is in the end, or why it did not get there; where an event ended its run, the point there.
    pub end: Result<P, Stop>,
    /// The time reached: that of the end, of the event that ended its run, or of the last good phase point before it stopped.
    #[cfg_attr(feature = "serde", serde(with = "crate::inner::number"))]
    pub t: f64,
    /// Its events, up to where it ended or stopped.
    pub events: Vec<Occurrence<P>>,
    /// What was made of its outputs, up to there.
    pub folded: A,
}

/// A body before its run.
pub(super) struct Start<const N: usize, H: Handle<N>> {
    pub(super) number: u64,
    pub(super) handle: H,
    pub(super) point: PointOf<N, H>,
}

/// What makes the events that a body looks for.
pub(super) type Events<'a, const N: usize, P> = dyn Fn() -> Vec<Event<'a, N, P>> + Send + Sync + 'a;

/// The same of every body, checked.
pub(super) struct Asked<'t, 'a, const N: usize, H: Handle<N>, A> {
    pub(super) plan: &'t Plan,
    pub(super) t_end: f64,
    pub(super) schedule: Schedule,
    pub(super) events: &'t Events<'a, N, PointOf<N, H>>,
    pub(super) has_events: bool,
    /// Something is looked at on the way.
    pub(super) within_steps: bool,
    /// What a fold begins with.
    pub(super) begin: &'t (dyn Fn(u64, &H) -> A + Sync),
    /// Adds an output to it.
    pub(super) add: &'t (dyn Fn(&mut A, f64, &PointOf<N, H>) + Sync),
    /// A body is done.
    pub(super) tell: &'t (dyn Fn() + Sync),
}
