//! How branches are followed, and special points found.

use nalgebra::{DMatrix, DVector};

use super::branch::{Branch, BranchPoint, Special};
use super::error::AnalysisError;
use super::field::vector;
use super::generator::{Generator, confined};
use super::linear::{Column, Dense, kernel};
use super::newton::{Equations, FLOOR, Solution, solve};
use super::relative::{Condition, DEGENERATE, Problem, assert_timeless, free, relative_equilibrium};
use super::spectrum::Eigenvalue;
use super::stability::StabilityVerdict;
use crate::decompose::TwoPolar;
use crate::error::Error;
use crate::model::Model;
use crate::state::Phase;

/// Singular values that are none at a branch point, which is known to fewer digits.
const RANK_AT_BRANCH_POINT: f64 = 1e-5;
/// By which a parameter is shifted for differences.
const SHIFT: f64 = 1e-6;
/// The cosine of the angle by which a branch may turn in a step.
const STRAIGHT: f64 = 0.96;
/// Part of the longest step below which there is none.
const SHORTEST: f64 = 1e-6;
/// Secants to a special point, and the part of a step to which it is located.
const MOST_SECANTS: usize = 40;
const LOCATED: f64 = 1e-12;
/// Points of a branch.
const MOST_POINTS: usize = 2000;

type At<const N: usize, M> = BranchPoint<N, <M as Model<N>>::Point<f64>>;
type Value<'a, const N: usize, M> = &'a dyn Fn(&At<N, M>) -> Option<f64>;

/// How a branch is followed: by pseudo-arclength, so that it may turn back in the parameter (H. B. Keller, 1977).
///
/// The family gives the model and the conditions at a value of the parameter, so that the parameter is a field of the model, a
/// velocity, a momentum, or several of them at once.
#[derive(Clone, Debug)]
pub struct Continuation<const N: usize, F> {
    family: F,
    generators: Vec<Generator<N>>,
    step: f64,
    range: (f64, f64),
}

impl<const N: usize, M: Model<N>, F: Fn(f64) -> Result<(M, Vec<Condition>), Error>> Continuation<N, F> {
    /// The relative equilibria of a family whose `zeta` is a sum of multiples of generators, within a range of the parameter, by
    /// steps of at most this length in all unknowns.
    pub fn new(generators: &[Generator<N>], range: (f64, f64), step: f64, family: F) -> Self {
        Self { family, generators: generators.iter().map(confined::<N, M>).collect(), step, range }
    }

    /// The branch through the relative equilibrium that is nearest to a guess at a value of the parameter, towards larger values:
    /// as far as the range goes, or as the branch does, see [`Branch::ended`].
    ///
    /// # Errors
    /// [`AnalysisError`].
    pub fn run(
        &self,
        guess: &M::Point<f64>,
        start: f64,
    ) -> Result<Branch<N, <M as Model<N>>::Point<f64>>, AnalysisError> {
        let ((low, high), step) = (self.range, self.step);
        if !(step > 0.0 && step.is_finite() && low <= start && start <= high) {
            return Err(AnalysisError::Range { step, low, high, start });
        }
        let (model, conditions) = (self.family)(start)?;
        let turn = relative_equilibrium(&model, guess, &self.generators, &conditions)?;
        let z = vector(&model.flatten(&turn.point));
        let all = z.iter().chain(&turn.velocities).copied().chain([start]);
        let unknowns = DVector::from_iterator(z.len() + self.generators.len() + 1, all);
        let tangent = self.tangent(&unknowns, None)?;
        self.followed(self.point(unknowns, tangent)?)
    }

