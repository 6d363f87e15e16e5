//! One step, whatever its size.

use core::marker::PhantomData;

use super::sums::{of_row, plus_multiple};
use super::tableau::{MOST_STAGES, Tableau};
use crate::lie::Sum;
use crate::widest::{Work, widest};
use affine_core::__private::Vectors;
use affine_core::model::StateVector;
use affine_core::scalar::Scalar;
use affine_core::system::SecondOrder;

/// The step of the method from a state, and what its stages found. As `V` is linear, the positions of a stage are
///
/// ```text
/// q_i = q + c_i h V(p) + h^2 sum_j a_ij A_j,    A_j = V(F_j)
/// ```
///
/// where nothing but `A_(i-1)` waits for the stage before.
#[derive(Clone, Debug)]
pub(super) struct Step<H> {
    tableau: &'static Tableau,
    t: f64,
    begin: [Sum<H>; 2],
    /// `V(p)` at the beginning.
    velocity: H,
    /// `F_i`, at `(t_n + c_i h, q_i)`.
    forces: [H; MOST_STAGES],
    /// `A_i`.
    accelerations: [H; MOST_STAGES],
    /// Positions and momenta in the end.
    end: [Sum<H>; 2],
    /// Their differences, divided by `h`, to the embedded solution.
    error_slopes: [H; 2],
}

impl<H: StateVector<f64>> Step<H> {
    /// Before any step from positions and momenta.
    pub(super) fn at(tableau: &'static Tableau, t: f64, begin: [Sum<H>; 2]) -> Self {
        let none = H::zeros();
        let (forces, accelerations) = ([none; MOST_STAGES], [none; MOST_STAGES]);
        let (velocity, error_slopes) = (none, [none; 2]);
        Self { tableau, t, begin, velocity, forces, accelerations, end: begin, error_slopes }
    }

    /// The method.
    pub(super) fn tableau(&self) -> &'static Tableau {
        self.tableau
    }

    /// Positions and momenta in the end.
    pub(super) fn end(&self) -> &[Sum<H>; 2] {
        &self.end
    }

    /// Differences, divided by `h`, of positions and momenta in the end to the embedded solution.
    pub(super) fn error_slopes(&self) -> &[H; 2] {
        &self.error_slopes
    }

    /// `F` in the end, where that is a stage.
    pub(super) fn end_force(&self) -> Option<H> {
        self.tableau.closes.then(|| self.forces[self.tableau.inner.len() + 1])
    }

    /// Turns to the step from positions and momenta where the force is known.
    #[inline(always)]
    pub(super) fn begin<S, C>(
        &mut self,
        (system, constants): (&impl SecondOrder<S, C, Half = H>, &C),
        (t, begin): (f64, &[Sum<H>; 2]),
        force: H,
    ) {
        (self.t, self.begin) = (t, *begin);
        self.velocity = system.drift(constants, &begin[1].value);
        self.forces[0] = force;
        self.accelerations[0] = system.drift(constants, &force);
    }

    /// Steps to the time `end`: [`Tableau::evaluations`].
    pub(super) fn attempt<S, C, R: SecondOrder<S, C, Half = H>>(&mut self, motion: (&R, &C), end: f64) {
        widest(Attempt { step: self, motion, end, of: PhantomData });
    }

    /// The same, on the vectors of a processor.
    #[inline(always)]
    pub(super) fn attempt_in<S, C, R: SecondOrder<S, C, Half = H>>(
        &mut self,
        vectors: impl Vectors,
        (system, constants): (&R, &C),
        end: f64,
    ) {
        let (h, tableau) = (end - self.t, self.tableau);
        let square = h * h;
        let [positions, momenta] = self.begin;
        // By value: what was just stored in pieces is slow to load in others.
        let [mut newest, ..] = self.accelerations;
        for stage in tableau.inner {
            let mut at = positions.value;
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
        self.end[0] = positions.plus(&rise);
        if tableau.closes {
            let positions = self.end[0].value;
            self.evaluate((system, constants), tableau.inner.len() + 2, end, &positions);
        }
        let (forces, accelerations) = (&self.forces, &self.accelerations);
        self.end[1] = momenta.plus(&scaled(h, of_row(vectors, forces, tableau.momentum)));
        let position_error = scaled(h, of_row(vectors, accelerations, tableau.position_error));
        self.error_slopes = [position_error, of_row(vectors, forces, tableau.momentum_error)];
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
        let place = (self.forces.get_mut(stage - 1), self.accelerations.get_mut(stage - 1));
        if let (Some(kept_force), Some(kept_acceleration)) = place {
            (*kept_force, *kept_acceleration) = (force, acceleration);
        }
        acceleration
    }
}

/// A step to the time `end`.
struct Attempt<'a, S, H, C, R> {
    step: &'a mut Step<H>,
    motion: (&'a R, &'a C),
    end: f64,
    of: PhantomData<S>,
}

impl<S, H: StateVector<f64>, C, R: SecondOrder<S, C, Half = H>> Work for Attempt<'_, S, H, C, R> {
    type Output = ();
    #[inline(always)]
    fn run(self, vectors: impl Vectors) {
        self.step.attempt_in(vectors.rounding_as_numbers(), self.motion, self.end);
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
