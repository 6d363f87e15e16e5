//! Many bodies that are stepped together: for loops that are not the library's own.

mod by_error;
mod by_splitting;
mod eight;
mod pieces;

use core::fmt;

use super::failed::failed;
use super::in_lanes::{EIGHT, has_fused_lanes};
use super::mechanics::Moving;
use super::method::Method;
use super::methods::{by_any_steps, by_splitting};
use super::motion::{Begin, PointOf, Stepping};
use super::settings::{Plan, long_enough};
use super::stepped::{Stepped, placed_at};
use crate::capability::{InLanes, Splitting};
use crate::error::{Reason, Setting, Stop};
use crate::inner::step_count;
use crate::integrate::{FusedArithmetic, Statistics};
use crate::lanes::{F64x8, Lanes};
use crate::model::{Handle, Model};
use by_error::ByError;
use by_splitting::BySplitting;
use eight::{InLanesOf, Left, all_moved, together};

/// Bodies of one frame loop, [`F64x8`] of them at once in the vectors of the processor: each is where a [`Flow`](super::Flow) by
/// the same method would have it, to the bit.
///
/// All bodies are at the same time between frames. [By splitting](Self::by_splitting) they take the same equal steps;
/// [by Runge-Kutta steps](Self::by_runge_kutta) each takes its own, as long as a tolerance allows. Points and models may be
/// replaced between frames, those of each body by themselves.
///
/// ```
/// use affine_runtime::model::Owned;
/// use affine_runtime::prelude::*;
///
/// #[affine_model(
///     dim = 3, kinetic(dalembert = 0.1, space_translation = 1),
///     potential = orthogonality(1e3) + g*x[3], emit(splitting, lanes),
/// )]
/// #[derive(Clone, Copy)]
/// struct Block {
///     g: f64,
/// }
///
/// let block = Block { g: 9.81 }.prepare()?;
/// let start = |k: i32| {
///     let x = Vector::<3>::new(f64::from(k), 0.0, 5.0);
///     block.at_velocity(x, Matrix::identity(), Vector::zeros(), Matrix::<3>::zeros())
/// };
/// let bodies = (0..100).map(|k| Ok((Owned(block), start(k)?)));
/// let bodies = bodies.collect::<affine_runtime::Result<Vec<_>>>()?;
/// let dt = 1.0 / 60.0;
/// let mut flows = Flows::by_splitting((2, dt / 4.0), 0.0, bodies)?;
/// for frame in 1..=30 {
///     flows.advance_to(f64::from(frame) * dt)?;
/// }
/// assert!(flows.points().all(|point| (point.x()[2] - (5.0 - 9.81 / 8.0)).abs() < 1e-12));
///
/// flows.set_model(7, Owned(Block { g: -1.0 }.prepare()?))?; // one of them rises from here on
/// flows.advance(dt)?;
/// # Ok::<(), affine_runtime::Error>(())
/// ```
///
/// A body that cannot go on in lanes goes on alone, as a `Flow` from its last good point, until it is put elsewhere. So do from
/// the start those whose steps are looked after one by one: under a constraint, with a mass matrix that may degenerate, or with
/// a potential that does not have a value everywhere. With the feature `parallel` more than 512 bodies in lanes are spread over
/// the threads of the current `rayon` pool.
pub struct Flows<'a, const N: usize, H: Handle<N> + 'a>
where
    H::Model: InLanes<N>,
{
    plan: Plan,
    /// What moves a body by itself.
    begin: Begin<'a, N, Stepping<H>>,
    /// The time of the last frame.
    t: f64,
    eights: Vec<InLanesOf<'a, N, H>>,
    /// Those that are in no lane.
    alone: Vec<Option<Box<Alone<'a, N, H>>>>,
}

/// A body that moves by itself, with what kept it from the time of the others.
struct Alone<'a, const N: usize, H: Handle<N> + 'a> {
    body: Stepped<'a, N, H>,
    stop: Option<Stop>,
}

