//! Embedded explicit Runge-Kutta methods of orders 8 and 5 with step size control and dense output.

mod dormand_prince_54;
mod dormand_prince_853;
pub(crate) mod field;
#[cfg(feature = "std")]
pub(crate) mod in_lanes;
mod judged;
mod pair;
pub(crate) mod start;
mod step;
#[cfg(test)]
mod trees;

use field::called;
use field::{Field, InVectors};
use judged::Judged;
pub use pair::{DormandPrince54, DormandPrince853, Step};
pub use step::{Dense, OneStep, Pair};

use super::Failure;
use super::drive::{Adaptive, AdaptiveMethod, Attempt, Control};
use super::error_norm::ErrorNorm;
use super::finite::is_finite;
use super::lie::{Coordinates, Flat, Sum};
use super::step_size::Controller;
use super::tape::Tape;
use super::vectors::Baseline;
use super::widest::{Work, roomiest, widest};
use affine_core::__private::Vectors;
use affine_core::model::{Group, StateVector};
use affine_core::system::Packing;
use start::Start;

/// The method of Dormand and Prince of order 8.
///
/// With `e_5`, `e_3` the differences to the embedded solutions of orders 5 and 3, the estimated error is
/// `h |e_5|^2 / sqrt(|e_5|^2 + 0.01 |e_3|^2)`, which is of order `h^8` (Hairer, Norsett, Wanner, Solving Ordinary
/// Differential Equations I, (10.17)).
///
/// Cost: 12 evaluations per accepted step, 11 (or 12, where only the slope at its end is not finite) per rejected
/// one, 3 for the dense output of a step.
pub type RungeKutta8<S, F, C = Flat, L = S> = RungeKutta<DormandPrince853, S, F, C, L>;

/// The method of Dormand and Prince of order 5, the usual baseline.
///
/// The estimated error is the difference to the embedded solution of order 4, of order `h^5`. Cost: 6 evaluations per
/// step, accepted or rejected; the dense output is free. At one tolerance it errs some tens of times more than order 8, see
/// [`Method::RungeKutta5`](../enum.Method.html#variant.RungeKutta5).
pub type RungeKutta5<S, F, C = Flat, L = S> = RungeKutta<DormandPrince54, S, F, C, L>;

/// Adaptive integration of `y' = f(t, y)` from `t0` to `t_end`, in either direction of time, by an embedded explicit
/// Runge-Kutta method: [`RungeKutta8`] or [`RungeKutta5`].
///
/// A step is accepted when its estimated error, relative to the tolerance in the [`ErrorNorm`], is at most 1. The
/// tolerance bounds the error of each step; what accumulates depends on the problem.
///
/// Cost: that of the steps; at the start 2 evaluations, and one for each component of a momentum.
pub type RungeKutta<P, S, F, C = Flat, L = S> = Adaptive<RungeKuttaSteps<P, S, F, C, L>>;

/// The steps of an embedded explicit method.
#[derive(Clone)]
pub struct RungeKuttaSteps<P, S, F, C, L> {
    field: F,
    coordinates: C,
    error_norm: ErrorNorm,
    /// In the coordinates around `begin`.
    step: OneStep<P, L>,
    begin: Sum<S>,
    /// The state reached.
    end: Sum<S>,
    /// Its time derivative.
    rate: S,
    /// That of the state at the end of an attempted step.
    trial_rate: S,
    /// The dense output of the last step, which is formed once for all times in it.
    dense: Option<Dense<S, C>>,
}

impl<P: Pair, S: StateVector<f64>, F: Fn(f64, &S) -> S> RungeKutta<P, S, F> {
    /// The integration at its start: `groups` lay out the state vector for the [`ErrorNorm`].
    ///
    /// # Errors
    /// [`Failure::NotFinite`] where `y0` or `f(t0, y0)` is not finite; [`Failure::Time`] for an interval and
    /// [`Failure::Tolerance`] for a tolerance that make no sense.
    pub fn new(
        f: F,
        groups: &'static [Group],
        start: (f64, S),
        t_end: f64,
        tolerance: f64,
    ) -> Result<Self, Failure> {
        Self::within(Flat, f, groups, start, t_end, tolerance)
    }
}

