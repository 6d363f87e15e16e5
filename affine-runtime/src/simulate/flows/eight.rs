//! What eight bodies in lanes are asked, whatever steps they take.

use crate::integrate::Failure;
use crate::model::Handle;
use crate::simulate::motion::PointOf;

/// Eight bodies, or fewer, in lanes.
pub(super) trait Eight<const N: usize, H: Handle<N>> {
    /// Puts a body into a lane at the time reached; `false` where it is to move by itself, and the lane stays as it is.
    fn put(&mut self, lane: usize, handle: &H, point: &PointOf<N, H>) -> bool;

    /// Leaves a lane without a body.
    fn rest(&mut self, lane: usize);

    /// The model of the body in a lane.
    fn handle(&self, lane: usize) -> &H;

    /// The phase point reached in a lane.
    fn point(&self, lane: usize) -> PointOf<N, H>;

    /// Moves to a time, by at most so many steps where these have lengths of their own; bodies that cannot go on here leave.
    ///
    /// # Errors
    /// Where there are no steps to it.
    fn move_to(
        &mut self,
        t_end: f64,
        limit: u64,
        left: &mut dyn FnMut(Left<H, PointOf<N, H>>),
    ) -> Result<(), Failure>;
}

/// A body that left its lane.
pub(super) struct Left<H, P> {
    pub(super) lane: usize,
    pub(super) handle: H,
    /// Time and phase point, the last good ones.
    pub(super) from: (f64, P),
    /// It has taken as many steps as it may.
    pub(super) is_limited: bool,
}