impl<'a, const N: usize, H: Handle<N> + Send + Sync + 'a> Flows<'a, N, H>
where
    H::Model: InLanes<N>,
    PointOf<N, H>: Send,
{
    /// Bodies from phase points at one time, by splitting of an order, 2, 4, 6 or 8, in equal steps that are not longer than `step`.
    ///
    /// # Errors
    /// As [`Flow::by`](super::Flow::by): a [`Stop`] with [`Reason::Setting`] for an order, a step or a time that makes no sense;
    /// with other reasons for the first body at whose start there is no motion.
    pub fn by_splitting(
        (order, step): (usize, f64),
        t0: f64,
        bodies: impl IntoIterator<Item = (H, PointOf<N, H>)>,
    ) -> Result<Self, Stop>
    where
        H::Model: Splitting<N>,
    {
        let plan = Plan { method: Method::Splitting { order, step }, ..Plan::default() };
        let of_failure = |failure| failed(failure, (plan.method, plan.tolerance), H::Model::DESCRIPTION.name);
        Self::begun((plan.clone(), by_splitting), t0, bodies.into_iter().collect(), |bodies| {
            let eight = BySplitting::new((order, step), t0, together(t0, bodies));
            let eight = eight.ok_or(Setting::Order { given: order })?.map_err(of_failure)?;
            Ok(Box::new(eight))
        })
    }

    /// Bodies from phase points at one time, by [`Method::RungeKutta8`] to a tolerance, the relative error that is allowed in each
    /// step, as in [`Flow::set_tolerance`](super::Flow::set_tolerance). The lengths of steps go on from frame to frame.
    ///
    /// A body waits in its lane for those that need more steps to the frame. Bodies that hit something at different times, by a
    /// force of the user's own, gain nothing by lanes; by splitting they do.
    ///
    /// # Errors
    /// As [`Flow::by`](super::Flow::by): a [`Stop`] with [`Reason::Setting`] for a tolerance or a time that makes no sense; with
    /// other reasons for the first body at whose start there is no motion.
    pub fn by_runge_kutta(
        tolerance: f64,
        t0: f64,
        bodies: impl IntoIterator<Item = (H, PointOf<N, H>)>,
    ) -> Result<Self, Stop> {
        let plan = Plan { method: Method::RungeKutta8, tolerance, ..Plan::default() };
        Self::begun((plan.clone(), by_any_steps), t0, bodies.into_iter().collect(), |bodies| {
            let is_fused = bodies.first().is_some_and(|(handle, _)| has_fused_lanes(handle.model()));
            Ok(match FusedArithmetic::here() {
                FusedArithmetic::InVectors if is_fused => {
                    Box::new(ByError::new(&plan, t0, together::<N, <F64x8 as Lanes>::Fused, H>(t0, bodies)))
                }
                _ => Box::new(ByError::new(&plan, t0, together::<N, F64x8, H>(t0, bodies))),
            })
        })
    }

    fn begun(
        (plan, begin): (Plan, Begin<'a, N, Stepping<H>>),
        t0: f64,
        bodies: Vec<(H, PointOf<N, H>)>,
        eight: impl Fn(&[(H, PointOf<N, H>)]) -> Result<InLanesOf<'a, N, H>, Reason>,
    ) -> Result<Self, Stop> {
        let alone = bodies.iter().map(|_| None).collect();
        let mut flows = Self { plan, begin, t: t0, eights: Vec::new(), alone };
        flows.fill(bodies, eight).map_err(|reason| flows.stopped_by(reason))?;
        Ok(flows)
    }

    fn fill(
        &mut self,
        bodies: Vec<(H, PointOf<N, H>)>,
        eight: impl Fn(&[(H, PointOf<N, H>)]) -> Result<InLanesOf<'a, N, H>, Reason>,
    ) -> Result<(), Reason> {
        self.plan.checked_method(&H::Model::DESCRIPTION)?;
        if !self.t.is_finite() {
            return Err(Setting::Time { name: "the time of the start", given: self.t }.into());
        }
        self.plan.checked_step(self.t, self.t)?;
        for bodies in bodies.chunks(EIGHT) {
            self.eights.push(eight(bodies)?);
        }
        for (number, (handle, point)) in bodies.into_iter().enumerate() {
            self.put(number, handle, point)?;
        }
        Ok(())
    }
}

impl<'a, const N: usize, H: Handle<N> + 'a> Flows<'a, N, H>
where
    H::Model: InLanes<N>,
{
    /// Puts a body into its lane, or aside.
    fn put(&mut self, number: usize, handle: H, point: PointOf<N, H>) -> Result<(), Reason> {
        placed_at(H::Model::DESCRIPTION.constraint, &(self.t, point))?;
        let steps = self.steps(number);
        let fits =
            self.eight_mut(number).is_some_and(|(eight, lane)| eight.put(lane, &handle, &point, steps));
        let alone = if fits { None } else { Some(self.stepped(handle, (self.t, point), steps)?) };
        self.goes(number, alone);
        Ok(())
    }

    /// Lets a body go by itself, or in its lane.
    fn goes(&mut self, number: usize, alone: Option<Stepped<'a, N, H>>) {
        if let (Some(_), Some((eight, lane))) = (&alone, self.eight_mut(number)) {
            eight.rest(lane);
        }
        if let Some(place) = self.alone.get_mut(number) {
            *place = alone.map(|body| Box::new(Alone { body, stop: None }));
        }
    }

    /// A body by itself, after so many steps.
    fn stepped(
        &self,
        handle: H,
        start: (f64, PointOf<N, H>),
        steps: u64,
    ) -> Result<Stepped<'a, N, H>, Reason> {
        let moving = Moving { handle: Stepping(handle), begin: self.begin };
        let mut body = Stepped::begin(moving, self.plan.clone(), start)?;
        body.has_cost(Statistics { steps, ..Statistics::default() });
        Ok(body)
    }

    /// Steps that a body has taken, in lanes and by itself; none where there is no such body.
    fn steps(&self, number: usize) -> u64 {
        match self.alone.get(number) {
            Some(Some(alone)) => alone.body.statistics().steps,
            Some(None) => self.eight(number).map_or(0, |(eight, lane)| eight.steps(lane)),
            None => 0,
        }
    }

    /// Where a body is in lanes, or would be.
    fn eight(&self, number: usize) -> Option<(&InLanesOf<'a, N, H>, usize)> {
        self.eights.get(number / EIGHT).map(|eight| (eight, number % EIGHT))
    }

    fn eight_mut(&mut self, number: usize) -> Option<(&mut InLanesOf<'a, N, H>, usize)> {
        self.eights.get_mut(number / EIGHT).map(|eight| (eight, number % EIGHT))
    }

    /// Number of bodies.
    #[must_use]
    pub fn len(&self) -> usize {
        self.alone.len()
    }

    /// There are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.alone.is_empty()
    }

    /// Time reached.
    #[must_use]
    pub fn t(&self) -> f64 {
        self.t
    }

    /// The phase point that a body has reached; `None` where there are fewer.
    #[must_use]
    pub fn point(&self, number: usize) -> Option<PointOf<N, H>> {
        match self.alone.get(number)? {
            Some(alone) => Some(alone.body.point()),
            None => self.eight(number).map(|(eight, lane)| eight.point(lane)),
        }
    }

    /// The phase points of all bodies, in their order.
    pub fn points(&self) -> impl Iterator<Item = PointOf<N, H>> {
        (0..self.len()).filter_map(|number| self.point(number))
    }

    /// The model of a body; `None` where there are fewer.
    #[must_use]
    pub fn model(&self, number: usize) -> Option<&H::Model> {
        self.handle(number).map(Handle::model)
    }

    fn handle(&self, number: usize) -> Option<&H> {
        match self.alone.get(number)? {
            Some(alone) => Some(&alone.body.moving().handle.0),
            None => self.eight(number).map(|(eight, lane)| eight.handle(lane)),
        }
    }

    /// Puts a body elsewhere, at the time reached. One that had stopped goes on with the others.
    ///
    /// # Errors
    /// Those of a point that is none, [`Setting::Body`] for a body that is none; the body stays as it is.
    pub fn set_point(&mut self, number: usize, point: PointOf<N, H>) -> Result<(), Stop> {
        let put = self.handle(number).cloned().ok_or(self.no_body(number));
        put.and_then(|handle| self.put(number, handle, point)).map_err(|reason| self.stays(number, reason))
    }

    /// Replaces the model of a body by one with other fields; placement and momenta stay what they are. One that had stopped goes
    /// on with the others.
    ///
    /// # Errors
    /// As [`set_point`](Self::set_point) of the point reached.
    pub fn set_model(&mut self, number: usize, model: H) -> Result<(), Stop> {
        let put = self.point(number).ok_or(self.no_body(number));
        put.and_then(|point| self.put(number, model, point)).map_err(|reason| self.stays(number, reason))
    }

    /// Largest number of steps to one time; a million if not set. Equal steps are counted before they are taken: where there would
    /// be more, no body moves. Of steps by their error each body takes as many as it may.
    pub fn set_max_steps(&mut self, max_steps: u64) {
        self.plan.max_steps = max_steps;
        self.alone.iter_mut().flatten().for_each(|alone| alone.body.limit(max_steps));
    }

    fn no_body(&self, number: usize) -> Reason {
        Setting::Body { number, of: self.len() }.into()
    }

    /// Why a body stays where it is.
    fn stays(&self, number: usize, reason: Reason) -> Stop {
        Stop { reason, t: self.t, steps: self.steps(number) }
    }

    /// Why all bodies stay where they are, after the most steps that one of them has taken.
    fn stopped_by(&self, reason: Reason) -> Stop {
        let steps = (0..self.len()).map(|number| self.steps(number)).max();
        Stop { reason, t: self.t, steps: steps.unwrap_or(0) }
    }

    /// The bodies that did not come to the time reached, with the reasons. Each is at its last good point, from which
    /// [`advance_to`](Self::advance_to) tries again, unless it is [put elsewhere](Self::set_point).
    pub fn stopped(&self) -> impl Iterator<Item = (usize, &Stop)> {
        let alone = self.alone.iter().enumerate();
        alone.filter_map(|(number, alone)| Some((number, alone.as_ref()?.stop.as_ref()?)))
    }
}