impl<P: Pair, S: StateVector<f64>, K, R: Packing<S, K>> RungeKutta<P, S, InVectors<R, K>, Flat, R::Packed> {
    /// The integration at its start, with steps in vectors of four.
    ///
    /// # Errors
    /// As [`new`](RungeKutta::new).
    #[inline(always)]
    pub fn in_vectors(
        field: InVectors<R, K>,
        groups: &'static [Group],
        start: (f64, S),
        t_end: f64,
        tolerance: f64,
    ) -> Result<Self, Failure> {
        Self::begun(Flat, field, groups, start, t_end, tolerance)
    }
}

impl<P: Pair, S: StateVector<f64>, F: Fn(f64, &S) -> S, C: Coordinates<S>> RungeKutta<P, S, F, C> {
    /// The integration at its start, in other coordinates: on a group, in the chart around the beginning of each step.
    /// Errors are those of the state itself, in the norm of `groups`.
    ///
    /// # Errors
    /// As [`new`](RungeKutta::new).
    #[inline(always)]
    pub fn within(
        coordinates: C,
        f: F,
        groups: &'static [Group],
        start: (f64, S),
        t_end: f64,
        tolerance: f64,
    ) -> Result<Self, Failure> {
        Self::begun(coordinates, f, groups, start, t_end, tolerance)
    }
}

impl<P: Pair, S: StateVector<f64>, F: Field<S, C, L>, C: Coordinates<S>, L: StateVector<f64>>
    RungeKutta<P, S, F, C, L>
{
    #[inline(always)]
    fn begun(
        coordinates: C,
        field: F,
        groups: &'static [Group],
        (t0, y0): (f64, S),
        t_end: f64,
        tolerance: f64,
    ) -> Result<Self, Failure> {
        let f = |t: f64, y: &S| called(|| field.rate(t, y));
        let (start, evaluations) = Start::of::<P>(&f, groups, (t0, &y0), t_end, tolerance)?;
        let Start { slope, error_norm, length } = start;
        let controller = Controller::of(P::ERROR_ORDER, P::MARGIN);
        let begin = Sum::of(y0);
        let origin = coordinates.origin(&begin).value;
        let velocity = coordinates.velocity(&y0, &origin, &slope);
        let [origin, velocity] = [&origin, &velocity].map(|state| field.stored(state));
        let control = Control::new((t_end, tolerance), controller, length, evaluations);
        // In place: it is some kilobytes.
        Ok(Self {
            method: RungeKuttaSteps {
                field,
                coordinates,
                error_norm,
                step: OneStep::at(t0, origin, velocity),
                begin,
                end: begin,
                rate: slope,
                trial_rate: slope,
                dense: None,
            },
            control,
        })
    }

    /// Dense output over the last accepted step: [`Pair::DENSE_EVALUATIONS`].
    pub fn dense(&mut self) -> Dense<S, C> {
        self.method.dense(&mut self.control)
    }
}

impl<P: Pair, S: StateVector<f64>, F: Field<S, C, L>, C: Coordinates<S>, L: StateVector<f64>>
    RungeKuttaSteps<P, S, F, C, L>
{
    fn dense(&mut self, control: &mut Control) -> Dense<S, C> {
        *self.dense.get_or_insert_with(|| {
            control.statistics.evaluations += P::DENSE_EVALUATIONS;
            let dense = self.step.dense_in(&self.field.stages(Baseline, self.coordinates, &self.begin));
            dense.read(|stored| self.field.read(stored)).around(self.coordinates, self.begin, self.end.value)
        })
    }

    /// The slope at the end of the attempted step.
    #[inline(always)]
    fn slope_at(&mut self, vectors: impl Vectors, end: f64, reached: &S) {
        let (rate, slope) = self.field.at(vectors, self.coordinates, end, (reached, self.step.trial_end()));
        self.trial_rate = rate;
        self.step.set_end(slope);
    }

    /// Estimated error of the attempted step relative to the tolerance; NaN where something is not finite.
    #[inline(always)]
    fn error(&self, vectors: impl Vectors, (rise, reached): (&L, &S), control: &Control) -> f64 {
        let stages = self.field.stages(vectors, self.coordinates, &self.begin);
        let (first, second) = P::error_slopes(&self.step, &stages, rise);
        // One by one: what arrays are mapped by is not compiled for the vectors of the processor.
        let first = self.coordinates.change(&self.begin, &self.field.read(&first));
        let second = self.coordinates.change(&self.begin, &self.field.read(&second));
        let length = self.step.length().abs();
        let relative = P::largest(&Judged {
            error_norm: &self.error_norm,
            lasting: control.controller.lasting(length),
            states: [self.begin.value.as_ref(), reached.as_ref()],
            slopes: [first.as_ref(), second.as_ref()],
        });
        length / control.tolerance * relative
    }
}

