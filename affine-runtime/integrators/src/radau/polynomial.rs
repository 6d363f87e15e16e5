//! The collocation polynomial of the last step: states within it, and where the next one would lead.

use super::RadauSteps;
use super::coefficients::MOST_STAGES;
use super::solve::{Jacobian, Stages, plus};
use crate::drive::Control;
use crate::lie::Coordinates;
use affine_core::__private::numerics::norm;
use affine_core::model::StateVector;

impl<S: StateVector<f64>, F: Fn(f64, &S) -> S, J: Jacobian<S>, C: Coordinates<S>> RadauSteps<S, F, J, C> {
    /// Where the polynomial of the last step would lead, unless that is too far to be believed.
    pub(super) fn continued(&self, h: f64) -> Option<Stages<S>> {
        if self.h == 0.0 {
            return None;
        }
        let mut guess = [S::zeros(); MOST_STAGES];
        let reached = &self.stages[self.tableau.stages() - 1];
        for (guess, node) in guess.iter_mut().zip(self.tableau.nodes) {
            *guess = self.polynomial(1.0 + node * h / self.h);
            for (guess, reached) in guess.as_mut().iter_mut().zip(reached.as_ref()) {
                *guess -= reached;
            }
        }
        let base = self.end.value;
        let is_near = |guess: &S| {
            let after = plus(&base, guess);
            let value = |range: core::ops::Range<usize>| norm(&guess.as_ref()[range]);
            self.error_norm.largest_within(h.abs(), &self.largest, base.as_ref(), after.as_ref(), value) < 0.5
        };
        guess.iter().take(self.tableau.stages()).all(is_near).then_some(guess)
    }

    /// The collocation polynomial of the last step at a part of it, from its beginning.
    fn polynomial(&self, part: f64) -> S {
        let mut sum = S::zeros();
        for (i, stage) in self.stages.iter().enumerate().take(self.tableau.stages()) {
            let weight = self.tableau.lagrange(i, part);
            for (sum, stage) in sum.as_mut().iter_mut().zip(stage.as_ref()) {
                *sum += weight * stage;
            }
        }
        sum
    }

    /// The state at a part of the last step.
    pub(super) fn inside(&self, part: f64) -> S {
        let origin = self.coordinates.origin(&self.begin).value;
        self.coordinates.state(&self.begin, &plus(&origin, &self.polynomial(part))).value
    }

    /// The state at a time within the last step, by the collocation polynomial; without evaluations, but for the work up to
    /// there. The state reached where no step has been taken.
    pub(super) fn between(&self, t: f64, control: &mut Control) -> S {
        if self.h == 0.0 || t == self.t {
            return self.end.value;
        }
        let from = self.t - self.h;
        let mut state = self.inside((t - from) / self.h);
        if let Some(work) = self.work {
            let done = work.along(from, t - from, |t| (self.f)(t, &self.inside((t - from) / self.h)));
            control.statistics.evaluations += work.evaluations();
            state.as_mut()[work.place] = self.begin.value.as_ref()[work.place] + done;
        }
        state
    }
}
