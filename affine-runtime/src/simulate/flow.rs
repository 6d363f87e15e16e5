//! A body that is stepped: for loops that are not the library's own.

use core::fmt;

use super::mechanics::Moving;
use super::method::Method;
use super::methods::{automatic, named};
use super::motion::{PointOf, Stepping};
use super::settings::Plan;
use super::stepped::Stepped;
use crate::error::{Reason, Setting, Stop};
use crate::integrate::Statistics;
use crate::model::{Handle, Model};

/// A model, a state, a time and a method: the motion of one body, step by step, for frame loops of graphics, games and
/// control.
///
/// A frame ends exactly where it was asked to, in as many steps as the method takes: equal ones that are not longer than
/// its `step`, or steps by their error, whose length goes on from frame to frame. Every step is looked at as in a
/// [`Simulation`](super::Simulation), which steps in the same way and adds outputs, events and energies; nothing else is
/// computed, and after the construction nothing is allocated. Between frames point and model may be replaced.
///
/// ```
/// use affine_runtime::model::Owned;
/// use affine_runtime::prelude::*;
///
/// #[affine_model(
///     dim = 3, kinetic(dalembert = 0.1, space_translation = 1),
///     potential = orthogonality(1e3) + g*x[3], emit(splitting),
/// )]
/// #[derive(Clone, Copy)]
/// struct Block {
///     g: f64,
/// }
///
/// let block = Block { g: 9.81 }.prepare()?;
/// let rest = Matrix::<3>::zeros();
/// let start = block.at_velocity(Vector::<3>::new(0.0, 0.0, 5.0), Matrix::identity(), Vector::zeros(), rest)?;
/// let dt = 1.0 / 60.0;
/// let mut flow = Flow::by(Method::Splitting { order: 2, step: dt / 4.0 }, Owned(block), (0.0, start))?;
/// for frame in 1..=30 {
///     flow.advance_to(f64::from(frame) * dt)?;
/// }
/// assert_eq!(flow.t(), 0.5);
/// assert!((flow.point().x()[2] - (5.0 - 9.81 / 8.0)).abs() < 1e-12);
///
/// flow.set_model(Owned(Block { g: -1.0 }.prepare()?)); // from here on it rises
/// flow.advance(dt)?;
/// # Ok::<(), affine_runtime::Error>(())
/// ```
///
/// The model is lent, `&model`, shared, `Arc`, or kept by the flow, [`Owned`](crate::model::Owned), see [`Handle`].
/// A flow stays in the thread where it was made, since a model may hold what threads do not share; many bodies move in parallel
/// where each thread makes its own.
pub struct Flow<'a, const N: usize, H: Handle<N> + 'a> {
    body: Stepped<'a, N, H>,
}