impl<P: Pair, S: StateVector<f64>, F: Field<S, C, L>, C: Coordinates<S>, L: StateVector<f64>> AdaptiveMethod
    for RungeKuttaSteps<P, S, F, C, L>
{
    type State = S;
    const NAME: &'static str = P::NAME;

    fn t(&self) -> f64 {
        self.step.end_time()
    }

    fn y(&self) -> &S {
        &self.end.value
    }

    fn step(&mut self, control: &mut Control) -> Result<(), Failure> {
        if const { P::SUMS_ARE_LONG && F::IS_IN_VECTORS } {
            roomiest(Advance(self, control))
        } else {
            widest(Advance(self, control))
        }
    }

    fn at(&mut self, t: f64, control: &mut Control) -> Result<S, Failure> {
        if t == self.t() {
            return Ok(self.end.value);
        }
        Ok(self.dense(control).at(t))
    }

    fn exchange(&mut self, tape: &mut impl Tape) {
        let mut t = self.t();
        tape.number(&mut t);
        tape.sum(&mut self.end);
        tape.state(&mut self.rate);
        let origin = self.coordinates.origin(&self.end).value;
        let velocity = self.coordinates.velocity(&self.end.value, &origin, &self.rate);
        self.step = OneStep::at(t, self.field.stored(&origin), self.field.stored(&velocity));
        (self.begin, self.dense) = (self.end, None);
    }
}

impl<P: Pair, S: StateVector<f64>, F: Field<S, C, L>, C: Coordinates<S>, L: StateVector<f64>> Attempt
    for RungeKuttaSteps<P, S, F, C, L>
{
    type Trial = Sum<S>;

    /// Turns to the next step, in coordinates around the state reached.
    #[inline(always)]
    fn begin(&mut self, _control: &mut Control) {
        let origin = self.coordinates.origin(&self.end).value;
        let velocity = self.coordinates.velocity(&self.end.value, &origin, &self.rate);
        (self.begin, self.dense) = (self.end, None);
        self.step.begin_next_at(self.field.stored(&origin), self.field.stored(&velocity));
    }

    /// Where the step is good, the slope at its end is computed too.
    #[inline(always)]
    fn attempt(&mut self, vectors: impl Vectors, end: f64, control: &mut Control) -> Option<(Sum<S>, f64)> {
        control.statistics.evaluations += P::EVALUATIONS + u64::from(P::NEEDS_END);
        let rise = self.step.attempt_in(&self.field.stages(vectors, self.coordinates, &self.begin), end);
        let reached = self.coordinates.state(&self.begin, &self.field.read(self.step.trial_end()));
        if P::NEEDS_END {
            self.slope_at(vectors, end, &reached.value);
        }
        let error = self.error(vectors, (&rise, &reached.value), control);
        if !P::NEEDS_END && error <= 1.0 {
            control.statistics.evaluations += 1;
            self.slope_at(vectors, end, &reached.value);
        }
        let leads_nowhere = error <= 1.0 && !is_finite(self.step.end_slope());
        Some((reached, if leads_nowhere { f64::NAN } else { error }))
    }

    #[inline(always)]
    fn accept(&mut self, reached: Sum<S>, _end: f64, _control: &mut Control) {
        self.rate = self.trial_rate;
        self.step.keep();
        self.end = reached;
    }
}

/// An accepted step of an integration, all of it on the vectors of a processor: what is done between two steps is as long as
/// an evaluation or two.
struct Advance<'a, P, S, F, C, L>(&'a mut RungeKuttaSteps<P, S, F, C, L>, &'a mut Control);

impl<P: Pair, S: StateVector<f64>, F: Field<S, C, L>, C: Coordinates<S>, L: StateVector<f64>> Work
    for Advance<'_, P, S, F, C, L>
{
    type Output = Result<(), Failure>;
    #[inline(always)]
    fn run(self, vectors: impl Vectors) -> Result<(), Failure> {
        self.1.by_error(self.0, vectors)
    }
}