    /// The other branch through a bifurcation, which begins that far from it.
    ///
    /// # Errors
    /// [`AnalysisError`].
    pub fn switch(
        &self,
        at: &At<N, M>,
        distance: f64,
    ) -> Result<Branch<N, <M as Model<N>>::Point<f64>>, AnalysisError> {
        let free = self.free(&at.unknowns, RANK_AT_BRANCH_POINT)?;
        let away = &free * kernel(&DMatrix::from_rows(&[at.tangent.tr_mul(&free)]), RANK_AT_BRANCH_POINT);
        if away.is_empty() {
            return Err(AnalysisError::Degenerate { kernel: free.ncols(), expected: 2 });
        }
        let direction = away.column(0).normalize();
        let solution = self.corrected(&at.unknowns, &direction, (distance, FLOOR))?;
        let secant = (&solution.at - &at.unknowns).normalize();
        let tangent = self.tangent(&solution.at, Some(&secant))?;
        self.followed(self.point(solution.at, tangent)?)
    }

    fn problem<'a>(&'a self, model: &'a M, conditions: &'a [Condition]) -> Problem<'a, N, M> {
        Problem { model, generators: &self.generators, conditions }
    }

    fn equations(&self, unknowns: &Column) -> Option<Equations> {
        let last = unknowns.len() - 1;
        let (own, parameter) = (unknowns.rows(0, last).into_owned(), unknowns[last]);
        let shift = SHIFT * (1.0 + parameter.abs()).min(self.range.1 - self.range.0).max(f64::MIN_POSITIVE);
        let shifted = |parameter: f64| {
            let (model, conditions) = (self.family)(parameter).ok()?;
            self.problem(&model, &conditions).values(&own)
        };
        let (model, conditions) = (self.family)(parameter).ok()?;
        let Equations { values, jacobian, size, scale } =
            self.problem(&model, &conditions).equations(&own)?;
        // The family may end next to a point.
        let slope = match (shifted(parameter + shift), shifted(parameter - shift)) {
            (Some(after), Some(before)) => (after - before) / (2.0 * shift),
            (Some(after), None) => (after - &values) / shift,
            (None, Some(before)) => (&values - before) / shift,
            (None, None) => return None,
        };
        let mut jacobian = jacobian.insert_column(last, 0.0);
        jacobian.set_column(last, &slope);
        Some(Equations { values, jacobian, size, scale })
    }

    /// The point of the branch in the plane at a distance along a direction.
    fn corrected(
        &self,
        from: &Column,
        direction: &Column,
        (distance, floor): (f64, f64),
    ) -> Result<Solution, AnalysisError> {
        solve(from + direction * distance, floor, |unknowns| {
            let Equations { values, jacobian, size, scale } = self.equations(unknowns)?;
            let rows = values.len();
            let (mut values, mut jacobian) = (values.insert_row(rows, 0.0), jacobian.insert_row(rows, 0.0));
            values[rows] = direction.dot(&(unknowns - from)) - distance;
            jacobian.set_row(rows, &direction.transpose());
            let scale = scale.insert_row(rows, unknowns.norm() + distance.abs());
            Some(Equations { values, jacobian, size, scale })
        })
    }

    /// Directions in which solutions go on, without those of symmetries.
    fn free(&self, unknowns: &Column, rank: f64) -> Result<Dense, AnalysisError> {
        let last = unknowns.len() - 1;
        let undefined = AnalysisError::NoConvergence { residual: f64::NAN, steps: 0 };
        let jacobian = self.equations(unknowns).ok_or(undefined)?.jacobian;
        let (model, _) = (self.family)(unknowns[last])?;
        Ok(free(&model, &unknowns.rows(0, last - self.generators.len()).into_owned(), &jacobian, rank))
    }

    fn tangent(&self, unknowns: &Column, before: Option<&Column>) -> Result<Column, AnalysisError> {
        let free = self.free(unknowns, DEGENERATE)?;
        let directions = free.ncols();
        match before {
            Some(before) if directions > 0 => Ok((&free * free.tr_mul(before)).normalize()),
            None if directions == 1 => {
                let rises = free[(free.nrows() - 1, 0)] >= 0.0;
                Ok(free.column(0) * if rises { 1.0 } else { -1.0 })
            }
            _ => Err(AnalysisError::Degenerate { kernel: directions, expected: 1 }),
        }
    }

    fn point(&self, unknowns: Column, tangent: Column) -> Result<At<N, M>, AnalysisError> {
        let last = unknowns.len() - 1;
        let (model, conditions) = (self.family)(unknowns[last])?;
        let problem = self.problem(&model, &conditions);
        let turn = problem.relative_equilibrium(&unknowns.rows(0, last).into_owned(), 0);
        assert_timeless(&model, &turn.point)?;
        let stability = turn.stability(&model)?;
        let phi = *model.orthonormal::<f64>(&turn.point).phi();
        let stretches = TwoPolar::of(&phi)?.stretches.iter().copied().collect();
        Ok(BranchPoint { parameter: unknowns[last], turn, stability, stretches, unknowns, tangent })
    }

    /// The point at a distance from another along its tangent.
    fn beyond(&self, from: &At<N, M>, distance: f64, floor: f64) -> Result<At<N, M>, AnalysisError> {
        let solution = self.corrected(&from.unknowns, &from.tangent, (distance, floor))?;
        let tangent = self.tangent(&solution.at, Some(&from.tangent))?;
        self.point(solution.at, tangent)
    }

    fn followed(&self, start: At<N, M>) -> Result<Branch<N, <M as Model<N>>::Point<f64>>, AnalysisError> {
        let mut branch = Branch { points: Vec::new(), special: Vec::new(), ended: None };
        let (mut now, mut step) = (start, self.step);
        while branch.points.len() < MOST_POINTS {
            let rise = step * now.tangent[now.tangent.len() - 1];
            let end = self.end(now.parameter + rise, rise, SHORTEST * step);
            if end.is_some_and(|end| (end - now.parameter) * rise <= 0.0) {
                break;
            }
            let next = end.map_or_else(|| self.beyond(&now, step, FLOOR).ok(), |end| self.at_end(&now, end));
            let is_next = |next: &At<N, M>| {
                let is_outside = self.end(next.parameter, next.parameter - now.parameter, 0.0).is_some();
                (end.is_some() || !is_outside) && next.tangent.dot(&now.tangent) > STRAIGHT
            };
            let Some(next) = next.filter(is_next) else {
                step *= 0.5;
                if step < SHORTEST * self.step {
                    branch.ended = Some(self.end_after(&now, step));
                    break;
                }
                continue;
            };
            let distance = now.tangent.dot(&(&next.unknowns - &now.unknowns));
            branch.special.extend(self.special(&now, &next, distance));
            branch.points.push(core::mem::replace(&mut now, next));
            step = (1.5 * step).min(self.step);
        }
        branch.points.push(now);
        Ok(branch)
    }

    /// The end of the range, where a parameter that rises or falls so is there or beyond.
    fn end(&self, parameter: f64, rise: f64, margin: f64) -> Option<f64> {
        let (low, high) = self.range;
        match rise {
            rise if rise > 0.0 && parameter >= high - margin => Some(high),
            rise if rise < 0.0 && parameter <= low + margin => Some(low),
            _ => None,
        }
    }

    /// The point at an end of the range near to the tangent at another.
    fn at_end(&self, now: &At<N, M>, end: f64) -> Option<At<N, M>> {
        let last = now.unknowns.len() - 1;
        let mut from = &now.unknowns + &now.tangent * ((end - now.parameter) / now.tangent[last]);
        from[last] = end;
        let axis = Column::from_fn(last + 1, |k, _| f64::from(u8::from(k == last)));
        let mut unknowns = self.corrected(&from, &axis, (0.0, FLOOR)).ok()?.at;
        unknowns[last] = end;
        let secant = &unknowns - &now.unknowns;
        let is_near = now.tangent.dot(&secant) > STRAIGHT * secant.norm();
        let tangent = self.tangent(&unknowns, Some(&now.tangent)).ok().filter(|_| is_near)?;
        self.point(unknowns, tangent).ok()
    }

    /// Why no step leads on.
    fn end_after(&self, last: &At<N, M>, step: f64) -> AnalysisError {
        let ahead = last.parameter + self.step * last.tangent[last.tangent.len() - 1];
        let family = (self.family)(ahead.max(self.range.0).min(self.range.1)).map_err(AnalysisError::from);
        let known = family.and_then(|(model, _)| assert_timeless(&model, &last.turn.point));
        known.err().unwrap_or(AnalysisError::StepUnderflow { step })
    }

    /// What is special between two points; what is not located is left out.
    fn special(&self, a: &At<N, M>, b: &At<N, M>, distance: f64) -> Vec<(Special, At<N, M>)> {
        let last = a.unknowns.len() - 1;
        let negative = |at: &At<N, M>| at.stability.rounded_stiffnesses().filter(|one| *one < 0.0).count();
        let grows = |at: &At<N, M>| matches!(at.stability.verdict, StabilityVerdict::Unstable { .. });
        let mode = negative(a).min(negative(b));
        let mut found = Vec::new();
        let between = |h: f64| match h {
            0.0 => Some(a.clone()),
            _ if h == distance => Some(b.clone()),
            _ => self.beyond(a, h, RANK_AT_BRANCH_POINT).ok(),
        };
        let mut locate = |kind: Special, value: Value<'_, N, M>| {
            let place = root(distance, |h| value(&between(h)?));
            found.extend(place.and_then(between).map(|point| (kind, point)));
        };
        let turns = (a.tangent[last] > 0.0) != (b.tangent[last] > 0.0);
        if turns {
            locate(Special::Fold, &|point| Some(point.tangent[last]));
        }
        if negative(a) != negative(b) && !turns {
            locate(Special::Bifurcation, &|point| point.stability.rounded_stiffnesses().nth(mode));
        }
        let (quiet, loud) = if grows(a) { (b, a) } else { (a, b) };
        if let Some(fastest) = loud.stability.fastest().filter(|_| grows(a) != grows(b)) {
            let damped: Value<'_, N, M> = &|point| point.stability.fastest().map(Eigenvalue::rate);
            let meeting: Value<'_, N, M> = &|point| point.stability.discriminant(fastest.value);
            let near = quiet.stability.nearest(fastest.value).map(|near| near.map(Eigenvalue::rate));
            let (meet, oscillates) = (near == Some([0.0; 2]), fastest.value.im.abs() > fastest.error);
            match (meet, oscillates) {
                (true, true) => locate(Special::Collision, meeting),
                (false, true) => locate(Special::Hopf, damped),
                _ if a.stability.signature.is_some() || turns => {}
                _ => locate(Special::Bifurcation, if meet { meeting } else { damped }),
            }
        }
        // Where an oscillation begins to grow it goes on.
        for (kind, point) in found.iter_mut().filter(|(kind, _)| *kind == Special::Hopf) {
            let (own, there) = (point.stability.fastest(), loud.stability.fastest());
            if own
                .zip(there)
                .is_some_and(|(own, there)| own.value.im.abs() <= RANK_AT_BRANCH_POINT * there.value.im.abs())
            {
                *kind = Special::Bifurcation;
            }
        }
        found
    }
}

/// A zero between 0 and an end at which the signs differ, by false position (the rule of Illinois).
fn root(end: f64, value: impl Fn(f64) -> Option<f64>) -> Option<f64> {
    let (mut low, mut high) = ((0.0, value(0.0)?), (end, value(end)?));
    let scale = low.1.abs() + high.1.abs();
    // A point of the branch itself.
    let is_zero = |end: &(f64, f64)| end.1.abs() < LOCATED * scale;
    if let Some((place, _)) = [low, high].into_iter().find(is_zero) {
        return Some(place);
    }
    for _ in 0..MOST_SECANTS {
        if low.1 * high.1 > 0.0 {
            return None;
        }
        let middle = (low.0 * high.1 - high.0 * low.1) / (high.1 - low.1);
        let there = value(middle)?;
        if there.abs() <= LOCATED * scale || (high.0 - low.0).abs() <= LOCATED * end {
            return Some(middle);
        }
        if there * high.1 < 0.0 {
            low = high;
        } else {
            low.1 *= 0.5;
        }
        high = (middle, there);
    }
    Some(high.0)
}