impl<'a, const N: usize, H: Handle<N> + 'a> Flow<'a, N, H> {
    /// The flow of a model from a phase point at a time, by [`Method::Automatic`] and to the tolerance
    /// 1e-10.
    ///
    /// How far it will go is not known: for stiff friction, which the choice of a run sees by that, name [`Method::Radau`].
    ///
    /// # Errors
    /// As [`by`](Self::by).
    pub fn new(model: H, start: (f64, PointOf<N, H>)) -> Result<Self, Stop> {
        Self::begun(Moving { handle: Stepping(model), begin: automatic }, Plan::default(), start)
    }

    /// The flow by a method. Only programs that name one have the integrators compiled for their models that the automatic
    /// choice never takes.
    ///
    /// # Errors
    /// A [`Stop`] with [`Reason::Setting`] for a method that the model does not have or that makes no sense, or for a time
    /// that is no number; with the reasons of a [`Simulation`](super::Simulation) for a start at which there is no motion.
    pub fn by(method: Method, model: H, start: (f64, PointOf<N, H>)) -> Result<Self, Stop> {
        Self::begun(
            Moving { handle: Stepping(model), begin: named },
            Plan { method, ..Plan::default() },
            start,
        )
    }

    fn begun(
        moving: Moving<'a, N, Stepping<H>>,
        plan: Plan,
        start: (f64, PointOf<N, H>),
    ) -> Result<Self, Stop> {
        let body = Stepped::begin(moving, plan, start);
        body.map(|body| Self { body }).map_err(|reason| Stop { reason, t: start.0, steps: 0 })
    }

    /// Moves on by a time, forward or backward; by none it stays.
    ///
    /// # Errors
    /// As [`advance_to`](Self::advance_to); [`Setting::Step`](super::Setting::Step) for a time that is lost in the rounding of
    /// [`t`](Self::t).
    pub fn advance(&mut self, dt: f64) -> Result<(), Stop> {
        let (t0, t_end) = (self.t(), self.t() + dt);
        if t_end == t0 && dt != 0.0 {
            return Err(self.stopped(Setting::Step { given: dt.abs(), t0, t_end }.into()));
        }
        self.advance_to(t_end)
    }

    /// Moves to a time, earlier or later, which is reached exactly.
    ///
    /// # Errors
    /// A [`Stop`] with the reason, the number of steps, and the time of the last good point, at which the flow stays:
    /// it can go on from there, also after the limit of [`set_max_steps`](Self::set_max_steps).
    pub fn advance_to(&mut self, t: f64) -> Result<(), Stop> {
        let moved = self.body.move_to(t);
        moved.map_err(|reason| self.stopped(reason))
    }

    /// Time reached.
    #[must_use]
    pub fn t(&self) -> f64 {
        self.body.t()
    }

    /// Phase point reached.
    #[must_use]
    pub fn point(&self) -> PointOf<N, H> {
        self.body.point()
    }

    /// The phase point at a time within the last step: by the dense output of the method where it has one, by a shorter step
    /// from the same beginning elsewhere. The motion stays where it is.
    ///
    /// # Errors
    /// [`Setting::OutsideStep`](super::Setting::OutsideStep) for another time; the reasons of a step.
    pub fn interpolate(&mut self, t: f64) -> Result<PointOf<N, H>, Stop> {
        let interpolated = self.body.between(t);
        interpolated.map_err(|reason| self.stopped(reason))
    }

    /// Puts the body elsewhere, at the time reached.
    ///
    /// # Errors
    /// Those of a point that is none; the flow stays as it is.
    pub fn set_point(&mut self, point: PointOf<N, H>) -> Result<(), Stop> {
        let put = self.body.put((self.t(), point));
        put.map_err(|reason| self.stopped(reason))
    }

    /// Sets the time, at the point reached.
    ///
    /// # Errors
    /// [`Setting::Time`](super::Setting::Time); the flow stays as it is.
    pub fn set_time(&mut self, t: f64) -> Result<(), Stop> {
        let put = self.body.put((t, self.point()));
        put.map_err(|reason| self.stopped(reason))
    }

    fn stopped(&self, reason: Reason) -> Stop {
        Stop { reason, t: self.t(), steps: self.statistics().steps }
    }

    /// The model.
    #[must_use]
    pub fn model(&self) -> &H::Model {
        self.body.moving().handle.model()
    }

    /// Replaces the model by one with other fields; placement and momenta stay what they are, and velocities follow where
    /// inertias are others.
    pub fn set_model(&mut self, model: H) {
        self.body.replace(model);
    }

    /// Goes on by another method; allocates.
    ///
    /// # Errors
    /// As [`by`](Self::by); the flow stays as it is.
    pub fn set_method(&mut self, method: Method) -> Result<(), Stop> {
        let moving = Moving { handle: self.body.moving().handle.clone(), begin: named };
        self.renewed(moving, Plan { method, ..self.body.plan().clone() })
    }

    /// Relative error allowed in each step of a method whose steps follow it, as in
    /// [`Simulation::tolerance`](super::Simulation::tolerance); allocates.
    ///
    /// # Errors
    /// A tolerance that is none; the flow stays as it is.
    pub fn set_tolerance(&mut self, tolerance: f64) -> Result<(), Stop> {
        self.renewed(self.body.moving().clone(), Plan { tolerance, ..self.body.plan().clone() })
    }

    fn renewed(&mut self, moving: Moving<'a, N, Stepping<H>>, plan: Plan) -> Result<(), Stop> {
        let spent = self.statistics();
        let next = Self::begun(moving, plan, (self.t(), self.point()));
        let mut next = next.map_err(|stop| Stop { steps: spent.steps, ..stop })?;
        next.body.has_cost(spent);
        *self = next;
        Ok(())
    }

    /// Largest number of steps to one time; a million if not set.
    pub fn set_max_steps(&mut self, max_steps: u64) {
        self.body.limit(max_steps);
    }

    /// Cost so far; nothing is counted for a closed form.
    #[must_use]
    pub fn statistics(&self) -> Statistics {
        self.body.statistics()
    }
}

impl<'a, const N: usize, H: Handle<N> + 'a> fmt::Debug for Flow<'a, N, H> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Flow")
            .field("model", &H::Model::DESCRIPTION.name)
            .field("t", &self.t())
            .field("point", &self.point())
            .field("method", &self.body.plan().method)
            .field("statistics", &self.statistics())
            .finish_non_exhaustive()
    }
}
