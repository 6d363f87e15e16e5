//! Radau IIA collocation: implicit, for motions with friction that is fast and dies out.

mod coefficients;
mod polynomial;
mod solve;
mod work;

pub use coefficients::Tableau;
pub use solve::{Differences, Exact, Jacobian};

use super::drive::{Adaptive, AdaptiveMethod, Attempt, Control};
use super::error_norm::{ErrorNorm, GROUPS};
use super::finite::is_finite;
use super::lie::{Coordinates, Flat, Sum};
use super::newton::Newton;
use super::step_size::{Controller, first_step};
use super::tape::Tape;
use super::vectors::Baseline;
use super::{Failure, sound};
use affine_core::__private::numerics::{Vectors, norm};
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
pub type Radau<S, F, J, C = Flat> = Adaptive<RadauSteps<S, F, J, C>>;

/// Steps of Radau IIA collocation.
#[derive(Clone)]
pub struct RadauSteps<S, F, J, C> {
    f: F,
    jacobian: J,
    coordinates: C,
    tableau: &'static Tableau,
    newton: Newton<S, MODES>,
    error_norm: ErrorNorm,
    /// The largest that each group has been, or what moves the placement within the interval.
    largest: [f64; GROUPS],
    t: f64,
    begin: Sum<S>,
    end: Sum<S>,
    /// The time derivative of the state reached.
    rate: S,
    /// The state reached in the coordinates around it, and its slope.
    origin: S,
    slope: S,
    /// Of the last step, and its length, zero before the first.
    stages: Stages<S>,
    h: f64,
    /// The next step has none before it that its error could be judged by.
    unjudged: bool,
    work: Option<Work>,
}

impl<S: StateVector<f64>, F: Fn(f64, &S) -> S, J: Jacobian<S>> Adaptive<RadauSteps<S, F, J, Flat>> {
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

impl<S: StateVector<f64>, F: Fn(f64, &S) -> S, J: Jacobian<S>, C: Coordinates<S>>
    Adaptive<RadauSteps<S, F, J, C>>
{
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
        let mut method = RadauSteps {
            f,
            jacobian,
            coordinates,
            tableau,
            newton: Newton::with_real_mode(tableau.modes, independent(groups)),
            error_norm,
            largest: error_norm.floors((t_end - t0).abs()),
            t: t0,
            begin,
            end: begin,
            rate,
            origin: y0,
            slope: rate,
            stages: [S::zeros(); MOST_STAGES],
            h: 0.0,
            unjudged: true,
            work: Work::of(groups, tableau.stages()),
        };
        method.note_sizes();
        let controller = Controller::of(order, 1.0);
        Ok(Self { method, control: Control::new((t_end, tolerance), controller, length, 2 + probes) })
    }
}

/// A step that is solved.
pub struct Solved<S> {
    stages: Stages<S>,
    end: Sum<S>,
    rate: S,
}

impl<S: StateVector<f64>, F: Fn(f64, &S) -> S, J: Jacobian<S>, C: Coordinates<S>> AdaptiveMethod
    for RadauSteps<S, F, J, C>
{
    type State = S;
    const NAME: &'static str = "Radau";

    fn t(&self) -> f64 {
        self.t
    }

    fn y(&self) -> &S {
        &self.end.value
    }

    fn step(&mut self, control: &mut Control) -> Result<(), Failure> {
        control.by_error(self, Baseline)
    }

    /// By the collocation polynomial; without evaluations, but for the work up to there.
    fn at(&mut self, t: f64, control: &mut Control) -> Result<S, Failure> {
        Ok(self.between(t, control))
    }

    fn exchange(&mut self, tape: &mut impl Tape) {
        tape.number(&mut self.t);
        tape.sum(&mut self.begin);
        tape.sum(&mut self.end);
        tape.state(&mut self.rate);
        self.stages.iter_mut().for_each(|stage| tape.state(stage));
        tape.number(&mut self.h);
        self.largest.iter_mut().for_each(|size| tape.number(size));
        tape.flag(&mut self.unjudged);
    }

    fn worth(&self) -> u64 {
        self.jacobian.worth()
    }
}

