//! Eight bodies in lanes by splitting.

use super::eight::{Eight, Left};
use super::pieces::{Moved, stands};
use crate::capability::{InLanes, Splitting};
use crate::error::Reason;
use crate::inner::{SplittingInLanes, Sum, of_lane};
use crate::integrate::Failure;
use crate::lanes::{F64x8, Lanes};
use crate::model::{Handle, Model};
use crate::simulate::friction::{is_followed, rate_of_friction};
use crate::simulate::in_lanes::{EIGHT, Reduced, Together};
use crate::simulate::layout::is_looked_after;
use crate::simulate::mechanics::Moving;
use crate::simulate::method::Method;
use crate::simulate::methods::by_splitting;
use crate::simulate::motion::{Followed, PointOf};
use crate::simulate::orientation::{Moment, keeps_orientation, passes_through_zero};

/// Eight bodies, or fewer, in equal steps.
pub(super) struct BySplitting<const N: usize, H: Handle<N>>
where
    H::Model: InLanes<N> + Splitting<N>,
{
    integration: SplittingInLanes<F64x8, Reduced<N, H, F64x8>, Moved<N, H>>,
    method: Method,
    has_body: [bool; EIGHT],
    /// Steps that the bodies have taken.
    steps: [u64; EIGHT],
    /// Points from which no step has been taken.
    anew: [Option<PointOf<N, H>>; EIGHT],
}

impl<const N: usize, H: Handle<N>> BySplitting<N, H>
where
    H::Model: InLanes<N> + Splitting<N>,
{
    /// Lanes with models, in which there are no bodies yet; `None` for orders other than 2, 4, 6 and 8.
    ///
    /// # Errors
    /// Where step or time make no sense.
    pub(super) fn new(
        (order, step): (usize, f64),
        t0: f64,
        together: Together<N, F64x8, H>,
    ) -> Option<Result<Self, Failure>> {
        let integration = SplittingInLanes::new(Moved(together), order, t0, step)?;
        Some(integration.map(|integration| Self {
            integration,
            method: Method::Splitting { order, step },
            has_body: [false; EIGHT],
            steps: [0; EIGHT],
            anew: [None; EIGHT],
        }))
    }

    /// Puts doubles of the body in a lane into those that have none, which move too: no force of the user is asked where no body
    /// could be.
    fn double(&mut self, lane: usize) {
        let state: Reduced<N, H, f64> = of_lane(self.integration.end().1, lane);
        let (handle, constants) = (self.handle(lane).clone(), self.together().of_lanes[lane]);
        for other in (0..EIGHT).filter(|other| !self.has_body[*other]) {
            self.integration.put(other, &state);
            self.integration.pieces_mut().0.put(other, handle.clone(), constants);
        }
    }

    fn together(&self) -> &Together<N, F64x8, H> {
        &self.integration.pieces().0
    }

    fn expanded(&self, lane: usize, (t, states): (f64, &Reduced<N, H, F64x8>)) -> PointOf<N, H> {
        self.together().expanded(lane, t, &of_lane(states, lane)).0
    }

    fn has_value(&self, lane: usize) -> bool {
        let (t, states) = self.integration.end();
        self.together().has_value(lane, || (t, of_lane(states, lane)))
    }

    /// The body in a lane keeps its orientation throughout its last step, looked at as by itself, and goes on from the end of it.
    fn goes_on(&self, lane: usize) -> bool {
        let (Together { handles, of_lanes, .. }, (t_end, to)) = (self.together(), self.integration.end());
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

    /// Lets bodies go alone from where their last step began, which they cannot go on from the end of.
    fn let_go(&mut self, doubts: F64x8, left: &mut dyn FnMut(Left<H, PointOf<N, H>>)) {
        for lane in 0..EIGHT {
            let is_sound =
                |own: &Self| (doubts.lane(lane) == 0.0 || own.goes_on(lane)) && own.has_value(lane);
            let has_to_leave = self.has_body[lane] && !is_sound(self);
            if let Some(begin) = self.integration.begin().filter(|_| has_to_leave) {
                let point = self.anew[lane].unwrap_or_else(|| self.expanded(lane, begin));
                let (handle, from) = (self.handle(lane).clone(), (begin.0, point));
                left(Left { lane, handle, from, steps: self.steps[lane], is_limited: false });
                self.rest(lane);
            }
        }
    }
}

impl<const N: usize, H: Handle<N>> Eight<N, H> for BySplitting<N, H>
where
    H::Model: InLanes<N> + Splitting<N>,
{
    fn put(&mut self, lane: usize, handle: &H, point: &PointOf<N, H>, steps: u64) -> bool {
        let (model, (t, _)) = (handle.model(), self.integration.end());
        let (state, constants) = model.reduce(t, point);
        let has_value = !H::Model::DESCRIPTION.custom_potential || model.hamiltonian(t, point).is_finite();
        let rate = || rate_of_friction::<N, H::Model>(model, (t, point)).rate;
        let is_followed = || is_followed(self.method, rate).is_ok();
        let fits = has_value && is_followed() && !is_looked_after(model, point) && stands::<N, H>(&state);
        if fits {
            self.integration.put(lane, &state);
            self.integration.pieces_mut().0.put(lane, handle.clone(), constants);
            (self.has_body[lane], self.anew[lane]) = (true, Some(*point));
            self.steps[lane] = steps;
            self.double(lane);
        }
        fits
    }

    fn steps(&self, lane: usize) -> u64 {
        self.steps[lane]
    }

    fn rest(&mut self, lane: usize) {
        self.has_body[lane] = false;
        if let Some(other) = self.has_body.iter().position(|has_body| *has_body) {
            self.double(other);
        }
    }

    fn handle(&self, lane: usize) -> &H {
        &self.together().handles[lane]
    }

    fn point(&self, lane: usize) -> PointOf<N, H> {
        self.anew[lane].unwrap_or_else(|| self.expanded(lane, self.integration.end()))
    }

    fn move_to(
        &mut self,
        t_end: f64,
        _limit: u64,
        left: &mut dyn FnMut(Left<H, PointOf<N, H>>),
    ) -> Result<(), Failure> {
        self.integration.aim(t_end)?;
        if !self.has_body.contains(&true) {
            self.integration.pass_over();
        }
        while !self.integration.is_finished() {
            let doubts = self.integration.advance();
            // Of most steps there is nothing to ask.
            let custom = const { H::Model::DESCRIPTION.custom_potential };
            if custom || doubts.as_slice().iter().any(|doubt| *doubt != 0.0) {
                self.let_go(doubts, left);
            }
            self.anew.iter_mut().for_each(|anew| *anew = None);
            self.steps.iter_mut().for_each(|steps| *steps += 1);
        }
        Ok(())
    }
}
