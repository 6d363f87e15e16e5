//! Bodies in lanes on their way by steps of their own lengths.

use core::array;

use super::{Constants, EIGHT, Reduced, Together};
use crate::capability::InLanes;
use crate::error::Reason;
use crate::inner::{Fate, RungeKutta8InLanes, Start, starts_in_lanes};
use crate::lanes::Lanes;
use crate::model::{Handle, Model};
use crate::simulate::mechanics::Moving;
use crate::simulate::methods::by_any_steps;
use crate::simulate::motion::{Followed, PointOf, WithWork};
use crate::simulate::orientation::{Moment, keeps_orientation, passes_through_zero};
use crate::simulate::settings::Plan;
use crate::state::Phase;

/// Bodies in lanes, each at its own time.
pub(in crate::simulate) struct Bodies<const N: usize, T: Lanes, H: Handle<N>>
where
    H::Model: InLanes<N>,
{
    integration: RungeKutta8InLanes<T, Reduced<N, H, T>, Together<N, T, H>>,
    tolerance: f64,
    /// How bodies moved where their last steps ended, of a model that may lose its orientation within them.
    moments: [Option<Moment<N>>; EIGHT],
}

impl<const N: usize, T: Lanes, H: Handle<N>> Bodies<N, T, H>
where
    H::Model: InLanes<N>,
{
    /// Lanes with models, in which nothing moves yet; steps are kept where it is asked what is within them, or where they began.
    pub(in crate::simulate) fn new(
        together: Together<N, T, H>,
        (plan, t_end): (&Plan, f64),
        keeps: bool,
    ) -> Self {
        let mut integration = RungeKutta8InLanes::new(together, t_end, plan.tolerance, plan.max_steps);
        if keeps || const { passes_through_zero(&<H::Model as Model<N>>::DESCRIPTION) } {
            integration.keep();
        }
        Self { integration, tolerance: plan.tolerance, moments: [None; EIGHT] }
    }

    /// The models.
    pub(in crate::simulate) fn together(&self) -> &Together<N, T, H> {
        self.integration.equations()
    }

    /// Replaces the model in a lane.
    pub(in crate::simulate) fn set_model(&mut self, lane: usize, handle: H, constants: Constants<N, H, f64>) {
        self.integration.equations_mut().put(lane, handle, constants);
    }

    /// Starts from states at a time, each in a lane with its model; elsewhere lanes are what they are.
    pub(in crate::simulate) fn starts(
        &mut self,
        (t0, states): (f64, &[Option<Reduced<N, H, f64>>; EIGHT]),
        t_end: f64,
    ) -> [Option<Start<Reduced<N, H, f64>>>; EIGHT] {
        let mut in_lanes = *self.integration.y();
        for (lane, state) in states.iter().enumerate() {
            let Some(state) = state else { continue };
            let own = in_lanes.as_mut().iter_mut().zip(state.as_ref());
            own.for_each(|(lanes, number)| lanes.set_lane(lane, *number));
        }
        let equations = self.integration.equations();
        let mut starts = starts_in_lanes(equations, (t0, &in_lanes), t_end, self.tolerance);
        array::from_fn(|_| starts.next().flatten())
    }

    /// Lets the body in a lane begin to move from a state.
    pub(in crate::simulate) fn start(
        &mut self,
        lane: usize,
        (t0, state): (f64, &Reduced<N, H, f64>),
        start: &Start<Reduced<N, H, f64>>,
    ) {
        self.integration.start(lane, (t0, state), start);
        if const { passes_through_zero(&<H::Model as Model<N>>::DESCRIPTION) } {
            let (point, _) = self.together().expanded(lane, t0, state);
            let moment = Moment::of(&moving(self.together().handles[lane].model()), (t0, &point));
            self.moments[lane] = Some(moment);
        }
    }

    /// Where its steps end, it is asked of every body whether it [stands](Self::stands).
    pub(in crate::simulate) const fn are_looked_after() -> bool {
        let description = &<H::Model as Model<N>>::DESCRIPTION;
        description.custom_potential || passes_through_zero(description)
    }

    /// The body in a lane goes on from the end of its last step: the potential has a value there, and the body has kept its
    /// orientation throughout.
    pub(in crate::simulate) fn stands(&mut self, lane: usize) -> bool {
        let reached = || (self.t(lane), self.integration.state(lane));
        self.together().has_value(lane, reached) && self.keeps_orientation(lane)
    }

    /// Throughout the last step, from the end of which it goes on.
    fn keeps_orientation(&mut self, lane: usize) -> bool {
        if const { !passes_through_zero(&<H::Model as Model<N>>::DESCRIPTION) } {
            return true;
        }
        let (t, (point, _)) = (self.t(lane), self.reached(lane));
        let handle = self.together().handles[lane].clone();
        let model = moving(handle.model());
        let end = Moment::of(&model, (t, &point));
        let Some(begin) = self.moments[lane].replace(end) else { return false };
        let is_clear = begin.clearly_reaches(&end);
        is_clear
            || point.is_finite() && keeps_orientation(&model, &mut self.within(lane), (&begin, &end)).is_ok()
    }

    /// Nothing moves in a lane from now on.
    pub(in crate::simulate) fn rest(&mut self, lane: usize) {
        self.integration.rest(lane);
    }

    /// Goes on to another end, by at most so many steps.
    pub(in crate::simulate) fn aim(&mut self, t_end: f64, max_steps: u64) {
        self.integration.aim(t_end, max_steps);
    }

    /// Tries one step of every body; the lanes in which the way of one ends.
    pub(in crate::simulate) fn advance(&mut self) -> impl Iterator<Item = (usize, Fate)> + use<N, T, H> {
        self.integration.advance()
    }

    /// The last attempt of a lane was a step.
    pub(in crate::simulate) fn has_stepped(&self, lane: usize) -> bool {
        self.integration.has_stepped(lane)
    }

    /// Time reached in a lane.
    pub(in crate::simulate) fn t(&self, lane: usize) -> f64 {
        self.integration.t(lane)
    }

    /// The phase point reached in a lane, with the work done.
    pub(in crate::simulate) fn reached(&self, lane: usize) -> WithWork<PointOf<N, H>> {
        self.together().expanded(lane, self.t(lane), &self.integration.state(lane))
    }

    /// Time and phase point where the last step in a lane began; what is reached where it was none.
    pub(in crate::simulate) fn begin(&self, lane: usize) -> (f64, PointOf<N, H>) {
        match self.integration.begin(lane) {
            Some((t, state)) => (t, self.together().expanded(lane, t, &state).0),
            None => (self.t(lane), self.reached(lane).0),
        }
    }

    /// The phase points at times within the last step in a lane.
    pub(in crate::simulate) fn within(
        &mut self,
        lane: usize,
    ) -> impl FnMut(f64) -> Result<WithWork<PointOf<N, H>>, Reason> {
        move |t| {
            if t == self.t(lane) {
                return Ok(self.reached(lane));
            }
            let state = self.integration.within(lane, t);
            state.map(|state| self.together().expanded(lane, t, &state)).ok_or(Reason::NotFinite)
        }
    }
}

/// A model as far as its phase points go, with the integrator that lanes have.
pub(in crate::simulate) fn moving<'m, const N: usize, M: Model<N>>(
    model: &'m M,
) -> Moving<'m, N, Followed<'m, M>> {
    Moving { handle: Followed(model), begin: by_any_steps }
}
