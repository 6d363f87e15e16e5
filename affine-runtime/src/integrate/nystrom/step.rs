//! One step, whatever its size.

use super::SecondOrder;
use super::dormand_el_mikkawy_prince::*;
use super::sums::{plus_multiple, sum};
use crate::integrate::lie::Sum;
use crate::integrate::stages::difference;
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
    /// `a_i,i-1`; the last two stages do not wait for each other.
    newest: Option<f64>,
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
            Later { number, node, earlier, newest: Some(*newest) }
        }
        earlier => Later { number, node, earlier, newest: None },
    }
}

/// The step of the method from a state, and what its stages found. As `V` is linear, the positions of a stage are
///
/// ```text
/// q_i = q + c_i h V(p) + h^2 sum_j a_ij A_j,    A_j = V(F_j)
/// ```
///
/// where nothing but `A_(i-1)` waits for the stage before.
#[derive(Clone, Debug)]
pub(super) struct Step<S, H> {
    t: f64,
    begin: Sum<S>,
    /// `V(p)` at the beginning.
    velocity: H,
    /// `F_i`, at `(t_n + c_i h, q_i)`.
    forces: [H; STAGES],
    /// `A_i`.
    accelerations: [H; STAGES],
    /// The state in the end.
    end: Sum<S>,
    /// Difference, divided by `h`, of the state in the end to the embedded solution.
    error_slope: S,
}

impl<S: StateVector<f64>, H: StateVector<f64>> Step<S, H> {
    /// Before any step.
    pub(super) fn at(t: f64, state: S) -> Self {
        let [velocity, none] = [H::zeros(); 2];
        let (forces, accelerations) = ([none; STAGES], [none; STAGES]);
        let begin = Sum::of(state);
        Self { t, begin, velocity, forces, accelerations, end: begin, error_slope: S::zeros() }
    }

    /// When the step begins.
    pub(super) fn time(&self) -> f64 {
        self.t
    }

    /// Where the step begins.
    pub(super) fn start(&self) -> &Sum<S> {
        &self.begin
    }

    /// Where it ends.
    pub(super) fn end(&self) -> &Sum<S> {
        &self.end
    }

    /// Difference, divided by `h`, of the state in the end to the embedded solution.
    pub(super) fn error_slope(&self) -> &S {
        &self.error_slope
    }

    /// Turns to the step from a state. 1 evaluation.
    #[inline(always)]
    pub(super) fn begin<C>(
        &mut self,
        (system, constants): (&impl SecondOrder<S, C, Half = H>, &C),
        t: f64,
        state: &Sum<S>,
    ) {
        (self.t, self.begin) = (t, *state);
        let [positions, momenta] = halves(&state.value);
        self.velocity = system.drift(constants, &momenta);
        self.evaluate((system, constants), 1, t, &positions);
    }

    /// Steps for the time `h`. 16 evaluations.
    #[inline(always)]
    pub(super) fn attempt<C>(
        &mut self,
        (system, constants): (&impl SecondOrder<S, C, Half = H>, &C),
        h: f64,
    ) {
        let [positions, _]: [H; 2] = halves(&self.begin.value);
        // By value: what was just stored in pieces is slow to load in others.
        let [mut newest, ..] = self.accelerations;
        for stage in &LATER {
            let mut at = positions;
            plus_multiple(&mut at, &self.velocity, stage.node * h);
            plus_multiple(&mut at, &sum(&self.accelerations, stage.earlier), h * h);
            if let Some(weight) = stage.newest {
                plus_multiple(&mut at, &newest, h * h * weight);
            }
            newest = self.evaluate((system, constants), stage.number, self.t + stage.node * h, &at);
        }
        let (forces, accelerations) = (&self.forces, &self.accelerations);
        let mut rise = scaled(h, self.velocity);
        plus_multiple(&mut rise, &sum(accelerations, &POSITION), h * h);
        let pull = scaled(h, sum(forces, &MOMENTUM));
        self.end = self.begin.plus(&joined(&rise, &pull));
        let position_error = scaled(h, sum(accelerations, &POSITION_ERROR));
        self.error_slope = joined(&position_error, &sum(forces, &MOMENTUM_ERROR));
    }

    /// `F` and `V(F)` of a stage.
    #[inline(always)]
    fn evaluate<C>(
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

/// Positions and momenta of a state.
#[inline(always)]
pub(super) fn halves<S: StateVector<f64>, H: StateVector<f64>>(state: &S) -> [H; 2] {
    let [mut positions, mut momenta] = [H::zeros(); 2];
    positions.as_mut().copy_from_slice(&state.as_ref()[..H::LEN]);
    momenta.as_mut().copy_from_slice(&state.as_ref()[H::LEN..2 * H::LEN]);
    [positions, momenta]
}

/// The state of positions and momenta, the rest being zero.
#[inline(always)]
pub(super) fn joined<S: StateVector<f64>, H: StateVector<f64>>(positions: &H, momenta: &H) -> S {
    let mut state = S::zeros();
    state.as_mut()[..H::LEN].copy_from_slice(positions.as_ref());
    state.as_mut()[H::LEN..2 * H::LEN].copy_from_slice(momenta.as_ref());
    state
}

#[inline(always)]
fn scaled<H: StateVector<f64>>(h: f64, mut vector: H) -> H {
    vector.as_mut().iter_mut().for_each(|v| *v *= h);
    vector
}
