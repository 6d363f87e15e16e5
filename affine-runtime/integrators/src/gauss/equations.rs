//! The stage equations `L_i = h b_i f(t + c_i h, y + sum_j mu_ij L_j)` of one step, iterated to rounding.

use super::coefficients::{MODES, MOST_STAGES, Tableau};
use crate::lie::{Coordinates, Sum};
use crate::newton::Newton;
use affine_core::__private::numerics::larger;
use affine_core::model::StateVector;
use affine_core::scalar::Scalar;

/// Increments `L_i`, one for each stage.
pub(super) type Increments<S> = [S; MOST_STAGES];

/// Equations count as solved where the increments are right to this part of the largest component of the state.
/// Rounding leaves 1e-13 at the worst of stiff problems; an iteration that is stuck leaves far more.
const SOLVED: f64 = 1e-10;
/// Fixed-point iterations to expect, at most: as many evaluations as a Jacobian, its factors and a few corrections.
const MOST_FIXED_POINT: f64 = 50.0;
/// The rate of contraction is believed from this iteration on.
const FIRST_RATE: u32 = 4;
/// Corrections of Newton's iteration from one start: it converges within ten, or wanders.
const MOST_CORRECTIONS: u32 = 30;
/// Corrections that shrink less than that ask for the Jacobian at the increments reached.
const SLOW: f64 = 0.1;
/// A correction that is this part of the one before is no gain: below a rounding of the increments, corrections of
/// many stages may go on shrinking by a thousandth at a time.
const NO_GAIN: f64 = 0.9;

/// Where a step begins and how long it is.
#[derive(Clone, Copy)]
pub(super) struct Start<'a, S> {
    pub(super) t: f64,
    pub(super) h: f64,
    pub(super) y: &'a S,
    /// What rounding left out of `y`.
    pub(super) carry: &'a S,
}

/// The vector field in coordinates around a point of the step.
pub(super) struct Field<'a, S, F, C> {
    pub(super) f: &'a F,
    pub(super) coordinates: C,
    /// Where the step begins.
    pub(super) base: &'a Sum<S>,
}

impl<S: StateVector<f64>, F: Fn(f64, &S) -> S, C: Coordinates<S>> Field<'_, S, F, C> {
    /// `z'` as a function of `t` and of `z` as counted from the beginning of a step of total increment `rise`.
    #[inline(always)]
    fn over(&self, rise: S) -> impl Fn(f64, &S) -> S + '_ {
        let middle = self.coordinates.middle(self.base, &rise);
        move |t, z| {
            let z = self.coordinates.centred(z, &rise);
            let state = self.coordinates.state(&middle, &z).value;
            self.coordinates.velocity(&state, &z, &(self.f)(t, &state))
        }
    }
}

/// Increments and how well they fulfil the equations: the largest defect, relative to the largest component of
/// state and increments.
pub(super) struct Solution<S> {
    pub(super) increments: Increments<S>,
    pub(super) residual: f64,
}

/// A correction: its largest magnitude in each component; over the largest component of state and increments its size, and
/// that of the defect that it corrects.
struct Corrected<S> {
    change: S,
    size: f64,
    residual: f64,
}

/// The equations have no solution that could be found; the residual or correction with which the iteration that came nearest
/// ended, infinite where nothing was finite.
pub(super) struct Unsolved {
    pub(super) residual: f64,
}

/// Fixed-point iteration while that contracts, Newton's iteration from the first step on where it does not.
#[derive(Clone)]
pub(super) struct Equations<S> {
    pub(super) tableau: &'static Tableau,
    newton: Newton<S, MODES>,
    stiff: bool,
    pub(super) evaluations: u64,
}

impl<S: StateVector<f64>> Equations<S> {
    pub(super) fn new(tableau: &'static Tableau) -> Self {
        Self { tableau, newton: Newton::new(tableau.modes), stiff: false, evaluations: 0 }
    }

    /// Newton's iteration has been needed.
    pub(super) fn is_stiff(&self) -> bool {
        self.stiff
    }

    /// Increments of the step, iterated from `guess`.
    pub(super) fn solve<F: Fn(f64, &S) -> S, C: Coordinates<S>>(
        &mut self,
        f: &Field<'_, S, F, C>,
        start: Start<'_, S>,
        guess: Increments<S>,
    ) -> Result<Solution<S>, Unsolved> {
        let mut least = f64::INFINITY;
        if !self.stiff {
            match self.fixed_point(f, start, guess) {
                Ok(solution) => return Ok(solution),
                Err(Unsolved { residual }) => least = residual,
            }
        }
        if !Newton::<S, MODES>::FITS {
            return Err(Unsolved { residual: least });
        }
        // A continuation of the step before may lead far astray; no motion at all is the other start.
        for first in [guess, [S::zeros(); MOST_STAGES]] {
            match self.corrected(f, start, first) {
                Ok(solution) => {
                    self.stiff = true;
                    return Ok(solution);
                }
                Err(Unsolved { residual }) if residual < least => least = residual,
                Err(_) => {}
            }
            self.newton.forget();
        }
        Err(Unsolved { residual: least })
    }

