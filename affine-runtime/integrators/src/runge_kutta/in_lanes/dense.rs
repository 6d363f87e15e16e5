//! Dense output of the body in a lane.

use super::RungeKutta8InLanes;
use crate::lanes::Lanes;
use crate::lanes::equations::Equations;
use crate::lie::{Flat, Sum};
use crate::runge_kutta::field::Field;
use crate::runge_kutta::pair::Step;
use crate::runge_kutta::step::Dense;
use crate::vectors::Baseline;
use affine_core::model::StateVector;

impl<T: Lanes, S: StateVector<T>, F: Equations<T, S>> RungeKutta8InLanes<T, S, F> {
    /// Keeps where each step began, from the next one on: what [`dense`](Self::dense) is made of.
    pub fn keep(&mut self) {
        self.before = Some((self.clocks.t, self.y, self.stages[0]));
    }

    /// Time reached in a lane.
    pub fn t(&self, lane: usize) -> f64 {
        self.clocks.t.lane(lane)
    }

    /// The last attempt in a lane was a step, of those that are kept.
    pub fn has_stepped(&self, lane: usize) -> bool {
        self.before.as_ref().is_some_and(|(t, ..)| t.lane(lane) != self.t(lane))
    }

    /// Dense output over the last step in a lane, which was [kept](Self::keep), by the equations of its body: that of
    /// [`RungeKutta8`](super::RungeKutta8), operation by operation. `None` where there was no step.
    pub fn dense<R: StateVector<f64>, L: StateVector<f64>>(
        &self,
        lane: usize,
        field: &impl Field<R, Flat, L>,
    ) -> Option<Dense<R>> {
        let (t, y, slope) = self.before.as_ref().filter(|_| self.has_stepped(lane))?;
        let of_lane = |lanes: &S| {
            let mut state = R::zeros();
            for (component, lanes) in state.as_mut().iter_mut().zip(lanes.as_ref()) {
                *component = lanes.lane(lane);
            }
            field.stored(&state)
        };
        let mut step = Step::at(t.lane(lane), of_lane(y), of_lane(slope));
        step.taken((self.t(lane), of_lane(&self.y)), self.stages[1..].iter().map(of_lane));
        let base = Sum::of(field.read(&of_lane(y)));
        let dense = step.dense_in(&field.stages(Baseline, Flat, &base));
        Some(dense.read(|stored| field.read(stored)))
    }
}
