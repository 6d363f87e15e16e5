//! One step, whatever its size, and the polynomial over it.

use core::marker::PhantomData;

use super::field::{STAGES, Stages};
use super::judged::Judged;
use crate::lie::{Coordinates, Flat, Sum};
use affine_core::model::StateVector;

/// The stages of an explicit method with error estimators and dense output; [`DormandPrince853`](super::DormandPrince853) and
/// [`DormandPrince54`](super::DormandPrince54).
pub trait Pair: Sized {
    /// Name of its integration.
    const NAME: &'static str;
    /// Order of the leading term of the error estimate in the step size.
    const ERROR_ORDER: f64;
    /// Steps aim at an error so many times below the tolerance.
    const MARGIN: f64;
    /// Number and node of each stage after the first of an attempted step, which depends on the one before and others.
    const STAGES: &'static [(usize, f64)];
    /// Evaluations of an attempted step.
    const EVALUATIONS: u64 = Self::STAGES.len() as u64;
    /// Evaluations of the dense output.
    const DENSE_EVALUATIONS: u64;
    /// Does the error estimate need the slope at the end of the step?
    const NEEDS_END: bool;
    /// Are sums over stages long enough to be compiled for the most registers too? With AVX-512 the steps of order 8 take 5
    /// percent less time where they are in vectors. Those over single components do not, and those of the baseline.
    const SUMS_ARE_LONG: bool;

    /// Where the slope of a stage is evaluated, by its place in [`STAGES`](Self::STAGES), after the stage with the slope
    /// `newest`.
    fn place<S: StateVector<f64>>(step: &OneStep<Self, S>, f: &impl Stages<S>, stage: usize, newest: &S)
    -> S;

    /// What the solution rises by in the step, divided by `h`.
    fn rise<S: StateVector<f64>>(step: &OneStep<Self, S>, f: &impl Stages<S>) -> S;

    /// Differences, divided by `h`, of this to the rises of the embedded solutions.
    fn error_slopes<S: StateVector<f64>>(step: &OneStep<Self, S>, f: &impl Stages<S>, rise: &S) -> (S, S);

    /// The error estimate from the squares of the sizes of these.
    fn error(squares: (f64, f64)) -> f64;

    /// The largest of these estimates in a norm: of numbers alone, and compiled once for all models.
    fn largest(judged: &Judged<'_>) -> f64;

    /// The last coefficients of the dense output, divided by `h`.
    fn dense<S: StateVector<f64>>(step: &mut OneStep<Self, S>, f: &impl Stages<S>) -> [S; 4];
}

/// A step of a method from `(t, y)`: for callers with their own control of the step size, and for measuring the
/// order.
#[derive(Clone, Debug)]
pub struct OneStep<P, S> {
    t: f64,
    y: S,
    t_trial: f64,
    y_trial: S,
    accepted: bool,
    /// `k_1` to at most `k_12`; `k_13 = f` at the end of the step, the `k_1` of the next; the rest for dense output.
    stages: [S; STAGES],
    pair: PhantomData<P>,
}

impl<P: Pair, S: StateVector<f64>> OneStep<P, S> {
    /// At `(t, y)`, before any step. One evaluation.
    pub fn start(f: &impl Fn(f64, &S) -> S, t: f64, y: S) -> Self {
        Self::at(t, y, f(t, &y))
    }

    /// At `(t, y)` where `f(t, y) = slope`.
    pub(super) fn at(t: f64, y: S, slope: S) -> Self {
        let mut stages = [S::zeros(); STAGES];
        stages[0] = slope;
        Self { t, y, t_trial: t, y_trial: y, accepted: false, stages, pair: PhantomData }
    }

    /// Computes the step to the time `end`, from the same point as before: [`Pair::EVALUATIONS`].
    #[inline(always)]
    pub fn attempt(&mut self, f: &impl Fn(f64, &S) -> S, end: f64) {
        self.attempt_in(f, end);
    }