    fn fixed_point<F: Fn(f64, &S) -> S, C: Coordinates<S>>(
        &mut self,
        f: &Field<'_, S, F, C>,
        start: Start<'_, S>,
        guess: Increments<S>,
    ) -> Result<Solution<S>, Unsolved> {
        let mut increments = guess;
        let mut descent = Descent::new();
        let (mut last, mut last_but_one) = (f64::INFINITY, f64::INFINITY);
        for iteration in 1.. {
            let images = self.images(f, start, &increments);
            let change = self.largest(&self.difference(&images, &increments));
            increments = images;
            let residual = self.relative(&change, start.y, &increments);
            if residual.is_nan() || residual == f64::INFINITY {
                break;
            }
            if !descent.goes_on(&change, 1.0) && residual <= SOLVED {
                return Ok(Solution { increments, residual });
            }
            let rate = Scalar::sqrt(residual / last_but_one);
            (last_but_one, last) = (last, residual);
            if residual > SOLVED
                && iteration >= FIRST_RATE
                && expected(iteration, residual, rate) > MOST_FIXED_POINT
            {
                break;
            }
        }
        Err(Unsolved { residual: last })
    }

    fn corrected<F: Fn(f64, &S) -> S, C: Coordinates<S>>(
        &mut self,
        f: &Field<'_, S, F, C>,
        start: Start<'_, S>,
        first: Increments<S>,
    ) -> Result<Solution<S>, Unsolved> {
        let mut increments = first;
        let mut descent = Descent::new();
        let (mut last, mut open) = (f64::INFINITY, f64::INFINITY);
        if !self.newton.is_known() {
            self.differentiate(f, start, &increments);
        }
        for _ in 0..MOST_CORRECTIONS {
            let Some(Corrected { change, size, residual }) = self.correct(f, start, &mut increments) else {
                return Err(Unsolved { residual: open });
            };
            // Beside increments that grow without bounds any defect is small.
            open = if size > residual { size } else { residual };
            if !descent.goes_on(&change, NO_GAIN) && size <= SOLVED {
                return Ok(Solution { increments, residual });
            }
            if size > SLOW * last && size > SOLVED {
                self.differentiate(f, start, &increments);
            }
            last = size;
        }
        if last <= SOLVED { self.refined(f, start, increments) } else { Err(Unsolved { residual: open }) }
    }

    /// Increments that all corrections have brought within [`SOLVED`], and of which some component still gains: slowly, by
    /// a Jacobian of other increments, or since what rounding leaves is random, and among many components there is often
    /// one whose correction is the least so far. By the Jacobian at the increments themselves all but rounding is gone
    /// with the first correction, and a component whose correction does not shrink has come to it. One whose correction
    /// shrinks to the last is solved no less: where the force of a contact has ended at one stage and not half-way through
    /// the step, what that stage adds falls by a constant factor each time, and has no rounding to come to.
    fn refined<F: Fn(f64, &S) -> S, C: Coordinates<S>>(
        &mut self,
        f: &Field<'_, S, F, C>,
        start: Start<'_, S>,
        reached: Increments<S>,
    ) -> Result<Solution<S>, Unsolved> {
        let mut increments = reached;
        let mut descent = Descent::new();
        let mut left = f64::INFINITY;
        self.differentiate(f, start, &increments);
        for _ in 0..MOST_CORRECTIONS {
            let Some(Corrected { change, size, residual }) = self.correct(f, start, &mut increments) else {
                return Err(Unsolved { residual: f64::INFINITY });
            };
            if size > SOLVED {
                return Err(Unsolved { residual: size });
            }
            left = residual;
            descent.settle(&change, NO_GAIN);
            if descent.is_settled() {
                break;
            }
        }
        Ok(Solution { increments, residual: left })
    }

    /// One correction of the increments; `None` where there is none that is finite.
    fn correct<F: Fn(f64, &S) -> S, C: Coordinates<S>>(
        &mut self,
        f: &Field<'_, S, F, C>,
        start: Start<'_, S>,
        increments: &mut Increments<S>,
    ) -> Option<Corrected<S>> {
        if !self.newton.prepare(start.h) {
            return None;
        }
        let images = self.images(f, start, increments);
        let defects = self.difference(&images, increments);
        let correction = self.newton.correction(&defects);
        for (increment, correction) in increments.iter_mut().zip(&correction) {
            add(increment, correction);
        }
        let residual = self.relative(&self.largest(&defects), start.y, increments);
        let change = self.largest(&correction);
        let size = self.relative(&change, start.y, increments);
        (size.is_finite() && residual.is_finite()).then_some(Corrected { change, size, residual })
    }

