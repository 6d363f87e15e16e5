//! What eight bodies in lanes are asked, whatever steps they take.

use crate::capability::InLanes;
use crate::integrate::Failure;
use crate::lanes::Lanes;
use crate::model::{Handle, Model};
use crate::simulate::in_lanes::Together;
use crate::simulate::motion::PointOf;

/// Eight bodies, or fewer, in lanes.
pub(super) trait Eight<const N: usize, H: Handle<N>> {
    /// Puts a body that has taken so many steps into a lane at the time reached; `false` where it is to move by itself, and the lane
    /// stays as it is.
    fn put(&mut self, lane: usize, handle: &H, point: &PointOf<N, H>, steps: u64) -> bool;

    /// Steps that the body in a lane has taken.
    fn steps(&self, lane: usize) -> u64;

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
    /// Steps up to there.
    pub(super) steps: u64,
    /// It has taken as many steps as it may.
    pub(super) is_limited: bool,
}

/// Eight bodies by whatever steps.
pub(super) type InLanesOf<'a, const N: usize, H> = Box<dyn Eight<N, H> + Send + 'a>;

/// The models of bodies, eight at most, with the constants of their trajectories; those of the last in the lanes that are left.
pub(super) fn together<const N: usize, T: Lanes, H: Handle<N>>(
    t0: f64,
    bodies: &[(H, PointOf<N, H>)],
) -> Together<N, T, H>
where
    H::Model: InLanes<N>,
{
    Together::of(|lane| {
        let (handle, point) = &bodies[lane.min(bodies.len().saturating_sub(1))];
        (handle.clone(), handle.model().reduce(t0, point).1)
    })
}

/// Bodies that left their lanes, each with the number of its eight.
type AllLeft<const N: usize, H> = Vec<(usize, Left<H, PointOf<N, H>>)>;

/// Moves bodies in lanes to a time, by at most so many steps, but for those that cannot go on there; `place` is the number of the
/// first eight.
fn moved<'a, const N: usize, H: Handle<N>>(
    (place, eights): (usize, &mut [InLanesOf<'a, N, H>]),
    (t_end, limit): (f64, u64),
) -> Result<AllLeft<N, H>, Failure> {
    let mut all = Vec::new();
    for (place, eight) in (place..).zip(eights) {
        eight.move_to(t_end, limit, &mut |left| all.push((place, left)))?;
    }
    Ok(all)
}

/// The same of all of them.
#[cfg(not(feature = "parallel"))]
pub(super) fn all_moved<'a, const N: usize, H: Handle<N>>(
    eights: &mut [InLanesOf<'a, N, H>],
    to: (f64, u64),
) -> Result<AllLeft<N, H>, Failure> {
    moved((0, eights), to)
}

/// The same of all of them on the threads of the pool.
#[cfg(feature = "parallel")]
pub(super) fn all_moved<'a, const N: usize, H: Handle<N> + Send>(
    eights: &mut [InLanesOf<'a, N, H>],
    to: (f64, u64),
) -> Result<AllLeft<N, H>, Failure>
where
    PointOf<N, H>: Send,
{
    use rayon::prelude::*;
    if eights.len() <= AT_LEAST {
        return moved((0, eights), to);
    }
    let parts = eights.par_chunks_mut(AT_LEAST).enumerate();
    let moved = parts.map(|(part, eights)| moved((part * AT_LEAST, eights), to));
    let left: Vec<AllLeft<N, H>> = moved.collect::<Result<_, _>>()?;
    Ok(left.into_iter().flatten().collect())
}

/// Eights that are worth another thread: to wake one takes as long as some steps of a hundred bodies.
#[cfg(feature = "parallel")]
const AT_LEAST: usize = 64;
