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
        macro_rules! stages {
            ($($number:literal $row:ident)*) => {
                $(
                    let (_, node) = NODES[$number - 2];
                    let [ref earlier @ .., (newest, last)] = $row;
                    let mut at = self.begin.positions.value;
                    plus_multiple(vectors, &mut at, &self.velocity, node * h);
                    plus_multiple(vectors, &mut at, &sum(vectors, &self.accelerations, earlier), h * h);
                    plus_multiple(vectors, &mut at, &self.accelerations[newest - 1], h * h * last);
                    self.evaluate((system, constants), $number, self.t + node * h, &at);
                )*
            };
        }
        stages!(2 A2 3 A3 4 A4 5 A5 6 A6 7 A7 8 A8 9 A9 10 A10 11 A11 12 A12 13 A13 14 A14 15 A15 16 A16 17 A17);
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
    ) {
        let force = system.force(t, constants, positions);
        self.forces[stage - 1] = force;
        self.accelerations[stage - 1] = system.drift(constants, &force);
    }
}

#[inline(always)]
fn scaled<H: StateVector<f64>>(h: f64, mut vector: H) -> H {
    vector.as_mut().iter_mut().for_each(|v| *v *= h);
    vector
}
