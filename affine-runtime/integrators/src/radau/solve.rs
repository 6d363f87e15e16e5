//! The stage equations `Z_i = h sum_j a_ij f(t + c_j h, y + Z_j)` of one step, by Newton's iteration.

use super::coefficients::{MODES, MOST_STAGES, Tableau};
use crate::lie::{Coordinates, Sum};
use crate::newton::{Newton, by_differences};
use affine_core::model::StateVector;

/// Changes of the state from the beginning of a step to its stages, in the coordinates of the step.
pub(super) type Stages<S> = [S; MOST_STAGES];

/// Corrections from one start: they converge within a few, or the step is too long.
const MOST_CORRECTIONS: u32 = 12;
/// The stages are solved to this part of the tolerance.
const SOLVED: f64 = 1e-2;
/// The same at tolerances below [`FINE`], where errors of many stages add up.
const SOLVED_FINELY: f64 = 1e-3;
const FINE: f64 = 1e-8;
/// A correction of so many roundings is one of rounding.
const ROUNDINGS: f64 = 4.0 * f64::EPSILON;
/// Corrections that no longer shrink have come to what rounding leaves of stiff equations, where they are below this part of
/// the tolerance.
const STAGNATED: f64 = 0.1;

/// The derivatives of a right-hand side by the components of the state.
pub trait Jacobian<S> {
    /// Fills in one column for each component, at `(t, y)` where `f` is `slope` and components are about `extent` large; the
    /// evaluations that it took.
    fn columns(&self, f: &dyn Fn(f64, &S) -> S, at: (f64, &S, &S), extent: &S, columns: &mut [S]) -> u64;

    /// Evaluations of the equations of motion that one of `f` stands for.
    fn worth(&self) -> u64 {
        1
    }
}

/// By differences: one evaluation for each component.
#[derive(Clone, Copy, Debug, Default)]
pub struct Differences;

impl<S: StateVector<f64>> Jacobian<S> for Differences {
    fn columns(&self, f: &dyn Fn(f64, &S) -> S, at: (f64, &S, &S), extent: &S, columns: &mut [S]) -> u64 {
        by_differences(f, at, extent, columns);
        S::LEN as u64
    }
}

/// By a function of time, state and number of a component that gives the column, as numbers with a derivative do.
#[derive(Clone, Copy, Debug)]
pub struct Exact<G>(pub G);

impl<S: StateVector<f64>, G: Fn(f64, &S, usize) -> S> Jacobian<S> for Exact<G> {
    fn columns(&self, _: &dyn Fn(f64, &S) -> S, (t, y, _): (f64, &S, &S), _: &S, columns: &mut [S]) -> u64 {
        columns.iter_mut().enumerate().for_each(|(component, column)| *column = (self.0)(t, y, component));
        S::LEN as u64
    }
}

/// A right-hand side in the coordinates of a step.
pub(super) struct Field<'a, S, F, C> {
    pub(super) f: &'a F,
    pub(super) coordinates: C,
    pub(super) base: &'a Sum<S>,
}

impl<S: StateVector<f64>, F: Fn(f64, &S) -> S, C: Coordinates<S>> Field<'_, S, F, C> {
    pub(super) fn slope(&self, t: f64, z: &S) -> S {
        let state = self.coordinates.state(self.base, z).value;
        self.coordinates.velocity(&state, z, &(self.f)(t, &state))
    }
}

/// The equations of one step.
pub(super) struct Problem<'a, S, F, C> {
    pub(super) field: &'a Field<'a, S, F, C>,
    pub(super) newton: &'a Newton<S, MODES>,
    pub(super) tableau: &'static Tableau,
    /// Time and coordinates where the step begins.
    pub(super) from: (f64, &'a S),
    pub(super) h: f64,
    pub(super) tolerance: f64,
    pub(super) evaluations: u64,
}

impl<S: StateVector<f64>, F: Fn(f64, &S) -> S, C: Coordinates<S>> Problem<'_, S, F, C> {
    /// The stages from a first guess; `None` where corrections do not shrink fast enough. `size` is that of a change of a
    /// stage, relative.
    pub(super) fn solve(&mut self, guess: Stages<S>, size: &impl Fn(&S, &S) -> f64) -> Option<Stages<S>> {
        let solved = if self.tolerance < FINE { SOLVED_FINELY } else { SOLVED };
        let mut stages = guess;
        let mut last = f64::INFINITY;
        for correction in 1..=MOST_CORRECTIONS {
            let change = self.newton.correction(&self.defects(&stages));
            let mut largest: f64 = 0.0;
            for (stage, change) in stages.iter_mut().zip(&change).take(self.tableau.stages()) {
                *stage = plus(stage, change);
                let of_stage = size(change, stage);
                largest = if of_stage <= largest { largest } else { of_stage };
            }
            if !largest.is_finite() {
                return None;
            }
            if largest <= ROUNDINGS {
                return Some(stages);
            }
            let (relative, rate) = (largest / self.tolerance, largest / last);
            last = largest;
            if correction == 1 {
                continue;
            }
            if rate >= 1.0 {
                return (relative <= STAGNATED).then_some(stages);
            }
            if rate / (1.0 - rate) * relative < solved {
                return Some(stages);
            }
            let left = libm::pow(rate, f64::from(MOST_CORRECTIONS - correction));
            if left / (1.0 - rate) * relative > STAGNATED {
                return None;
            }
        }
        (last <= STAGNATED * self.tolerance).then_some(stages)
    }

    /// `h sum_j a_ij f_j - Z_i`: one evaluation for each stage.
    fn defects(&mut self, stages: &Stages<S>) -> Stages<S> {
        let (t, origin) = self.from;
        let mut slopes = [S::zeros(); MOST_STAGES];
        for ((slope, stage), node) in slopes.iter_mut().zip(stages).zip(self.tableau.nodes) {
            *slope = self.field.slope(t + node * self.h, &plus(origin, stage));
        }
        self.evaluations += self.tableau.stages() as u64;
        let mut defects = [S::zeros(); MOST_STAGES];
        for ((defect, stage), row) in defects.iter_mut().zip(stages).zip(self.tableau.matrix) {
            for (c, defect) in defect.as_mut().iter_mut().enumerate() {
                let sum: f64 = row.iter().zip(&slopes).map(|(a, slope)| a * slope.as_ref()[c]).sum();
                *defect = self.h * sum - stage.as_ref()[c];
            }
        }
        defects
    }
}

/// Sum of components.
pub(super) fn plus<S: StateVector<f64>>(a: &S, b: &S) -> S {
    let mut sum = *a;
    for (sum, b) in sum.as_mut().iter_mut().zip(b.as_ref()) {
        *sum += b;
    }
    sum
}

impl Tableau {
    /// The Lagrange polynomial through 0 and the nodes that is 1 at node `i`, at a part of the step.
    pub(super) fn lagrange(&self, i: usize, part: f64) -> f64 {
        let node = self.nodes[i];
        let others = self.nodes.iter().enumerate().filter(|(k, _)| *k != i);
        others.fold(part / node, |product, (_, other)| product * (part - other) / (node - other))
    }
}
