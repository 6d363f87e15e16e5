//! A simulation and its settings.

use core::ops::ControlFlow;

use super::checkpoint::Checkpoint;
use super::dense::Dense;
use super::event::Event;
use super::mechanics::Moving;
use super::method::Method;
use super::methods;
use super::motion::{Begin, Followed};
use super::output::Output;
use super::progress::Progress;
use super::settings::Settings;
use crate::model::Model;

/// A simulation to be run: model, start, time interval, accuracy and output.
///
/// ```text
/// let run = Simulation::new(&model, start).until(50.0).tolerance(1e-12).every(0.1).run()?;
/// ```
///
/// Settings are checked by [`run`](Self::run).
pub struct Simulation<'a, const N: usize, M: Model<N>> {
    pub(super) model: &'a M,
    pub(super) settings: Settings<'a, N, M::Point<f64>>,
    pub(super) begin: Begin<'a, N, Followed<'a, M>>,
}

impl<'a, const N: usize, M: Model<N>> Simulation<'a, N, M> {
    /// A simulation of `model` from the phase point `start` at time 0.
    #[must_use]
    pub fn new(model: &'a M, start: M::Point<f64>) -> Self {
        Self { model, settings: Settings::new(start), begin: methods::automatic }
    }

    /// Time of the start; 0 if not set.
    #[must_use]
    pub fn from(mut self, t0: f64) -> Self {
        self.settings.plan.t0 = t0;
        self
    }

    /// Time of the end, before or after the start, at least 1e-300 away from it or at the same time. The end is hit
    /// exactly.
    #[must_use]
    pub fn until(mut self, t_end: f64) -> Self {
        self.settings.plan.t_end = Some(t_end);
        self
    }

    /// Relative error allowed in each step, in the norm of [`ErrorNorm`](affine_integrators::ErrorNorm):
    /// `1e-15 <= eps < 1`; 1e-10 if not set. A closed form is exact up to rounding whatever `eps`.
    #[must_use]
    pub fn tolerance(mut self, eps: f64) -> Self {
        self.settings.plan.tolerance = eps;
        self
    }

    /// Output at exactly these times, in the direction of time. Without it and without [`every`](Self::every): at
    /// every accepted step, start and end included; a closed form has no steps, and gives 101 equidistant times, or start and
    /// end where the interval is as short as the rounding of times.
    #[must_use]
    pub fn output(mut self, times: impl IntoIterator<Item = f64>) -> Self {
        self.settings.plan.output = Output::At(times.into_iter().collect());
        self
    }

    /// Output at the start, then at every `dt > 0` of elapsed time, and at the end; at most 1e8 times.
    #[must_use]
    pub fn every(mut self, dt: f64) -> Self {
        self.settings.plan.output = Output::Every(dt);
        self
    }

    /// Keeps the motion between the outputs, for [`Trajectory::at`](super::Trajectory::at) at any time afterwards. Steps and outputs
    /// stay what they are.
    ///
    /// A step is kept as a polynomial of degree 4, 8, 16 or 32 for each number of a phase point, in several parts where that is not
    /// enough: within a tenth of the tolerance of the sizes of placement, affine spin and linear momentum at the times of each part
    /// at which it is looked at, and within a third between them. Methods with equal steps take the tolerance for that alone. Of degree 8, the rule at the default, it is 1.7 kB in three dimensions and
    /// 0.9 kB in two. A closed form is kept as it is, in some hundred bytes.
    ///
    /// A rotation or a dilatation that steps leave out, since they are known in closed form, takes half a kilobyte a radian in three
    /// dimensions. Where it turns by more than some ten thousand radians in a step, or 2e5 in a run, and within 1e-9 of a step
    /// around a kink, nothing is kept, and [`Trajectory::at`](super::Trajectory::at) is an error.
    ///
    /// Runge-Kutta and Taylor steps cost little more; a method that has no polynomial of its own takes a shorter step for each
    /// of some 15 times, of a step with a kink in the force for some hundreds.
    #[must_use]
    pub fn dense(mut self) -> Self {
        self.settings.dense = Some(Dense::extend);
        self
    }

    /// The method; [`Method::Automatic`] if not set. Only programs that name one, whichever, have the integrators compiled for
    /// their models that the automatic choice never takes.
    #[must_use]
    pub fn method(mut self, method: Method) -> Self {
        self.begin = methods::named;
        self.by_default(method)
    }

    /// One of the methods that the automatic choice has.
    pub(super) fn by_default(mut self, method: Method) -> Self {
        self.settings.plan.method = method;
        self
    }

    pub(super) fn moving(&self) -> Moving<'a, N, Followed<'a, M>> {
        Moving { handle: Followed(self.model), begin: self.begin }
    }

    /// Largest number of accepted steps; a million if not set.
    #[must_use]
    pub fn max_steps(mut self, max_steps: u64) -> Self {
        self.settings.plan.max_steps = max_steps;
        self
    }

    /// Called after every accepted step (every output of a closed form), and on the way after every few samples of a closed
    /// form for [`Event`]s, every thousand samples of a step, and every change of the point; `ControlFlow::Break(())` ends the
    /// run.
    #[must_use]
    pub fn progress(mut self, callback: impl FnMut(&Progress) -> ControlFlow<()> + 'a) -> Self {
        self.settings.progress = Some(Box::new(callback));
        self
    }

    /// Called with time and phase point at every output; `ControlFlow::Break(())` ends the run after it.
    #[must_use]
    pub fn observe(mut self, callback: impl FnMut(f64, &M::Point<f64>) -> ControlFlow<()> + 'a) -> Self {
        self.settings.observe = Some(Box::new(callback));
        self
    }

    /// An event to look for, in addition to those named before. Events at one time happen in the order of their
    /// statements; after a change of the point those happen that still do from there.
    #[must_use]
    pub fn event(mut self, event: Event<'a, N, M::Point<f64>>) -> Self {
        self.settings.events.push(event);
        self
    }

    /// Goes on where a run of the same settings was interrupted, [`Trajectory::checkpoint`](super::Trajectory::checkpoint): with
    /// the same bits, on machines of one [kind of arithmetic](affine_integrators::FusedArithmetic), as if it had not been; on another,
    /// [`why`](super::Trajectory::why) says so. A checkpoint of another model, parameters, start, method,
    /// tolerance, interval, outputs or events is refused, [`Setting::Checkpoint`](super::Setting::Checkpoint); the largest number
    /// of steps may be another. Outputs and events are those from there on; the end that was asked for is that of both runs.
    /// Functions of events have no memory. An event that stopped the run is not met again.
    #[must_use]
    pub fn resume(mut self, checkpoint: &Checkpoint) -> Self {
        self.settings.checkpoint = Some(checkpoint.clone());
        self
    }
}

impl<const N: usize, M: Model<N>> core::fmt::Debug for Simulation<'_, N, M> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Simulation")
            .field("model", &M::DESCRIPTION.name)
            .field("start", &self.settings.start)
            .field("plan", &self.settings.plan)
            .finish_non_exhaustive()
    }
}
