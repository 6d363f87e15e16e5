//! One step, whatever its size.

use super::SecondOrder;
use super::dormand_el_mikkawy_prince::*;
use super::sums::{plus_multiple, sum};
use crate::integrate::lie::Sum;
use crate::integrate::stages::difference;
use crate::integrate::taylor::Vectors;
use crate::model::StateVector;

const STAGES: usize = 17;

/// Solution less the embedded solution.
const POSITION_ERROR: [(usize, f64); POSITION.len()] = difference(POSITION, &EMBEDDED_POSITION);
/// The same of the momenta.
const MOMENTUM_ERROR: [(usize, f64); MOMENTUM.len()] = difference(MOMENTUM, &EMBEDDED_MOMENTUM);

/// A stage after the first.
struct Later {
    number: usize,
    /// `c_i`
    node: f64,
    /// `a_ij` of the stages before the one just before.
    earlier: &'static [(usize, f64)],
    /// `a_i,i-1`
    newest: f64,
}

static LATER: [Later; STAGES - 1] = [
    later(2, &A2),
    later(3, &A3),
    later(4, &A4),
    later(5, &A5),
    later(6, &A6),
    later(7, &A7),
    later(8, &A8),
    later(9, &A9),
    later(10, &A10),
    later(11, &A11),
    later(12, &A12),
    later(13, &A13),
    later(14, &A14),
    later(15, &A15),
    later(16, &A16),
    later(17, &A17),
];

const fn later(number: usize, row: &'static [(usize, f64)]) -> Later {
    let (_, node) = NODES[number - 2];
    match row {
        [earlier @ .., (last, newest)] if *last == number - 1 => {
            Later { number, node, earlier, newest: *newest }
        }
        earlier => Later { number, node, earlier, newest: 0.0 },
    }
}

/// Positions and momenta.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Point<H> {
    pub(super) positions: Sum<H>,
    pub(super) momenta: Sum<H>,
}

/// The step of the method from a point, and what its stages found. As `V` is linear, the positions of a stage are
///
/// ```text
/// q_i = q + c_i h V(p) + h^2 sum_j a_ij A_j,    A_j = V(F_j)
/// ```
///
/// where nothing but `A_(i-1)` waits for the stage before.
#[derive(Clone, Debug)]
pub(super) struct Step<H> {
    t: f64,
    begin: Point<H>,
    /// `V(p)` at the beginning.
    velocity: H,
    /// `F_i`, at `(t_n + c_i h, q_i)`.
    forces: [H; STAGES],
    /// `A_i`.
    accelerations: [H; STAGES],
}

/// What a step comes to.
pub(super) struct Reached<H> {
    pub(super) point: Point<H>,
    /// Differences, divided by `h`, of the solution to the embedded one, in positions and momenta.
    pub(super) error_slopes: [H; 2],
}

impl<H: StateVector<f64>> Step<H> {
    /// Before any step.
    pub(super) fn at(t: f64, begin: Point<H>) -> Self {
        let [velocity, none] = [H::zeros(); 2];
        Self { t, begin, velocity, forces: [none; STAGES], accelerations: [none; STAGES] }
    }

    /// When the step begins.
    pub(super) fn time(&self) -> f64 {
        self.t
    }

    /// Where the step begins.
    pub(super) fn start(&self) -> &Point<H> {
        &self.begin
    }

    /// Turns to the step from a point. 1 evaluation.
    #[inline(always)]
    pub(super) fn begin<S, C>(
        &mut self,
        system: &impl SecondOrder<S, C, Half = H>,
        constants: &C,
        (t, begin): (f64, Point<H>),
    ) {
        (self.t, self.begin) = (t, begin);
        self.velocity = system.drift(constants, &begin.momenta.value);
        self.evaluate((system, constants), 1, t, &begin.positions.value);
    }

    /// The point after the time `h`. 16 evaluations.
    #[inline(always)]
    pub(super) fn attempt<S, C>(
        &mut self,
        vectors: impl Vectors,
        (system, constants): (&impl SecondOrder<S, C, Half = H>, &C),
        h: f64,
    ) -> Reached<H> {
        // By value: what was just stored in pieces is slow to load in others.
        let [mut newest, ..] = self.accelerations;
        for stage in &LATER {
            let mut at = self.begin.positions.value;
            plus_multiple(vectors, &mut at, &self.velocity, stage.node * h);
            plus_multiple(vectors, &mut at, &sum(vectors, &self.accelerations, stage.earlier), h * h);
            plus_multiple(vectors, &mut at, &newest, h * h * stage.newest);
            newest = self.evaluate((system, constants), stage.number, self.t + stage.node * h, &at);
        }
        let (forces, accelerations) = (&self.forces, &self.accelerations);
        let mut rise = scaled(h, self.velocity);
        plus_multiple(vectors, &mut rise, &sum(vectors, accelerations, &POSITION), h * h);
        let pull = scaled(h, sum(vectors, forces, &MOMENTUM));
        let Point { positions, momenta } = &self.begin;
        Reached {
            point: Point { positions: positions.plus(&rise), momenta: momenta.plus(&pull) },
            error_slopes: [
                scaled(h, sum(vectors, accelerations, &POSITION_ERROR)),
                sum(vectors, forces, &MOMENTUM_ERROR),
            ],
        }
    }

    /// `F` and `V(F)` of a stage.
    #[inline(always)]
    fn evaluate<S, C>(
        &mut self,
        (system, constants): (&impl SecondOrder<S, C, Half = H>, &C),
        stage: usize,
        t: f64,
        positions: &H,
    ) -> H {
        let force = system.force(t, constants, positions);
        let acceleration = system.drift(constants, &force);
        self.forces[stage - 1] = force;
        self.accelerations[stage - 1] = acceleration;
        acceleration
    }
}

#[inline(always)]
fn scaled<H: StateVector<f64>>(h: f64, mut vector: H) -> H {
    vector.as_mut().iter_mut().for_each(|v| *v *= h);
    vector
}