    /// The same, with sums of its own: what the step rises by, divided by `h`.
    #[inline(always)]
    pub(super) fn attempt_in(&mut self, f: &impl Stages<S>, end: f64) -> S {
        self.t_trial = end;
        self.accepted = false;
        // One after the other in a loop, where the equations stand once, and in the caches once. The newest slope goes
        // from one turn to the next in registers: the next place waits for it.
        let mut newest = self.stages[0];
        for (stage, (number, node)) in P::STAGES.iter().enumerate() {
            let place = P::place(self, f, stage, &newest);
            newest = f.slope(self.time_at(*node), &place);
            self.stages[number - 1] = newest;
        }
        let rise = P::rise(self, f);
        // One product with the length, whose rounding is that of the whole sum.
        self.y_trial = f.plus_multiple(&self.y, self.length(), &rise);
        rise
    }

    /// Accepts the step: evaluates the slope at its end. One evaluation.
    #[inline]
    pub fn accept(&mut self, f: &impl Fn(f64, &S) -> S) {
        self.set_end(f(self.t_trial, &self.y_trial));
        self.keep();
    }

    /// Accepts the step, at whose end the slope is known.
    #[inline]
    pub(super) fn keep(&mut self) {
        self.accepted = true;
    }

    /// Keeps the slope at the end of the attempted step.
    #[inline]
    pub(super) fn set_end(&mut self, slope: S) {
        self.stages[12] = slope;
    }

    /// The slope at the end of the step.
    pub(super) fn end_slope(&self) -> &S {
        &self.stages[12]
    }

    /// Turns to the next step, which begins where this one ended.
    #[inline]
    pub fn begin_next(&mut self) {
        if self.accepted {
            self.t = self.t_trial;
            self.y = self.y_trial;
            self.stages[0] = self.stages[12];
            self.accepted = false;
        }
    }

    /// Turns to the next step, which begins at the time when this one ended, at `y` with `f(t, y) = slope`.
    #[inline]
    pub(super) fn begin_next_at(&mut self, y: S, slope: S) {
        if self.accepted {
            self.t = self.t_trial;
            self.y = y;
            self.stages[0] = slope;
            self.accepted = false;
        }
    }

    /// Dense output of an accepted step: [`Pair::DENSE_EVALUATIONS`].
    pub fn dense(&mut self, f: &impl Fn(f64, &S) -> S) -> Dense<S> {
        self.dense_in(f)
    }

    /// The same, with sums of its own.
    pub(super) fn dense_in(&mut self, f: &impl Stages<S>) -> Dense<S> {
        let last = P::dense(self, f);
        let h = self.length();
        let mut coefficients = [S::zeros(); 7];
        for i in 0..S::LEN {
            let rise = self.y_trial.as_ref()[i] - self.y.as_ref()[i];
            let (begin, end) = (h * self.stages[0].as_ref()[i], h * self.stages[12].as_ref()[i]);
            coefficients[0].as_mut()[i] = rise;
            coefficients[1].as_mut()[i] = begin - rise;
            coefficients[2].as_mut()[i] = 2.0 * rise - (begin + end);
        }
        for (coefficient, combination) in coefficients[3..].iter_mut().zip(last) {
            for (c, r) in coefficient.as_mut().iter_mut().zip(combination.as_ref()) {
                *c = h * r;
            }
        }
        let base = Sum::of(self.y);
        Dense {
            t: self.t,
            t_end: self.t_trial,
            y: self.y,
            y_end: self.y_trial,
            coefficients,
            coordinates: Flat,
            base,
        }
    }

    /// Time at the end of the step as far as it is accepted.
    #[must_use]
    pub fn end_time(&self) -> f64 {
        if self.accepted { self.t_trial } else { self.t }
    }

    /// State at the end of the step as far as it is accepted.
    #[must_use]
    pub fn end(&self) -> &S {
        if self.accepted { &self.y_trial } else { &self.y }
    }

    pub(super) fn trial_end(&self) -> &S {
        &self.y_trial
    }

    /// `h`, the exact difference of the two times wherever it is a floating-point number.
    pub(super) fn length(&self) -> f64 {
        self.t_trial - self.t
    }