impl<'a, const N: usize, H: Handle<N> + Send + Sync + 'a> Flows<'a, N, H>
where
    H::Model: InLanes<N>,
    PointOf<N, H>: Send,
{
    /// Moves all bodies on by a time, forward or backward; by none they stay, but for those that had stopped, which try again.
    ///
    /// # Errors
    /// As [`advance_to`](Self::advance_to); [`Setting::Step`] for a time that is lost in the rounding of [`t`](Self::t).
    pub fn advance(&mut self, dt: f64) -> Result<(), Stop> {
        let (t0, t_end) = (self.t, self.t + dt);
        if t_end == t0 && dt != 0.0 {
            return Err(self.stopped_by(Setting::Step { given: dt.abs(), t0, t_end }.into()));
        }
        self.advance_to(t_end)
    }

    /// Moves all bodies to a time, earlier or later, which is reached exactly. Those that had stopped try again, also to get to the
    /// time that the others have reached.
    ///
    /// # Errors
    /// A [`Stop`] of settings, before anything has moved; else that of the first body that did not get there. All others are there
    /// even so: [`stopped`](Self::stopped) tells which are not.
    pub fn advance_to(&mut self, t_end: f64) -> Result<(), Stop> {
        self.has_way(t_end).map_err(|reason| self.stopped_by(reason))?;
        let left = match t_end == self.t {
            true => Ok(Vec::new()),
            false => all_moved(&mut self.eights, (t_end, self.plan.max_steps)),
        };
        let of_failure =
            |failure| failed(failure, (self.plan.method, self.plan.tolerance), H::Model::DESCRIPTION.name);
        let left = left.map_err(|failure| self.stopped_by(of_failure(failure)))?;
        self.t = t_end;
        self.alone.iter_mut().flatten().for_each(|alone| alone.move_to(t_end));
        let mut begun = Ok(());
        for (place, left) in left {
            begun = begun.and(self.leave(EIGHT * place + left.lane, left));
        }
        let first = self.stopped().next().map(|(_, stop)| *stop);
        begun.and(first.map_or(Ok(()), Err))
    }

    /// Lets a body go on by itself from where it left its lane.
    fn leave(&mut self, number: usize, left: Left<H, PointOf<N, H>>) -> Result<(), Stop> {
        let (t, reason) = (left.from.0, Reason::StepLimit { limit: self.plan.max_steps });
        let steps = left.steps;
        let body = self.stepped(left.handle, left.from, steps);
        self.goes(number, Some(body.map_err(|reason| Stop { reason, t, steps })?));
        let t_end = self.t;
        match self.alone.get_mut(number) {
            Some(Some(alone)) if left.is_limited => alone.stop = Some(Stop { reason, t, steps }),
            Some(Some(alone)) => alone.move_to(t_end),
            _ => {}
        }
        Ok(())
    }

    /// There is a time to move to, by no more steps than there may be.
    fn has_way(&self, t_end: f64) -> Result<(), Reason> {
        if !t_end.is_finite() {
            return Err(Setting::Time { name: "the time to move to", given: t_end }.into());
        }
        long_enough(self.t, t_end)?;
        self.plan.checked_step(self.t, t_end)?;
        if t_end == self.t {
            return Ok(());
        }
        let (limit, step) = (self.plan.max_steps, self.plan.method.step());
        // Steps of their own lengths are one at least, and counted for each body.
        let least = step.map_or(1, |step| step_count(self.t, t_end, step).unwrap_or(u64::MAX));
        if least <= limit { Ok(()) } else { Err(Reason::StepLimit { limit }) }
    }
}

impl<'a, const N: usize, H: Handle<N> + 'a> Alone<'a, N, H> {
    fn move_to(&mut self, t_end: f64) {
        let moved = self.body.move_to(t_end);
        let (t, steps) = (self.body.t(), self.body.statistics().steps);
        self.stop = moved.err().map(|reason| Stop { reason, t, steps });
    }
}

impl<'a, const N: usize, H: Handle<N> + 'a> fmt::Debug for Flows<'a, N, H>
where
    H::Model: InLanes<N>,
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Flows")
            .field("model", &H::Model::DESCRIPTION.name)
            .field("bodies", &self.len())
            .field("alone", &self.alone.iter().flatten().count())
            .field("t", &self.t)
            .field("method", &self.plan.method)
            .finish_non_exhaustive()
    }
}
