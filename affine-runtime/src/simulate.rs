//! Simulations: from a start to output times, with everything that can stop them.

mod accumulation;
mod checkpoint;
mod closed_form;
mod collapse;
mod conservation;
#[cfg(feature = "csv")]
mod csv;
mod departure;
mod domain;
mod ensemble;
mod event;
mod fingerprint;
mod follow;
mod layout;
mod mechanics;
mod methods;
mod motion;
mod orientation;
mod outcome;
mod output;
mod point;
mod power_balance;
mod range;
mod recorder;
mod root;
mod round_trip;
mod run;
mod settings;
mod signature;
mod standing;
mod stepper;
mod stiffness;
mod trajectory;
mod watcher;
mod why;
mod witness;

use core::ops::ControlFlow;

pub use crate::error::{Callback, Reason, Setting, Stop};
pub use checkpoint::Checkpoint;
pub use conservation::{Conservation, Drift};
pub use ensemble::{Ends, Ensemble};
pub use event::{Direction, Event, Occurrence};
pub use outcome::{Halt, Outcome};
pub use power_balance::PowerBalance;
pub use round_trip::RoundTrip;
pub use trajectory::{Computation, Trajectory};
pub use why::Why;

#[cfg(feature = "report")]
pub(crate) use layout::has_multiplier;

use crate::model::Model;
use mechanics::{Integrate, Moving};
use output::Output;
use settings::Settings;