    /// The Jacobian half-way through the step, by the increments.
    fn differentiate<F: Fn(f64, &S) -> S, C: Coordinates<S>>(
        &mut self,
        f: &Field<'_, S, F, C>,
        start: Start<'_, S>,
        increments: &Increments<S>,
    ) {
        let extent = self.total(increments);
        let mut middle = *start.y;
        for (y, rise) in middle.as_mut().iter_mut().zip(extent.as_ref()) {
            *y += 0.5 * rise;
        }
        self.newton.differentiate(&f.over(extent), start.t + 0.5 * start.h, &middle, &extent);
        self.evaluations += 1 + S::LEN as u64;
    }

    /// `h b_i f(t + c_i h, y + sum_j mu_ij L_j)`: one evaluation for each stage.
    #[inline]
    fn images<F: Fn(f64, &S) -> S, C: Coordinates<S>>(
        &mut self,
        f: &Field<'_, S, F, C>,
        start: Start<'_, S>,
        increments: &Increments<S>,
    ) -> Increments<S> {
        let stages = self.tableau.stages();
        let f = f.over(self.total(increments));
        let mut images = [S::zeros(); MOST_STAGES];
        for (i, image) in images.iter_mut().enumerate().take(stages) {
            let mut stage = *start.y;
            for (c, value) in stage.as_mut().iter_mut().enumerate() {
                let mut rise = start.carry.as_ref()[c];
                for (ratio, increment) in self.tableau.ratios[i].iter().zip(increments).take(stages) {
                    rise = increment.as_ref()[c].fma(*ratio, rise);
                }
                *value += rise;
            }
            *image = f(start.t + self.tableau.nodes[i] * start.h, &stage);
            let weight = start.h * self.tableau.weights[i];
            for value in image.as_mut() {
                *value *= weight;
            }
        }
        self.evaluations += stages as u64;
        images
    }
}

/// Iterations in all until rounding, at this rate.
fn expected(iteration: u32, residual: f64, rate: f64) -> f64 {
    if rate < 1.0 {
        f64::from(iteration) + libm::log(f64::EPSILON / residual) / libm::log(rate)
    } else {
        f64::INFINITY
    }
}

/// Whether an iteration still gains: the changes of some component are not zero and smaller than a part of the least
/// before. What does not is at rounding, or does not converge (Hairer, Lubich, Wanner, section VIII.6; by components as in
/// Antonana, Makazaga, Murua, since components may differ in scale). A change that is zero is no measure: where momenta alone
/// change in one iteration, and placements alone in the next, each begins with none.
struct Descent<S> {
    least: S,
}

impl<S: StateVector<f64>> Descent<S> {
    fn new() -> Self {
        let mut least = S::zeros();
        least.as_mut().fill(f64::INFINITY);
        Self { least }
    }

    fn goes_on(&mut self, change: &S, part: f64) -> bool {
        let mut goes_on = false;
        for (least, change) in self.least.as_mut().iter_mut().zip(change.as_ref()) {
            if *change > 0.0 && *change < part * *least {
                goes_on = true;
                *least = *change;
            }
        }
        goes_on
    }

    /// Notes changes: a component that does not gain has come to rounding, whatever its later changes are.
    fn settle(&mut self, change: &S, part: f64) {
        for (least, change) in self.least.as_mut().iter_mut().zip(change.as_ref()) {
            *least = if *change < part * *least { *change } else { 0.0 };
        }
    }

    /// Every component has come to rounding.
    fn is_settled(&self) -> bool {
        self.least.as_ref().iter().all(|least| *least == 0.0)
    }
}

fn add<S: StateVector<f64>>(sum: &mut S, term: &S) {
    for (sum, term) in sum.as_mut().iter_mut().zip(term.as_ref()) {
        *sum += term;
    }
}

/// Sums and sizes over the stages that the method has.
impl<S: StateVector<f64>> Equations<S> {
    /// `sum_i L_i`.
    pub(super) fn total(&self, increments: &Increments<S>) -> S {
        let mut total = S::zeros();
        for increment in increments.iter().take(self.tableau.stages()) {
            add(&mut total, increment);
        }
        total
    }

    fn difference(&self, images: &Increments<S>, increments: &Increments<S>) -> Increments<S> {
        let mut difference = *images;
        for (difference, increment) in difference.iter_mut().zip(increments).take(self.tableau.stages()) {
            for (value, increment) in difference.as_mut().iter_mut().zip(increment.as_ref()) {
                *value -= increment;
            }
        }
        difference
    }

    /// Largest magnitude of each component; NaN where one is.
    fn largest(&self, changes: &Increments<S>) -> S {
        let mut largest = S::zeros();
        for change in changes.iter().take(self.tableau.stages()) {
            for (largest, value) in largest.as_mut().iter_mut().zip(change.as_ref()) {
                *largest = larger(*largest, Scalar::abs(*value));
            }
        }
        largest
    }

    /// Largest component of `change` over the largest of state and increments; zero where nothing changes.
    fn relative(&self, change: &S, y: &S, increments: &Increments<S>) -> f64 {
        let largest = |v: &S| v.as_ref().iter().map(|value| Scalar::abs(*value)).fold(0.0, larger);
        let change = largest(change);
        let scale = largest(y) + largest(&self.largest(increments));
        if change == 0.0 { 0.0 } else { change / scale }
    }
}
