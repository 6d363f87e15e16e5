//! One step, whatever its size.

use super::SecondOrder;
use super::dormand_el_mikkawy_prince::*;
use crate::integrate::lie::Sum;
use crate::integrate::stages::{combination, difference};
use crate::model::StateVector;
use crate::scalar::Scalar;

const STAGES: usize = 17;

/// Solution less the embedded solution.
const POSITION_ERROR: [(usize, f64); POSITION.len()] = difference(POSITION, &EMBEDDED_POSITION);
/// The same of the momenta.
const MOMENTUM_ERROR: [(usize, f64); MOMENTUM.len()] = difference(MOMENTUM, &EMBEDDED_MOMENTUM);

/// Positions and momenta.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Point<H> {
    pub(super) positions: Sum<H>,
    pub(super) momenta: Sum<H>,
}

/// The step of the method from a point, and the forces at its stages.
#[derive(Clone, Debug)]
pub(super) struct Step<H> {
    t: f64,
    begin: Point<H>,
    /// At `(t_n + c_i h, q_i)`.
    forces: [H; STAGES],
}

impl<H: StateVector<f64>> Step<H> {
    /// Before any step.
    pub(super) fn at(t: f64, begin: Point<H>) -> Self {
        Self { t, begin, forces: [H::zeros(); STAGES] }
    }

    /// Turns to the step from a point where the force is given.
    pub(super) fn begin(&mut self, t: f64, begin: Point<H>, force: H) {
        (self.t, self.begin, self.forces[0]) = (t, begin, force);
    }

    /// When the step begins.
    pub(super) fn time(&self) -> f64 {
        self.t
    }

    /// Where the step begins.
    pub(super) fn start(&self) -> &Point<H> {
        &self.begin
    }

    /// The point after the time `h`. 16 evaluations.
    #[inline(always)]
    pub(super) fn attempt<S, C>(
        &mut self,
        system: &impl SecondOrder<S, C, Half = H>,
        constants: &C,
        h: f64,
    ) -> Point<H> {
        let Self { t, begin, forces } = self;
        let positions = |node: f64, sum: &H| {
            let mut positions = system.drift(constants, &mean(&begin.momenta.value, node, h, sum));
            for (q, begin) in positions.as_mut().iter_mut().zip(begin.positions.value.as_ref()) {
                *q = q.fma(h, *begin);
            }
            positions
        };
        macro_rules! stages {
            ($($number:literal $row:ident)*) => {
                $(
                    let (_, node) = NODES[$number - 2];
                    let at = positions(node, &combination(&*forces, &$row));
                    forces[$number - 1] = system.force(*t + node * h, constants, &at);
                )*
            };
        }
        stages!(2 A2 3 A3 4 A4 5 A5 6 A6 7 A7 8 A8 9 A9 10 A10 11 A11 12 A12 13 A13 14 A14 15 A15 16 A16 17 A17);
        let moving = mean(&begin.momenta.value, 1.0, h, &combination(&*forces, &POSITION));
        let rise = scaled(h, system.drift(constants, &moving));
        let pull = scaled(h, combination(&*forces, &MOMENTUM));
        Point { positions: begin.positions.plus(&rise), momenta: begin.momenta.plus(&pull) }
    }

    /// Differences, divided by `h`, of the solution to the embedded one, in positions and momenta.
    #[inline(always)]
    pub(super) fn error_slopes<S, C>(
        &self,
        system: &impl SecondOrder<S, C, Half = H>,
        constants: &C,
        h: f64,
    ) -> (H, H) {
        let moving = scaled(h, combination(&self.forces, &POSITION_ERROR));
        (system.drift(constants, &moving), combination(&self.forces, &MOMENTUM_ERROR))
    }
}

/// `c p + h sum_j a_j F_j`: the momentum that moves the positions of a stage for the time `h`.
#[inline(always)]
fn mean<H: StateVector<f64>>(momenta: &H, node: f64, h: f64, sum: &H) -> H {
    let mut mean = *sum;
    for (mean, p) in mean.as_mut().iter_mut().zip(momenta.as_ref()) {
        *mean = mean.fma(h, node * *p);
    }
    mean
}

#[inline(always)]
fn scaled<H: StateVector<f64>>(h: f64, mut vector: H) -> H {
    vector.as_mut().iter_mut().for_each(|v| *v *= h);
    vector
}