    /// `k_s = f(t + c_s h, y + h sum_j a_sj k_j)`, by stage and node.
    #[inline(always)]
    pub(super) fn stage<const TERMS: usize>(
        &mut self,
        f: &impl Stages<S>,
        (number, node): (usize, f64),
        row: &[(usize, f64); TERMS],
    ) {
        let place = self.place(f, &self.stages[row[TERMS - 1].0 - 1], row);
        self.stages[number - 1] = f.slope(self.time_at(node), &place);
    }

    /// `y + h sum_j a_j k_j`, where the last `k_j` of the row is `newest`.
    #[inline(always)]
    pub(super) fn place<const TERMS: usize>(
        &self,
        f: &impl Stages<S>,
        newest: &S,
        row: &[(usize, f64); TERMS],
    ) -> S {
        f.moved(&self.y, self.length(), (&self.stages, newest), row)
    }

    /// `t + c h`, the end itself for `c = 1`.
    #[inline(always)]
    fn time_at(&self, node: f64) -> f64 {
        if node == 1.0 { self.t_trial } else { self.t + node * self.length() }
    }

    /// `sum_j a_j k_j`.
    #[inline(always)]
    pub(super) fn combination<const TERMS: usize>(
        &self,
        f: &impl Stages<S>,
        row: &[(usize, f64); TERMS],
    ) -> S {
        f.combination(&self.stages, row)
    }
}

/// Dense output: a polynomial of degree 7 in `theta = (t - t_n)/h` with an error of order `h^8`,
/// `y_n + theta (r_1 + (1 - theta)(r_2 + theta (r_3 + (1 - theta)(r_4 + theta (r_5 + (1 - theta)(r_6 + theta
/// r_7))))))` (Hairer, Norsett, Wanner, section II.6), `r_1 = y_{n+1} - y_n`, `r_2 = h k_1 - r_1`,
/// `r_3 = 2 r_1 - h (k_1 + k_13)`, `r_i = h sum_j d_ij k_j` beyond. Value and slope are exact at both ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dense<S, C = Flat> {
    t: f64,
    t_end: f64,
    y: S,
    y_end: S,
    coefficients: [S; 7],
    coordinates: C,
    base: Sum<S>,
}

impl<L: StateVector<f64>> Dense<L> {
    /// The same polynomial of states that are stored otherwise.
    pub(super) fn read<S: StateVector<f64>>(self, read: impl Fn(&L) -> S) -> Dense<S> {
        let Self { t, t_end, y, y_end, coefficients, .. } = self;
        let (y, y_end) = (read(&y), read(&y_end));
        let mut of_states = [y; 7];
        for (of_state, coefficient) in of_states.iter_mut().zip(&coefficients) {
            *of_state = read(coefficient);
        }
        Dense { t, t_end, y, y_end, coefficients: of_states, coordinates: Flat, base: Sum::of(y) }
    }
}

impl<S: StateVector<f64>> Dense<S> {
    /// The same polynomial, for coordinates around `base`, of a step that ends at the state `y_end`.
    pub(super) fn around<C>(self, coordinates: C, base: Sum<S>, y_end: S) -> Dense<S, C> {
        let Self { t, t_end, y, coefficients, .. } = self;
        Dense { t, t_end, y, y_end, coefficients, coordinates, base }
    }
}

impl<S: StateVector<f64>, C: Coordinates<S>> Dense<S, C> {
    /// The state at a time within the step.
    #[must_use]
    pub fn at(&self, t: f64) -> S {
        // The end is y_{n+1} itself, not y_n + r_1, which rounds.
        if t == self.t_end {
            return self.y_end;
        }
        let theta = (t - self.t) / (self.t_end - self.t);
        let mut y = S::zeros();
        for (i, value) in y.as_mut().iter_mut().enumerate() {
            for (k, coefficient) in self.coefficients.iter().enumerate().rev() {
                let factor = if k % 2 == 0 { theta } else { 1.0 - theta };
                *value = (*value + coefficient.as_ref()[i]) * factor;
            }
            *value += self.y.as_ref()[i];
        }
        self.coordinates.state(&self.base, &y).value
    }
}