/// How a trajectory is computed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum Method {
    /// The closed form where model and start have one; else, where `emit(nystrom)` asked for it and unless there
    /// are events, which look at times within steps, [`Method::RungeKuttaNystrom12`], or at tolerances above
    /// [`NYSTROM_TOLERANCE`] [`Method::RungeKuttaNystrom8`]; else [`Method::Taylor`] where `emit(taylor)` asked
    /// for it and the tolerance is at most [`TAYLOR_TOLERANCE`]; else [`Method::RungeKutta8`]. Before these two, and unless
    /// there are events, [`Method::AdaptiveSplitting`] where `emit(splitting)` gave a stiff dilatation a closed form within a
    /// piece and the tolerance lets steps pass over several turns of it. The motion of a body under a
    /// constraint is integrated in charts of its group, see [`Chart`](crate::integrate::lie::Chart), by Runge-Kutta
    /// steps and by Gauss collocation: the placement stays on the group up to rounding.
    #[default]
    Automatic,
    /// The closed form; an error where there is none.
    ClosedForm,
    /// Embedded explicit Runge-Kutta method of order 8, [`RungeKutta8`](crate::integrate::RungeKutta8).
    RungeKutta8,
    /// Embedded explicit Runge-Kutta method of order 5, [`RungeKutta5`](crate::integrate::RungeKutta5): the usual baseline. Its
    /// estimate is that of its fourth-order solution and its steps are many, so that more is left of a tolerance: the
    /// vibrating body errs by 8 to 75 tolerances at t = 50, from 1e-2 to 1e-12, where order 8 errs by 1 to 3, as
    /// `cargo run --release --example vibrating_body` prints. With its dilatation in the state it is 25 to 210 for 3 to 5
    /// (`cargo test -p affine-runtime --test simulation order_5 -- --nocapture`), and what adds up grows with the time.
    RungeKutta5,
    /// Taylor series, [`Taylor`](crate::integrate::Taylor), of a model with `emit(taylor)`; an error for others.
    Taylor {
        /// The order, 2 to 32; `None`: the one that suits the tolerance.
        order: Option<usize>,
    },
    /// Runge-Kutta-Nystrom method of order 12, [`RungeKuttaNystrom`](crate::integrate::RungeKuttaNystrom), of a model
    /// with `emit(nystrom)`, whose equations are `q'' = f(t, q)`; an error for others. Output times between steps are
    /// reached by a shorter step from the one before.
    RungeKuttaNystrom12,
    /// The same of order 8.
    RungeKuttaNystrom8,
    /// Gauss collocation, [`Gauss`](crate::integrate::Gauss): implicit, symmetric, of order `2 stages`, in equal
    /// steps; the tolerance plays no part. Keeps every linear and quadratic first integral of the reduced equations
    /// up to rounding, and is symplectic where the reduced variables are canonical, `phi` and `Pi`. With affine spins
    /// the variables are Lie-Poisson: there the method is no Poisson map, and energy and cubic Casimir invariants
    /// are kept to its order, unless they are quadratic in the reduced variables. Output times between steps are
    /// reached by a shorter step from the one before, which leaves the sequence of steps as it is.
    /// [`Method::Automatic`] never takes it, for at equal errors it costs several times as much, however stiff the body:
    /// `cargo run --release --example work_precision -- symplectic` shows it. Four and six stages cost less than two and
    /// three where errors are below about 1e-6.
    Gauss {
        /// Number of stages, 2, 3, 4 or 6.
        stages: usize,
        /// Length of a step, positive; the interval is divided into equal steps that are not longer.
        step: f64,
    },
    /// [`Rattle`](crate::integrate::Rattle), for isochoric bodies with `H = T(Pi) + U(phi)`: explicit but for its
    /// multiplier, symmetric, in equal steps; the tolerance plays no part. Keeps both constraints, and spin and vorticity
    /// where they are conserved, up to rounding, and is symplectic on the constrained phase space. Output times between
    /// steps are reached by a shorter step from the one before.
    Rattle {
        /// Order of the composition, 2, 4, 6 or 8: of 1, 5, 9 or 17 steps.
        order: usize,
        /// Length of a step, positive; the interval is divided into equal steps that are not longer.
        step: f64,
    },
    /// Exact flows of pieces of the Hamiltonian in turn, [`Splitting`](crate::integrate::Splitting), of a model with
    /// `emit(splitting)`; an error for others. Explicit, symmetric, in equal steps; the tolerance plays no part. A step
    /// is a symplectic (Poisson) map, and keeps momentum maps and Casimirs up to rounding. Output times between steps are
    /// reached by a shorter step from the one before, which leaves the sequence of steps as it is.
    ///
    /// [`Method::Automatic`] never takes it: what it is for is what it keeps, over runs that are longer than the motion can
    /// be followed, and its steps know no tolerance, as those of [`Method::AdaptiveSplitting`] do. The stiff dilatation that
    /// a reduction separates is separated for every method alike. Where it stays in the state and the potential of an
    /// isotropic energy is `U_dil(q)`, quadratic or hyperbolic, and anything else, it moves along its closed form here, in
    /// one piece with the Casimirs, by elliptic functions: steps need not resolve it, as those of every other method do.
    /// (Forces `dW/dq` that change with it can move it by `t dW/dq/(m w)` where steps take whole swings of its frequency
    /// `w`.)
    Splitting {
        /// The order, 2, 4, 6 or 8.
        order: usize,
        /// Length of a step, positive; the interval is divided into equal steps that are not longer.
        step: f64,
    },
    /// The same in steps by their error, [`AdaptiveSplitting`](crate::integrate::AdaptiveSplitting): for a stiff dilatation that
    /// a piece has in closed form. Momentum maps and Casimirs are kept up to rounding, but the motion as a whole is not
    /// symplectic: the energy is kept to the tolerance, and may drift. Output times between steps are reached by shorter
    /// steps from the one before; within a step that passes over many turns of the dilatation an event may be missed.
    AdaptiveSplitting {
        /// The order, 2, 4, 6 or 8; `None`: 4.
        order: Option<usize>,
    },
}

impl Method {
    /// Length of the equal steps, where that is what the method takes.
    pub(crate) fn step(self) -> Option<f64> {
        match self {
            Method::Gauss { step, .. } | Method::Rattle { step, .. } | Method::Splitting { step, .. } => {
                Some(step)
            }
            Method::Automatic
            | Method::ClosedForm
            | Method::RungeKutta8
            | Method::RungeKutta5
            | Method::RungeKuttaNystrom12
            | Method::RungeKuttaNystrom8
            | Method::AdaptiveSplitting { .. }
            | Method::Taylor { .. } => None,
        }
    }
}

