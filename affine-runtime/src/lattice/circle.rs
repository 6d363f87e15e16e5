//! The lattice on the circle: U(n), (89).

use core::f64::consts::PI;

use super::flow::{groups, sound};
use super::{Lattice, LatticeForm, LatticeStop, StopReason};
use crate::error::Error;
use crate::frames::Matrix;
use crate::integrate::RungeKutta8;

/// A sine or cosine of half a difference below this stops the motion.
const NEAREST: f64 = 1e-6;

/// The motion of a model with `group = unitary`: `phi = L D R^T` in U(n) with `D = diag(exp(i q_a))` and `L`, `R` in SO(n),
/// by the Runge-Kutta method of order 8 with adaptive steps.
///
/// The equations have poles where two angles coincide, but for `M_ab = 0`, and where they are opposite, but for `N_ab = 0`.
/// A motion that comes within 1e-6 of one stops with [`StopReason::Coincidence`]: there is no other form to go on in.
#[derive(Clone, Debug)]
pub struct CircleFlow<'a, const N: usize, M: LatticeForm<N>> {
    model: &'a M,
    t: f64,
    lattice: Lattice<N>,
    tolerance: f64,
}

impl<'a, const N: usize, M: LatticeForm<N>> CircleFlow<'a, N, M> {
    /// The motion through `lattice` at the time `t`, with a tolerance of 1e-13 for each step.
    pub fn new(model: &'a M, t: f64, lattice: Lattice<N>) -> Self {
        Self { model, t, lattice, tolerance: 1e-13 }
    }

    /// Another tolerance for each step, `1e-15 <= eps < 1`; checked by [`advance_to`](Self::advance_to).
    #[must_use]
    pub fn tolerance(mut self, tolerance: f64) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// State reached.
    #[must_use]
    pub fn lattice(&self) -> &Lattice<N> {
        &self.lattice
    }

    /// Moves to the time `t`, forward or backward, and stands there exactly.
    ///
    /// # Errors
    /// [`LatticeStop`] with the last good state.
    pub fn advance_to(&mut self, t: f64) -> Result<&Lattice<N>, LatticeStop<N>> {
        let stop = |t: f64, lattice: &Lattice<N>, reason| LatticeStop { t, lattice: *lattice, reason };
        if !t.is_finite() {
            let reason = StopReason::Conversion(Error::NotFinite { quantity: "t" });
            return Err(stop(self.t, &self.lattice, reason));
        }
        sound(self.tolerance).map_err(|reason| stop(self.t, &self.lattice, reason))?;
        let (distance, _) = nearest(&self.lattice, &self.lattice);
        if distance < NEAREST {
            return Err(stop(self.t, &self.lattice, StopReason::Coincidence { distance }));
        }
        let (couplings, state) = self.lattice.framed::<M>();
        let rates = |_: f64, state: &M::Framed<f64>| self.model.framed_equations(&couplings, state);
        let mut steps = RungeKutta8::new(rates, groups::<N, M>(), (self.t, state), t, self.tolerance)
            .map_err(|failure| stop(self.t, &self.lattice, StopReason::Integration(failure)))?;
        while !steps.is_finished() {
            steps
                .advance()
                .map_err(|failure| stop(self.t, &self.lattice, StopReason::Integration(failure)))?;
            let next = Lattice::from_framed::<M>(&couplings, steps.y());
            let (distance, crossed) = nearest(&self.lattice, &next);
            if distance < NEAREST || crossed {
                return Err(stop(self.t, &self.lattice, StopReason::Coincidence { distance }));
            }
            (self.t, self.lattice) = (steps.t(), next);
        }
        Ok(&self.lattice)
    }
}

/// The least distance from a pole, and whether one was passed: `sin x_ab = 0` where `M_ab` does not vanish, `cos x_ab = 0`
/// where `N_ab` does not, `x_ab = (q_a - q_b)/2`.
fn nearest<const N: usize>(before: &Lattice<N>, after: &Lattice<N>) -> (f64, bool) {
    let pairs = (0..N).flat_map(|a| (0..a).map(move |b| (a, b)));
    let poles = pairs.flat_map(|(a, b)| {
        let [x, y] = [before, after].map(|lattice| lattice.half_difference(a, b) / PI);
        let meeting = (before.m[(a, b)] != 0.0).then_some((libm::sin(PI * y), x, y));
        let opposite = (before.n[(a, b)] != 0.0).then_some((libm::cos(PI * y), x + 0.5, y + 0.5));
        [meeting, opposite].into_iter().flatten()
    });
    poles.fold((f64::INFINITY, false), |(least, crossed), (distance, x, y)| {
        let distance = distance.abs();
        let passed = libm::floor(x) != libm::floor(y);
        (if distance < least { distance } else { least }, crossed || passed)
    })
}

impl<const N: usize> Lattice<N> {
    /// Real and imaginary part of `phi = L diag(exp(i q_a)) R^T` in U(n), for models with `group = unitary`.
    #[must_use]
    pub fn unitary_placement(&self) -> (Matrix<N>, Matrix<N>) {
        let of = |function: fn(f64) -> f64| {
            self.left * Matrix::from_diagonal(&self.q.map(function)) * self.right.transpose()
        };
        (of(libm::cos), of(libm::sin))
    }
}
