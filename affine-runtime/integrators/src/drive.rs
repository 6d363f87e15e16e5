//! The two drivers of all methods: steps by their error, and equal steps.

use core::fmt;

use super::equal_steps::EqualSteps;
use super::step_size::{Controller, next_time, shortest};
use super::tape::Tape;
use super::{Failure, Statistics};
use affine_core::__private::Vectors;
use affine_core::model::StateVector;

/// Steps of an integration that names no limit.
pub const DEFAULT_MAX_STEPS: u64 = 1_000_000;

/// A method whose steps are as long as a tolerance allows.
pub trait AdaptiveMethod {
    /// What is integrated.
    type State: StateVector<f64>;
    /// What it is called.
    const NAME: &'static str;
    /// Time reached.
    fn t(&self) -> f64;
    /// State reached.
    fn y(&self) -> &Self::State;
    /// Takes one accepted step, not beyond the end of the interval.
    ///
    /// # Errors
    /// [`Failure`]; the state stays that of the last accepted step.
    fn step(&mut self, control: &mut Control) -> Result<(), Failure>;
    /// The state at a time within the last step.
    ///
    /// # Errors
    /// [`Failure::NotFinite`], but the integration can go on.
    fn at(&mut self, t: f64, control: &mut Control) -> Result<Self::State, Failure>;
    /// What the next steps depend on, beside the control.
    fn exchange(&mut self, tape: &mut impl Tape);
    /// What an evaluation of the equations, as they are counted here, stands for.
    fn worth(&self) -> u64 {
        1
    }
}

/// One attempted step after the other, each judged by its error.
pub(crate) trait Attempt: AdaptiveMethod {
    /// A step that may be accepted.
    type Trial;
    /// Turns to the next step.
    fn begin(&mut self, control: &mut Control);
    /// A step to the time `end`, and its error relative to the tolerance, NaN where something is not finite; `None` where its
    /// equations are not solved.
    fn attempt(
        &mut self,
        vectors: impl Vectors,
        end: f64,
        control: &mut Control,
    ) -> Option<(Self::Trial, f64)>;
    /// Goes to the end of a step.
    fn accept(&mut self, trial: Self::Trial, end: f64, control: &mut Control);
}

/// Where steps by their error lead, how long the next one is, and what they cost.
#[derive(Clone, Debug)]
pub struct Control {
    pub(crate) tolerance: f64,
    pub(crate) controller: Controller,
    /// Length of the next step.
    pub(crate) length: f64,
    pub(crate) t_end: f64,
    pub(crate) statistics: Statistics,
    failure: Option<Failure>,
}

/// A step whose equations are not solved is tried again as long as this part of it (Hairer, Wanner, Solving Ordinary
/// Differential Equations II, section IV.8).
const AFTER_NO_SOLUTION: f64 = 0.25;

/// A first step that is so many times the shortest can be shortened.
const ROOM: f64 = 1024.0;

impl Control {
    pub(crate) fn new(
        (t_end, tolerance): (f64, f64),
        controller: Controller,
        length: f64,
        evaluations: u64,
    ) -> Self {
        let statistics = Statistics { evaluations, ..Statistics::default() };
        Self { tolerance, controller, length, t_end, statistics, failure: None }
    }

    /// One accepted step, by attempts of the length that their errors allow.
    #[inline(always)]
    pub(crate) fn by_error<M: Attempt>(
        &mut self,
        method: &mut M,
        vectors: impl Vectors,
    ) -> Result<(), Failure> {
        method.begin(self);
        let t = method.t();
        // Where times are far apart, no step is short: what is not finite then does not belong to the motion.
        let has_room = self.statistics.steps > 0 || self.length > ROOM * shortest(t, t);
        loop {
            let end = next_time(t, self.length, self.t_end);
            if end == t {
                return Err(Failure::StepUnderflow);
            }
            let tried = (end - t).abs();
            let failed = match method.attempt(vectors, end, self) {
                Some((trial, error)) if error <= 1.0 => {
                    method.accept(trial, end, self);
                    self.statistics.steps += 1;
                    self.length = tried * self.controller.accept(error);
                    self.controller.took(tried);
                    return Ok(());
                }
                Some((_, error)) => {
                    self.length = tried * self.controller.reject(error);
                    if error.is_finite() || !has_room { Failure::StepUnderflow } else { Failure::NotFinite }
                }
                None => {
                    self.length = AFTER_NO_SOLUTION * tried;
                    // However short: there is no one step of which a defect could be told.
                    Failure::StepUnderflow
                }
            };
            self.statistics.rejected += 1;
            if self.length <= shortest(t, self.t_end) {
                return Err(failed);
            }
        }
    }
}