impl<S: StateVector<f64>, F: Fn(f64, &S) -> S, J: Jacobian<S>, C: Coordinates<S>> Attempt
    for RadauSteps<S, F, J, C>
{
    type Trial = Solved<S>;

    fn begin(&mut self, control: &mut Control) {
        self.origin = self.coordinates.origin(&self.end).value;
        self.slope = self.coordinates.velocity(&self.end.value, &self.origin, &self.rate);
        let field = Field { f: &self.f, coordinates: self.coordinates, base: &self.end };
        let (start, jacobian) = ((self.t, &self.origin, &self.slope), &self.jacobian);
        let extent = self.error_norm.extents(control.length, &self.end.value, &self.origin);
        let mut spent = 0;
        self.newton.learn(&extent, |columns| {
            spent = jacobian.columns(&|t: f64, z: &S| field.slope(t, z), start, &extent, columns);
        });
        control.statistics.evaluations += spent;
    }

    fn attempt(
        &mut self,
        _vectors: impl Vectors,
        to: f64,
        control: &mut Control,
    ) -> Option<(Solved<S>, f64)> {
        let h = to - self.t;
        let is_unjudged = core::mem::replace(&mut self.unjudged, true);
        let stages = self.solved(h, control)?;
        let last = &stages[self.tableau.stages() - 1];
        let end = self.coordinates.state(&self.end, &plus(&self.origin, last));
        let mut error = self.error(&stages, &end.value, (h, is_unjudged), control);
        let mut rate = self.rate;
        if error <= 1.0 {
            control.statistics.evaluations += 1;
            rate = (self.f)(to, &end.value);
            error = if is_finite(&rate) { error } else { f64::NAN };
        }
        Some((Solved { stages, end, rate }, error))
    }

    fn accept(&mut self, Solved { stages, end, rate }: Solved<S>, to: f64, control: &mut Control) {
        self.unjudged = false;
        (self.stages, self.h, self.t) = (stages, to - self.t, to);
        (self.begin, self.end, self.rate) = (self.end, end, rate);
        self.add_work(control);
        self.note_sizes();
    }
}

impl<S: StateVector<f64>, F: Fn(f64, &S) -> S, J: Jacobian<S>, C: Coordinates<S>> RadauSteps<S, F, J, C> {
    /// The stages of a step of length `h`: from the polynomial of the last step, and where that leads nowhere, from rest.
    fn solved(&mut self, h: f64, control: &mut Control) -> Option<Stages<S>> {
        if !self.newton.prepare(h) {
            return None;
        }
        let zero = [S::zeros(); MOST_STAGES];
        let guess = self.continued(h);
        let (base, origin) = (&self.end, &self.origin);
        let field = Field { f: &self.f, coordinates: self.coordinates, base };
        let mut problem = Problem {
            field: &field,
            newton: &self.newton,
            tableau: self.tableau,
            from: (self.t, origin),
            h,
            tolerance: control.tolerance,
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
        control.statistics.evaluations += problem.evaluations;
        solved
    }

    /// Estimated error of a step of length `h` relative to the tolerance.
    fn error(
        &self,
        stages: &Stages<S>,
        end: &S,
        (h, is_unjudged): (f64, bool),
        control: &mut Control,
    ) -> f64 {
        let (base, tolerance) = (&self.end, control.tolerance);
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
            self.error_norm.largest_within(h.abs(), &self.largest, before, after, value) / tolerance
        };
        let error = embedded(&self.slope);
        let size = relative(&error);
        if size <= 1.0 || !is_unjudged {
            return size;
        }
        // What dies out at once is no error: filtered once more where it could still be there.
        let field = Field { f: &self.f, coordinates: self.coordinates, base };
        let again = relative(&embedded(&field.slope(self.t, &plus(&self.origin, &error))));
        control.statistics.evaluations += 1;
        again
    }

    /// Puts the work along the collocation polynomial in the place of that of the stages.
    fn add_work(&mut self, control: &mut Control) {
        let Some(work) = self.work else { return };
        let from = self.t - self.h;
        let done = work.along(from, self.h, |t| (self.f)(t, &self.inside((t - from) / self.h)));
        control.statistics.evaluations += work.evaluations();
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
}

/// Components before those that nothing depends on: `1/D`, which is computed anew from the placement, and the work.
fn independent(groups: &[Group]) -> usize {
    let is_integral = |group: &Group| matches!(group.quantity, Quantity::InverseDilatation | Quantity::Work);
    let last = groups.iter().rposition(|group| !is_integral(group)).map_or(0, |last| last + 1);
    groups[..last].iter().map(|group| group.len).sum()
}
