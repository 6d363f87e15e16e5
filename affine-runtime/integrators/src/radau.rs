//! Radau IIA collocation: implicit, for motions with friction that is fast and dies out.

mod coefficients;
mod polynomial;
mod solve;
mod work;

pub use coefficients::Tableau;
pub use solve::{Differences, Exact, Jacobian};

use core::fmt;

use super::error_norm::{ErrorNorm, GROUPS};
use super::finite::is_finite;
use super::lie::{Coordinates, Flat, Sum};
use super::newton::Newton;
use super::step_size::{Controller, first_step, next_time, shortest};
use super::tape::Tape;
use super::{Failure, Statistics, sound};
use affine_core::__private::numerics::norm;
use affine_core::model::{Group, Quantity, StateVector};
use coefficients::{MODES, MOST_STAGES};
use solve::{Field, Problem, Stages, plus};
use work::Work;

/// Adaptive integration of `y' = f(t, y)` from `t0` to `t_end`, in either direction of time, by Radau IIA collocation of 3, 5
/// or 7 stages (order 5, 9 or 13; E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, section IV.8, and
/// J. Comput. Appl. Math. 111 (1999) 93-111).
///
/// L-stable and stiffly accurate: what dies out faster than a step is long is gone at its end, and the number of steps does
/// not depend on how fast that was. Not symplectic, and of no use where nothing dies out.
///
/// The stage equations are solved by Newton's iteration with a Jacobian of each step, `1 + dim y` evaluations, from the
/// collocation polynomial of the step before. An error is estimated by an embedded solution of order `s`, filtered by the
/// Jacobian, and held in the [`ErrorNorm`], where the floor of a momentum is at most the largest that the body has had.
/// `work`, which nothing depends on, is integrated along the collocation polynomial at nodes that are not those of the
/// stages: energy and work close only where the motion is right. Nothing allocates; the factors take 64 KiB.
#[derive(Clone)]
pub struct Radau<S, F, J, C = Flat> {
    f: F,
    jacobian: J,
    coordinates: C,
    tableau: &'static Tableau,
    newton: Newton<S, MODES>,
    error_norm: ErrorNorm,
    /// The largest that each group has been.
    largest: [f64; GROUPS],
    tolerance: f64,
    controller: Controller,
    t: f64,
    begin: Sum<S>,
    end: Sum<S>,
    /// The time derivative of the state reached.
    rate: S,
    /// Of the last step, and its length, zero before the first.
    stages: Stages<S>,
    h: f64,
    length: f64,
    t_end: f64,
    /// The next step has none before it that its error could be judged by.
    unjudged: bool,
    work: Option<Work>,
    failure: Option<Failure>,
    statistics: Statistics,
}

impl<S: StateVector<f64>, F: Fn(f64, &S) -> S, J: Jacobian<S>> Radau<S, F, J> {
    /// The integration at its start; `jacobian` is [`Exact`] or [`Differences`]. Two evaluations, and one for each
    /// component of a momentum.
    ///
    /// # Errors
    /// [`Failure::NotFinite`] where `y0` or `f(t0, y0)` is not finite; [`Failure::Time`] for an interval and
    /// [`Failure::Tolerance`] for a tolerance that make no sense; [`Failure::NoSolution`] for a state of more than 32
    /// components.
    pub fn new(
        (f, jacobian): (F, J),
        tableau: &'static Tableau,
        groups: &'static [Group],
        start: (f64, S),
        t_end: f64,
        tolerance: f64,
    ) -> Result<Self, Failure> {
        Self::within(Flat, (f, jacobian), tableau, groups, start, t_end, tolerance)
    }
}

impl<S: StateVector<f64>, F: Fn(f64, &S) -> S, J: Jacobian<S>, C: Coordinates<S>> Radau<S, F, J, C> {
    /// The integration at its start, in other coordinates: on a group, in the chart around the beginning of each step.
    ///
    /// # Errors
    /// As [`new`](Radau::new).
    pub fn within(
        coordinates: C,
        (f, jacobian): (F, J),
        tableau: &'static Tableau,
        groups: &'static [Group],
        (t0, y0): (f64, S),
        t_end: f64,
        tolerance: f64,
    ) -> Result<Self, Failure> {
        sound(t0, t_end, tolerance)?;
        let rate = f(t0, &y0);
        if !is_finite(&y0) || !is_finite(&rate) {
            return Err(Failure::NotFinite);
        }
        if !Newton::<S, MODES>::FITS {
            return Err(Failure::NoSolution { residual: f64::INFINITY });
        }
        let order = tableau.stages() as f64 + 1.0;
        let at_start = (t0, &y0, &rate);
        let (error_norm, probes) = ErrorNorm::probed(groups, &f, at_start);
        let error_norm = error_norm.without_carried();
        let length = match t_end == t0 {
            true => 0.0,
            false => first_step(&f, &error_norm, at_start, t_end - t0, (tolerance, order)),
        };
        let begin = Sum::of(y0);
        let mut integration = Self {
            f,
            jacobian,
            coordinates,
            tableau,
            newton: Newton::with_real_mode(tableau.modes, independent(groups)),
            error_norm,
            largest: [0.0; GROUPS],
            tolerance,
            controller: Controller::of(order, 1.0),
            t: t0,
            begin,
            end: begin,
            rate,
            stages: [S::zeros(); MOST_STAGES],
            h: 0.0,
            length,
            t_end,
            unjudged: true,
            work: Work::of(groups, tableau.stages()),
            failure: None,
            statistics: Statistics { evaluations: 2 + probes, ..Statistics::default() },
        };
        integration.note_sizes();
        Ok(integration)
    }