/// Integration from `t0` to `t_end`, in either direction of time, in steps by their error.
#[derive(Clone)]
pub struct Adaptive<M> {
    pub(crate) method: M,
    pub(crate) control: Control,
}

impl<M: AdaptiveMethod> Adaptive<M> {
    /// Takes one accepted step; does nothing at `t_end`, which the last step hits exactly.
    ///
    /// # Errors
    /// [`Failure`], now and ever after; the state stays that of the last accepted step.
    // Not optimised a second time as a part of its only caller.
    #[inline(never)]
    pub fn advance(&mut self) -> Result<(), Failure> {
        if let Some(failure) = self.control.failure {
            return Err(failure);
        }
        if self.is_finished() {
            return Ok(());
        }
        let stepped = self.method.step(&mut self.control);
        self.control.failure = stepped.err();
        stepped
    }

    /// The state at the end, by at most so many steps.
    ///
    /// # Errors
    /// [`Failure`]: [`Failure::StepLimit`] where these do not reach it.
    #[doc(hidden)]
    pub fn finish(mut self, limit: u64) -> Result<M::State, Failure> {
        while !self.is_finished() {
            if self.control.statistics.steps == limit {
                return Err(Failure::StepLimit { limit });
            }
            self.advance()?;
        }
        Ok(*self.y())
    }

    /// The state at a time within the last step; the state reached where no step has been taken.
    ///
    /// # Errors
    /// [`Failure::NotFinite`], but the integration can go on.
    pub fn at(&mut self, t: f64) -> Result<M::State, Failure> {
        self.method.at(t, &mut self.control)
    }

    /// Goes on to another end of the interval.
    #[doc(hidden)]
    pub fn aim(&mut self, t_end: f64) {
        self.control.t_end = t_end;
    }

    /// Everything that the next steps depend on, of an integration between two steps.
    #[doc(hidden)]
    pub fn exchange(&mut self, tape: &mut impl Tape) {
        self.method.exchange(tape);
        tape.number(&mut self.control.length);
        self.control.controller.exchange(tape);
        tape.statistics(&mut self.control.statistics);
    }

    /// Time reached.
    #[must_use]
    pub fn t(&self) -> f64 {
        self.method.t()
    }

    /// State reached.
    #[must_use]
    pub fn y(&self) -> &M::State {
        self.method.y()
    }

    /// `t_end` is reached.
    #[must_use]
    pub fn is_finished(&self) -> bool {
        self.t() == self.control.t_end
    }

    /// Cost so far, with that of [`at`](Self::at).
    #[must_use]
    pub fn statistics(&self) -> Statistics {
        let evaluations = self.control.statistics.evaluations * self.method.worth();
        Statistics { evaluations, ..self.control.statistics }
    }
}

impl<M: AdaptiveMethod> fmt::Debug for Adaptive<M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct(M::NAME)
            .field("t", &self.t())
            .field("y", self.y())
            .field("t_end", &self.control.t_end)
            .field("tolerance", &self.control.tolerance)
            .field("statistics", &self.statistics())
            .finish_non_exhaustive()
    }
}

/// A method whose accuracy is its step.
pub trait EqualStepMethod {
    /// What is integrated.
    type State: StateVector<f64>;
    /// A state with what is known of it.
    type Point: Copy;
    /// What it is called.
    const NAME: &'static str;
    /// The state of a point.
    fn state(point: &Self::Point) -> &Self::State;
    /// Moves a point by the time `h`, where the step before, if there is one, had the length `last`.
    ///
    /// # Errors
    /// [`Failure::NoSolution`], [`Failure::NotFinite`]; what is left of the point then has no meaning.
    fn step(&mut self, from: (f64, &mut Self::Point), h: f64, last: Option<f64>) -> Result<(), Failure>;
    /// The same from where the last step, of length `last`, began, without influence on the steps.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    fn within(&mut self, from: (f64, &mut Self::Point), h: f64, last: f64) -> Result<(), Failure> {
        self.step(from, h, Some(last))
    }
    /// Evaluations of the equations so far.
    fn evaluations(&self) -> u64;
    /// What the next steps depend on, beside the point reached.
    fn exchange(&mut self, tape: &mut impl Tape);
    /// The point reached.
    fn exchange_point(tape: &mut impl Tape, point: &mut Self::Point);
    /// That is all that the next steps depend on.
    fn is_exchanged(&self) -> bool {
        true
    }
    /// The largest residual of implicit steps so far.
    fn residual(&self) -> Option<f64> {
        None
    }
}

