//! One step, whatever its size.

use super::SecondOrder;
use super::sums::{of_row, plus_multiple};
use super::tableau::{MOST_STAGES, Tableau};
use crate::integrate::lie::Sum;
use crate::integrate::taylor::Vectors;
use crate::integrate::widest::{Work, widest};
use crate::model::StateVector;
use crate::scalar::Scalar;

/// The step of the method from a state, and what its stages found. As `V` is linear, the positions of a stage are
///
/// ```text
/// q_i = q + c_i h V(p) + h^2 sum_j a_ij A_j,    A_j = V(F_j)
/// ```
///
/// where nothing but `A_(i-1)` waits for the stage before.
#[derive(Clone, Debug)]
pub(super) struct Step<S, H> {
    tableau: &'static Tableau,
    t: f64,
    begin: Sum<S>,
    /// `V(p)` at the beginning.
    velocity: H,
    /// `F_i`, at `(t_n + c_i h, q_i)`.
    forces: [H; MOST_STAGES],
    /// `A_i`.
    accelerations: [H; MOST_STAGES],
    /// The state in the end.
    end: Sum<S>,
    /// Difference, divided by `h`, of the state in the end to the embedded solution.
    error_slope: S,
}

impl<S: StateVector<f64>, H: StateVector<f64>> Step<S, H> {
    /// Before any step.
    pub(super) fn at(tableau: &'static Tableau, t: f64, state: S) -> Self {
        let [velocity, none] = [H::zeros(); 2];
        let (forces, accelerations) = ([none; MOST_STAGES], [none; MOST_STAGES]);
        let begin = Sum::of(state);
        Self { tableau, t, begin, velocity, forces, accelerations, end: begin, error_slope: S::zeros() }
    }

    /// The method.
    pub(super) fn tableau(&self) -> &'static Tableau {
        self.tableau
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

    /// `F` in the end, where that is a stage.
    pub(super) fn end_force(&self) -> Option<H> {
        self.tableau.closes.then(|| self.forces[self.tableau.inner.len() + 1])
    }

    /// Turns to the step from a state where the force is known.
    #[inline(always)]
    pub(super) fn begin<C>(
        &mut self,
        (system, constants): (&impl SecondOrder<S, C, Half = H>, &C),
        t: f64,
        state: &Sum<S>,
        force: H,
    ) {
        (self.t, self.begin) = (t, *state);
        let [_, momenta] = halves(&state.value);
        self.velocity = system.drift(constants, &momenta);
        self.forces[0] = force;
        self.accelerations[0] = system.drift(constants, &force);
    }

    /// Steps to the time `end`: [`Tableau::evaluations`].
    pub(super) fn attempt<C, R: SecondOrder<S, C, Half = H>>(&mut self, motion: (&R, &C), end: f64) {
        widest(Attempt { step: self, motion, end });
    }

    #[inline(always)]
    fn attempt_in<C, R: SecondOrder<S, C, Half = H>>(
        &mut self,
        vectors: impl Vectors,
        (system, constants): (&R, &C),
        end: f64,
    ) {
        let (h, tableau) = (end - self.t, self.tableau);
        let square = h * h;
        let [positions, _]: [H; 2] = halves(&self.begin.value);
        // By value: what was just stored in pieces is slow to load in others.
        let [mut newest, ..] = self.accelerations;
        for stage in tableau.inner {
            let mut at = positions;
            plus_multiple(vectors, &mut at, &self.velocity, stage.node * h);
            let earlier = of_row(vectors, &self.accelerations, stage.earlier);
            plus_multiple(vectors, &mut at, &earlier, square);
            for (at, newest) in at.as_mut().iter_mut().zip(newest.as_ref()) {
                *at = newest.fma(square * stage.newest, *at);
            }
            newest = self.evaluate((system, constants), stage.number, self.t + stage.node * h, &at);
        }
        let mut rise = scaled(h, self.velocity);
        plus_multiple(vectors, &mut rise, &of_row(vectors, &self.accelerations, tableau.position), square);
        if tableau.closes {
            let [positions, _] = halves(&self.begin.plus(&joined(&rise, &H::zeros())).value);
            self.evaluate((system, constants), tableau.inner.len() + 2, end, &positions);
        }
        let (forces, accelerations) = (&self.forces, &self.accelerations);
        let pull = scaled(h, of_row(vectors, forces, tableau.momentum));
        self.end = self.begin.plus(&joined(&rise, &pull));
        let position_error = scaled(h, of_row(vectors, accelerations, tableau.position_error));
        self.error_slope = joined(&position_error, &of_row(vectors, forces, tableau.momentum_error));
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
        let place = (self.forces.get_mut(stage - 1), self.accelerations.get_mut(stage - 1));
        if let (Some(kept_force), Some(kept_acceleration)) = place {
            (*kept_force, *kept_acceleration) = (force, acceleration);
        }
        acceleration
    }
}

/// A step from where one begins.
struct Attempt<'a, S, H, C, R> {
    step: &'a mut Step<S, H>,
    motion: (&'a R, &'a C),
    end: f64,
}

impl<S: StateVector<f64>, H: StateVector<f64>, C, R: SecondOrder<S, C, Half = H>> Work
    for Attempt<'_, S, H, C, R>
{
    type Output = ();
    #[inline(always)]
    fn run(self, vectors: impl Vectors) {
        self.step.attempt_in(vectors, self.motion, self.end);
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
