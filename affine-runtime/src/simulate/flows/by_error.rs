//! Eight bodies in lanes by steps that follow their errors.

use core::array;

use super::eight::{Eight, Left};
use super::pieces::stands;
use crate::capability::InLanes;
use crate::inner::Fate;
use crate::integrate::Failure;
use crate::lanes::Lanes;
use crate::model::{Handle, Model};
use crate::simulate::in_lanes::{Bodies, EIGHT, Together};
use crate::simulate::layout::is_looked_after;
use crate::simulate::motion::PointOf;
use crate::simulate::settings::Plan;

/// Eight bodies, or fewer, each with steps of its own between two frames.
pub(super) struct ByError<const N: usize, T: Lanes, H: Handle<N>>
where
    H::Model: InLanes<N>,
{
    bodies: Bodies<N, T, H>,
    t: f64,
    has_body: [bool; EIGHT],
    /// Steps that the bodies have taken.
    steps: [u64; EIGHT],
    /// Points from which no step has been taken.
    anew: [Option<PointOf<N, H>>; EIGHT],
}

impl<const N: usize, T: Lanes, H: Handle<N>> ByError<N, T, H>
where
    H::Model: InLanes<N>,
{
    /// Lanes with models at a time, in which there are no bodies yet.
    pub(super) fn new(plan: &Plan, t0: f64, together: Together<N, T, H>) -> Self {
        let bodies = Bodies::new(together, (plan, t0), true);
        Self { bodies, t: t0, has_body: [false; EIGHT], steps: [0; EIGHT], anew: [None; EIGHT] }
    }

    /// Lets those begin that were put here since the last step; whether there is a motion from where they are.
    fn begin(&mut self, t_end: f64) -> [bool; EIGHT] {
        if self.anew.iter().all(Option::is_none) {
            return [true; EIGHT];
        }
        let (t, together) = (self.t, self.bodies.together());
        let own = |lane: usize| {
            let point = self.anew[lane].filter(|_| self.has_body[lane]);
            point.map(|point| together.handles[lane].model().reduce(t, &point).0)
        };
        // A double of another in the lanes without a body: no force of the user is asked where no body could be.
        let double = (0..EIGHT).find_map(own);
        let states = array::from_fn(|lane| if self.has_body[lane] { own(lane) } else { double });
        let starts = self.bodies.starts((t, &states), t_end);
        for (lane, (state, start)) in states.iter().zip(&starts).enumerate() {
            if let (Some(state), Some(start)) = (state, start) {
                self.bodies.start(lane, (t, state), start);
                if !self.has_body[lane] {
                    self.bodies.rest(lane);
                }
            }
        }
        array::from_fn(|lane| !self.has_body[lane] || states[lane].is_none() || starts[lane].is_some())
    }

    /// A body leaves its lane from its last good point.
    fn leaves(
        &mut self,
        lane: usize,
        (t, point): (f64, PointOf<N, H>),
        is_limited: bool,
    ) -> Left<H, PointOf<N, H>> {
        // To the bit, where no step was taken.
        let point = self.anew[lane].filter(|_| t == self.t).unwrap_or(point);
        let handle = self.handle(lane).clone();
        self.rest(lane);
        Left { lane, handle, from: (t, point), steps: self.steps[lane], is_limited }
    }
}

impl<const N: usize, T: Lanes, H: Handle<N>> Eight<N, H> for ByError<N, T, H>
where
    H::Model: InLanes<N>,
{
    fn put(&mut self, lane: usize, handle: &H, point: &PointOf<N, H>, steps: u64) -> bool {
        let model = handle.model();
        let (state, constants) = model.reduce(self.t, point);
        let rates = model.reduced_equations(self.t, &constants, &state);
        let is_sound = stands::<N, H>(&state) && rates.as_ref().iter().all(|rate| rate.is_finite());
        let has_energy = model.hamiltonian(self.t, point).is_finite();
        let fits = is_sound && has_energy && !is_looked_after(model, point);
        if fits {
            self.bodies.set_model(lane, handle.clone(), constants);
            (self.has_body[lane], self.anew[lane]) = (true, Some(*point));
            self.steps[lane] = steps;
        }
        fits
    }

    fn steps(&self, lane: usize) -> u64 {
        self.steps[lane]
    }

    fn rest(&mut self, lane: usize) {
        self.bodies.rest(lane);
        self.has_body[lane] = false;
    }

    fn handle(&self, lane: usize) -> &H {
        &self.bodies.together().handles[lane]
    }

    fn point(&self, lane: usize) -> PointOf<N, H> {
        self.anew[lane].unwrap_or_else(|| self.bodies.reached(lane).0)
    }

    fn move_to(
        &mut self,
        t_end: f64,
        limit: u64,
        left: &mut dyn FnMut(Left<H, PointOf<N, H>>),
    ) -> Result<(), Failure> {
        self.bodies.aim(t_end, limit);
        let has_begun = self.begin(t_end);
        let mut is_moving = self.has_body;
        for lane in (0..EIGHT).filter(|lane| !has_begun[*lane]) {
            // Why there is no motion is told of a body by itself.
            left(self.leaves(lane, (self.t, self.point(lane)), false));
            is_moving[lane] = false;
        }
        while is_moving.contains(&true) {
            let mut fates = [None; EIGHT];
            self.bodies.advance().for_each(|(lane, fate)| fates[lane] = Some(fate));
            for (lane, is_moving) in is_moving.iter_mut().enumerate().filter(|(_, is_moving)| **is_moving) {
                let has_stepped = self.bodies.has_stepped(lane);
                let fate = match has_stepped && !self.bodies.stands(lane) {
                    true => Some(Fate::Stuck),
                    false => fates[lane],
                };
                self.steps[lane] += u64::from(has_stepped && fate != Some(Fate::Stuck));
                let from = match fate {
                    None | Some(Fate::Arrived) => None,
                    Some(Fate::Limited) => Some((self.bodies.t(lane), self.bodies.reached(lane).0)),
                    Some(Fate::Stuck) => Some(self.bodies.begin(lane)),
                };
                *is_moving = fate.is_none();
                if let Some(from) = from {
                    left(self.leaves(lane, from, fate == Some(Fate::Limited)));
                }
            }
        }
        (self.t, self.anew) = (t_end, [None; EIGHT]);
        Ok(())
    }
}