/// Integration from `t0` to `t_end`, in either direction of time, in `n = ceil(|t_end - t0|/step)` equal steps.
#[derive(Clone)]
pub struct Equal<M: EqualStepMethod> {
    pub(crate) method: M,
    pub(crate) steps: EqualSteps<M::Point>,
}

impl<M: EqualStepMethod> Equal<M> {
    /// Takes one step; does nothing at `t_end`, which the last step hits exactly.
    ///
    /// # Errors
    /// [`Failure::NoSolution`] or [`Failure::NotFinite`], now and ever after; the state stays that of the last step.
    pub fn advance(&mut self) -> Result<(), Failure> {
        let Self { method, steps } = self;
        steps.take(|(t, from), to, h, last| {
            *to = *from;
            method.step((t, to), h, last)
        })
    }

    /// The state at a time within the last step, by a shorter step of the same method from its beginning, which leaves
    /// the steps as they are. Costs about as many evaluations as a step. The state reached where no step has been taken.
    ///
    /// # Errors
    /// As [`advance`](Self::advance), but the integration can go on.
    pub fn at(&mut self, t: f64) -> Result<M::State, Failure> {
        let Some((from, mut point, h)) = self.steps.again_to(t) else { return Ok(*self.y()) };
        if h != 0.0 {
            self.method.within((from, &mut point), h, self.steps.last_length())?;
        }
        Ok(*M::state(&point))
    }

    /// Goes on to another end of the interval.
    ///
    /// # Errors
    /// [`Failure::Time`], [`Failure::Step`] where there are no steps to it; the end stays what it was.
    #[doc(hidden)]
    pub fn aim(&mut self, t_end: f64) -> Result<(), Failure> {
        self.steps.aim(t_end)
    }

    /// Everything that the next steps depend on, where [`is_exchanged`](Self::is_exchanged).
    #[doc(hidden)]
    pub fn exchange(&mut self, tape: &mut impl Tape) {
        self.steps.exchange(tape, |tape, end| M::exchange_point(tape, end));
        self.method.exchange(tape);
    }

    /// What is [exchanged](Self::exchange) is all that the next steps depend on.
    #[doc(hidden)]
    #[must_use]
    pub fn is_exchanged(&self) -> bool {
        self.method.is_exchanged()
    }

    /// Time reached.
    #[must_use]
    pub fn t(&self) -> f64 {
        self.steps.t()
    }

    /// State reached.
    #[must_use]
    pub fn y(&self) -> &M::State {
        M::state(self.steps.end())
    }

    /// `t_end` is reached.
    #[must_use]
    pub fn is_finished(&self) -> bool {
        self.steps.is_finished()
    }

    /// Length of the steps, negative backward in time.
    #[must_use]
    pub fn step_length(&self) -> f64 {
        self.steps.times().length()
    }

    /// Cost so far, with that of [`at`](Self::at). No step is rejected.
    #[must_use]
    pub fn statistics(&self) -> Statistics {
        Statistics {
            steps: self.steps.taken(),
            evaluations: self.method.evaluations(),
            ..Statistics::default()
        }
    }

    /// The largest residual that an implicit step left so far; `None` for explicit ones.
    #[must_use]
    pub fn residual(&self) -> Option<f64> {
        self.method.residual()
    }
}

impl<M: EqualStepMethod> fmt::Debug for Equal<M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct(M::NAME)
            .field("t", &self.t())
            .field("y", self.y())
            .field("steps", self.steps.times())
            .field("statistics", &self.statistics())
            .finish_non_exhaustive()
    }
}