/// How far a run has come.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Progress {
    /// Time of the start.
    pub t0: f64,
    /// Time reached.
    pub t: f64,
    /// Time to reach.
    pub t_end: f64,
    /// Accepted steps so far; output times so far for a closed form, since an event has changed the point.
    pub steps: u64,
}

impl Progress {
    /// Part of the time interval that is done, 0 to 1.
    #[must_use]
    pub fn fraction(&self) -> f64 {
        if self.t == self.t_end { 1.0 } else { (self.t - self.t0) / (self.t_end - self.t0) }
    }
}

/// Tolerance of a simulation that names none.
pub const DEFAULT_TOLERANCE: f64 = 1e-10;
/// The largest tolerance of bodies whose mass matrix may degenerate at some placements, sums of energies of different frames: a
/// larger error leads motions onto such a placement that only pass near it. `cargo test --test sums near_degenerate` holds random
/// bodies picked for that: with steps of this tolerance all go through, but one that passes a pivot below ten tolerances.
pub const NEAR_DEGENERATE: f64 = 1e-6;
/// [`Method::Automatic`] takes Taylor series from this tolerance down, where they were emitted: from there on they
/// cost less at equal errors on all benchmark problems but P3, which takes the Nystrom method; on P2 already from an
/// error of 1e-5.
pub const TAYLOR_TOLERANCE: f64 = 1e-8;
/// [`Method::Automatic`] takes the Nystrom method of order 12 from this tolerance down, and that of order 8 above. On P3
/// order 8 needs less time down to an error of 1e-4, where order 12 begins to, and at a given tolerance errs ten times
/// less.
pub const NYSTROM_TOLERANCE: f64 = 1e-3;
/// Steps of a simulation that names no limit.
pub const DEFAULT_MAX_STEPS: u64 = 1_000_000;

type Watch<'a> = Box<dyn FnMut(&Progress) -> ControlFlow<()> + 'a>;
type Observe<'a, P> = Box<dyn FnMut(f64, &P) -> ControlFlow<()> + 'a>;

/// A simulation to be run: model, start, time interval, accuracy and output.
///
/// ```text
/// let run = Simulation::new(&model, start).until(50.0).tolerance(1e-12).every(0.1).run()?;
/// ```
///
/// Settings are checked by [`run`](Self::run).
pub struct Simulation<'a, const N: usize, M: Model<N>> {
    model: &'a M,
    settings: Settings<'a, N, M::Point<f64>>,
    integrate: Integrate<N, M>,
}

impl<'a, const N: usize, M: Model<N>> Simulation<'a, N, M> {
    /// A simulation of `model` from the phase point `start` at time 0.
    #[must_use]
    pub fn new(model: &'a M, start: M::Point<f64>) -> Self {
        Self { model, settings: Settings::new(start), integrate: methods::automatic }
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

    /// Relative error allowed in each step, in the norm of [`ErrorNorm`](crate::integrate::ErrorNorm):
    /// `1e-15 <= eps < 1`; [`DEFAULT_TOLERANCE`] if not set. A closed form is exact up to rounding whatever `eps`.
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

    /// The method; [`Method::Automatic`] if not set. Only programs that name one, whichever, have the integrators compiled for
    /// their models that the automatic choice never takes.
    #[must_use]
    pub fn method(mut self, method: Method) -> Self {
        self.integrate = methods::named;
        self.by_default(method)
    }

    /// One of the methods that the automatic choice has.
    fn by_default(mut self, method: Method) -> Self {
        self.settings.plan.method = method;
        self
    }

    fn moving(&self) -> Moving<'a, N, M> {
        Moving { model: self.model, integrate: self.integrate }
    }

    /// Largest number of accepted steps; [`DEFAULT_MAX_STEPS`] if not set.
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

    /// Goes on where a run of the same settings was interrupted, [`Trajectory::checkpoint`]: with the same bits, on the
    /// same machine, as if it had not been. A checkpoint of another model, parameters, start, method, tolerance, interval,
    /// outputs or events is refused, [`Setting::Checkpoint`]; the largest number of steps may be another. Outputs and events
    /// are those from there on; the end that was asked for is that of both runs. Functions of events have no memory. An event
    /// that stopped the run is not met again.
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
