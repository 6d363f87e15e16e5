//! Eight bodies in lanes.

use core::array;

use super::pieces::{EIGHT, Moved, Reduced, stands};
use crate::capability::{InLanes, Splitting};
use crate::error::Reason;
use crate::inner::{SplittingInLanes, Sum, of_lane};
use crate::integrate::Failure;
use crate::lanes::{F64x8, Lanes};
use crate::model::{Handle, Model};
use crate::simulate::layout::is_looked_after;
use crate::simulate::mechanics::Moving;
use crate::simulate::methods::by_splitting;
use crate::simulate::motion::{Followed, PointOf};
use crate::simulate::orientation::{Moment, keeps_orientation, passes_through_zero};

/// Time and phase point where a body left its lane, the last good ones.
pub(super) type Left<P> = (f64, P);

/// Eight bodies, or fewer.
pub(super) struct Eight<const N: usize, H: Handle<N>>
where
    H::Model: InLanes<N> + Splitting<N>,
{
    integration: SplittingInLanes<F64x8, Reduced<N, H, F64x8>, Moved<N, H>>,
    has_body: [bool; EIGHT],
    /// Points from which no step has been taken.
    anew: [Option<PointOf<N, H>>; EIGHT],
}

impl<const N: usize, H: Handle<N>> Eight<N, H>
where
    H::Model: InLanes<N> + Splitting<N>,
{
    /// Lanes for bodies, eight at most, which are still to be put there; `None` without one.
    ///
    /// # Errors
    /// Where order, step or time make no sense.
    pub(super) fn new(
        (order, step): (usize, f64),
        t0: f64,
        bodies: &[(H, PointOf<N, H>)],
    ) -> Option<Result<Self, Failure>> {
        let last = bodies.last()?;
        let body = |lane: usize| bodies.get(lane).unwrap_or(last);
        let of_lanes = array::from_fn(|lane| {
            let (handle, point) = body(lane);
            handle.model().reduce(t0, point).1
        });
        let constants = H::Model::constants_in_lanes(&of_lanes);
        let pieces = Moved { handles: array::from_fn(|lane| body(lane).0.clone()), of_lanes, constants };
        let integration = SplittingInLanes::new(pieces, order, t0, step)?;
        Some(integration.map(|integration| Self {
            integration,
            has_body: [false; EIGHT],
            anew: [None; EIGHT],
        }))
    }

    /// Puts a body into a lane at the time reached; `false` where it is to move by itself, and the lane stays as it is.
    pub(super) fn put(&mut self, lane: usize, handle: &H, point: &PointOf<N, H>) -> bool {
        let (model, (t, _)) = (handle.model(), self.integration.end());
        let (state, constants) = model.reduce(t, point);
        let fits = !is_looked_after(model, point) && stands::<N, H>(&state);
        if fits {
            self.integration.put(lane, &state);
            (self.has_body[lane], self.anew[lane]) = (true, Some(*point));
            let pieces = self.integration.pieces_mut();
            (pieces.handles[lane], pieces.of_lanes[lane]) = (handle.clone(), constants);
            pieces.constants = H::Model::constants_in_lanes(&pieces.of_lanes);
        }
        fits
    }

    /// Leaves a lane without a body.
    pub(super) fn rest(&mut self, lane: usize) {
        self.has_body[lane] = false;
    }

    /// The model of the body in a lane.
    pub(super) fn handle(&self, lane: usize) -> &H {
        &self.integration.pieces().handles[lane]
    }

    /// The phase point reached in a lane.
    pub(super) fn point(&self, lane: usize) -> PointOf<N, H> {
        self.anew[lane].unwrap_or_else(|| self.expanded(lane, self.integration.end()))
    }

    fn expanded(&self, lane: usize, (t, states): (f64, &Reduced<N, H, F64x8>)) -> PointOf<N, H> {
        let Moved { handles, of_lanes, .. } = self.integration.pieces();
        handles[lane].model().expand(t, &of_lanes[lane], &of_lane(states, lane))
    }

    /// The body in a lane keeps its orientation throughout its last step, looked at as by itself, and goes on from the end of it.
    fn goes_on(&self, lane: usize) -> bool {
        let (Moved { handles, of_lanes, .. }, (t_end, to)) =
            (self.integration.pieces(), self.integration.end());
        let Some((t, from)) = self.integration.begin() else { return false };
        if const { !passes_through_zero(&H::Model::DESCRIPTION) } || !stands::<N, H>(&of_lane(to, lane)) {
            return false;
        }
        let (model, constants) = (handles[lane].model(), &of_lanes[lane]);
        let moving = Moving { handle: Followed(model), begin: by_splitting };
        let begin = Moment::of(&moving, (t, &self.expanded(lane, (t, from))));
        let end = Moment::of(&moving, (t_end, &self.expanded(lane, (t_end, to))));
        let flow = |piece, t, h, state: &mut Sum<Reduced<N, H, f64>>| {
            model.flow(piece, t, h, constants, &mut state.value, &mut state.carry);
        };
        let mut between = |t| {
            let state = self.integration.within(lane, t, flow).ok_or(Reason::NotFinite)?;
            Ok((model.expand(t, constants, &state), 0.0))
        };
        keeps_orientation(&moving, &mut between, (&begin, &end)).is_ok()
    }

    /// Moves to a time; bodies that cannot go on here are added to those that left, of which these are number `place`
    /// among eights.
    ///
    /// # Errors
    /// Where there are no steps to it.
    pub(super) fn move_to(
        &mut self,
        t_end: f64,
        place: usize,
        left: &mut Vec<(usize, Left<PointOf<N, H>>)>,
    ) -> Result<(), Failure> {
        self.integration.aim(t_end)?;
        while !self.integration.is_finished() {
            let doubts = self.integration.advance();
            for lane in 0..EIGHT {
                let is_doubtful = self.has_body[lane] && doubts.lane(lane) != 0.0;
                let has_to_leave = is_doubtful && !self.goes_on(lane);
                if let Some(begin) = self.integration.begin().filter(|_| has_to_leave) {
                    let point = self.anew[lane].unwrap_or_else(|| self.expanded(lane, begin));
                    left.push((EIGHT * place + lane, (begin.0, point)));
                    self.rest(lane);
                }
            }
            self.anew.iter_mut().for_each(|point| *point = None);
        }
        Ok(())
    }
}