    /// Takes one accepted step; does nothing at `t_end`, which the last step hits exactly.
    ///
    /// # Errors
    /// [`Failure`], now and ever after; the state stays that of the last accepted step.
    pub fn advance(&mut self) -> Result<(), Failure> {
        if let Some(failure) = self.failure {
            return Err(failure);
        }
        if self.is_finished() {
            return Ok(());
        }
        let stepped = self.accepted();
        self.failure = stepped.err();
        stepped
    }

    fn accepted(&mut self) -> Result<(), Failure> {
        let base = self.end;
        let origin = self.coordinates.origin(&base).value;
        let slope = self.coordinates.velocity(&base.value, &origin, &self.rate);
        let field = Field { f: &self.f, coordinates: self.coordinates, base: &base };
        let (t, jacobian) = (self.t, &self.jacobian);
        let mut spent = 0;
        self.newton.learn(|columns| {
            spent = jacobian.columns(&|t: f64, z: &S| field.slope(t, z), (t, &origin, &slope), columns);
        });
        self.statistics.evaluations += spent;
        let (mut rejected, mut not_solved) = (false, None);
        loop {
            let to = next_time(self.t, self.length, self.t_end);
            let h = to - self.t;
            let is_lost = self.length <= shortest(self.t, self.t_end);
            if h == 0.0 || is_lost && rejected {
                return Err(not_solved.unwrap_or(Failure::StepUnderflow));
            }
            let Some(stages) = self.solved(&base, &origin, h) else {
                // A step a quarter as long, as in section IV.8 there.
                self.statistics.rejected += 1;
                rejected = true;
                self.unjudged = true;
                self.length = 0.25 * h.abs();
                not_solved = Some(Failure::NoSolution { residual: f64::NAN });
                continue;
            };
            let end = self.coordinates.state(&base, &plus(&origin, &stages[self.tableau.stages() - 1]));
            let error = self.error((&base, &origin, &slope), &stages, &end.value, h);
            let rate = if error <= 1.0 { self.rate_at(to, &end.value) } else { None };
            let Some(rate) = rate else {
                self.statistics.rejected += 1;
                rejected = true;
                self.unjudged = true;
                self.length = h.abs() * self.controller.reject(error);
                not_solved = (!error.is_finite()).then_some(Failure::NotFinite);
                continue;
            };
            self.statistics.steps += 1;
            self.unjudged = false;
            self.length = h.abs() * self.controller.accept(error);
            (self.begin, self.end, self.rate) = (base, end, rate);
            (self.stages, self.h, self.t) = (stages, h, to);
            self.add_work();
            self.note_sizes();
            return Ok(());
        }
    }

    fn rate_at(&mut self, t: f64, state: &S) -> Option<S> {
        self.statistics.evaluations += 1;
        let rate = (self.f)(t, state);
        is_finite(&rate).then_some(rate)
    }

    /// The stages of a step of length `h`: from the polynomial of the last step, and where that leads nowhere, from rest.
    fn solved(&mut self, base: &Sum<S>, origin: &S, h: f64) -> Option<Stages<S>> {
        if !self.newton.prepare(h) {
            return None;
        }
        let zero = [S::zeros(); MOST_STAGES];
        let guess = self.continued(h);
        let field = Field { f: &self.f, coordinates: self.coordinates, base };
        let mut problem = Problem {
            field: &field,
            newton: &self.newton,
            tableau: self.tableau,
            from: (self.t, origin),
            h,
            tolerance: self.tolerance,
            evaluations: 0,
        };
        let (norm_of, bounds) = (&self.error_norm, &self.largest);
        let size = |change: &S, stage: &S| {
            let (before, after) = (base.value, plus(origin, stage));
            let value = |range: core::ops::Range<usize>| norm(&change.as_ref()[range]);
            norm_of.largest_within(h.abs(), bounds, before.as_ref(), after.as_ref(), value)
        };
        let solved =
            guess.and_then(|guess| problem.solve(guess, &size)).or_else(|| problem.solve(zero, &size));
        self.statistics.evaluations += problem.evaluations;
        solved
    }

    /// Estimated error of a step relative to the tolerance.
    fn error(
        &mut self,
        (base, origin, slope): (&Sum<S>, &S, &S),
        stages: &Stages<S>,
        end: &S,
        h: f64,
    ) -> f64 {
        let gamma = self.tableau.modes[0].eigenvalue.0;
        let embedded = |slope: &S| {
            let mut sum = S::zeros();
            for (c, sum) in sum.as_mut().iter_mut().enumerate() {
                let stages = stages.iter().zip(self.tableau.errors);
                *sum = stages.map(|(stage, e)| e * stage.as_ref()[c]).sum::<f64>()
                    + gamma * h * slope.as_ref()[c];
            }
            self.newton.filtered(&sum)
        };
        let relative = |error: &S| {
            let change = self.coordinates.change(base, error);
            let value = |range: core::ops::Range<usize>| norm(&change.as_ref()[range]);
            let (before, after) = (base.value.as_ref(), end.as_ref());
            self.error_norm.largest_within(h.abs(), &self.largest, before, after, value) / self.tolerance
        };
        let error = embedded(slope);
        let size = relative(&error);
        if size <= 1.0 || !self.unjudged {
            return size;
        }
        // What dies out at once is no error: filtered once more where it could still be there.
        let field = Field { f: &self.f, coordinates: self.coordinates, base };
        let again = relative(&embedded(&field.slope(self.t, &plus(origin, &error))));
        self.statistics.evaluations += 1;
        again
    }

    /// Puts the work along the collocation polynomial in the place of that of the stages.
    fn add_work(&mut self) {
        let Some(work) = self.work else { return };
        let from = self.t - self.h;
        let done = work.along(from, self.h, |t| (self.f)(t, &self.inside((t - from) / self.h)));
        self.statistics.evaluations += work.evaluations();
        self.end.value.as_mut()[work.place] = self.begin.value.as_ref()[work.place] + done;
    }

    fn note_sizes(&mut self) {
        let mut start = 0;
        for (largest, group) in self.largest.iter_mut().zip(self.error_norm.groups()) {
            let size = norm(&self.end.value.as_ref()[start..start + group.len]);
            *largest = if size > *largest { size } else { *largest };
            start += group.len;
        }
    }

    /// Goes on to another end of the interval.
    #[doc(hidden)]
    pub fn aim(&mut self, t_end: f64) {
        self.t_end = t_end;
    }

    /// Everything that the next steps depend on, of an integration between two steps.
    #[doc(hidden)]
    pub fn exchange(&mut self, tape: &mut impl Tape) {
        tape.number(&mut self.t);
        tape.sum(&mut self.begin);
        tape.sum(&mut self.end);
        tape.state(&mut self.rate);
        self.stages.iter_mut().for_each(|stage| tape.state(stage));
        tape.number(&mut self.h);
        tape.number(&mut self.length);
        self.largest.iter_mut().for_each(|size| tape.number(size));
        tape.flag(&mut self.unjudged);
        self.controller.exchange(tape);
        tape.statistics(&mut self.statistics);
    }

    /// Time reached.
    #[must_use]
    pub fn t(&self) -> f64 {
        self.t
    }

    /// State reached.
    #[must_use]
    pub fn y(&self) -> &S {
        &self.end.value
    }

    /// `t_end` is reached.
    #[must_use]
    pub fn is_finished(&self) -> bool {
        self.t == self.t_end
    }

    /// Cost so far.
    #[must_use]
    pub fn statistics(&self) -> Statistics {
        let evaluations = self.statistics.evaluations * self.jacobian.worth();
        Statistics { evaluations, ..self.statistics }
    }
}

/// Components before those that nothing depends on: `1/D`, which is computed anew from the placement, and the work.
fn independent(groups: &[Group]) -> usize {
    let is_integral = |group: &Group| matches!(group.quantity, Quantity::InverseDilatation | Quantity::Work);
    let last = groups.iter().rposition(|group| !is_integral(group)).map_or(0, |last| last + 1);
    groups[..last].iter().map(|group| group.len).sum()
}

impl<S: StateVector<f64>, F: Fn(f64, &S) -> S, J: Jacobian<S>, C: Coordinates<S>> fmt::Debug
    for Radau<S, F, J, C>
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Radau")
            .field("stages", &self.tableau.stages())
            .field("t", &self.t)
            .field("y", &self.end.value)
            .field("t_end", &self.t_end)
            .field("tolerance", &self.tolerance)
            .field("statistics", &self.statistics())
            .finish_non_exhaustive()
    }
}
