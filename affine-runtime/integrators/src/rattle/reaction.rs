//! Separable Hamilton's equations under `det phi = 1` as equations on SL(n): the multiplier eliminated.

use super::Failure;
use super::layout::Layout;
use crate::lie::adjugate;
use affine_core::frames::Matrix;
use affine_core::model::{Group, StateVector};

/// The equations of a body with `H = T(Pi) + U(t, phi)` under `det phi = 1`, with `Oh = phi^-1 phi_dot` in the place of
/// `Pi`:
///
/// ```text
/// phi' = phi Oh,      Oh' = phi^-1 T'(-(dU/dphi)^T + lambda phi^-1) - Oh^2,      lambda such that tr Oh' = 0
/// ```
///
/// The hidden constraint is `tr Oh = 0`, linear with constant coefficients: every Runge-Kutta method keeps it up to
/// rounding, as it keeps `det phi = 1` in a chart of SL(n).
#[derive(Clone, Debug)]
pub struct Reaction<const N: usize> {
    layout: Layout<N>,
}

impl<const N: usize> Reaction<N> {
    /// The layout and the masses of the free equations `f` at `(t, y)`.
    ///
    /// # Errors
    /// [`Failure::NotSeparable`], [`Failure::NotFinite`].
    pub fn of<S: StateVector<f64>>(
        groups: &[Group],
        f: &impl Fn(f64, &S) -> S,
        (t, y): (f64, &S),
    ) -> Result<Self, Failure> {
        Ok(Self { layout: Layout::of(groups, f, (t, y))? })
    }

    /// Evaluations of the free equations that looking at them took.
    #[must_use]
    pub fn evaluations(&self) -> u64 {
        self.layout.evaluations()
    }

    /// The state with `Oh` in the place of `Pi`.
    #[must_use]
    pub fn with_velocity<S: StateVector<f64>>(&self, state: &S) -> S {
        let velocity = self.layout.placement(&self.layout.drift(state, 1.0));
        let oh = without_trace(&(adjugate(&self.layout.placement(state)) * velocity));
        self.layout.with_momentum(state, &oh)
    }

    /// The state with `Pi` again.
    #[must_use]
    pub fn with_momentum<S: StateVector<f64>>(&self, state: &S) -> S {
        let velocity = self.layout.placement(state) * self.layout.momentum_of(state);
        self.layout.with_momentum(state, &self.layout.legendre(&velocity))
    }

    /// The time derivative of a state with `Oh`.
    pub fn rates<S: StateVector<f64>>(&self, f: &impl Fn(f64, &S) -> S, t: f64, state: &S) -> S {
        let free = f(t, &self.with_momentum(state));
        let oh = self.layout.momentum_of(state);
        let inverse = adjugate(&self.layout.placement(state));
        let accelerated = |rates: &S| inverse * self.layout.placement(&self.layout.drift(rates, 1.0));
        let along = accelerated(&self.layout.momentum(&inverse));
        let rise = accelerated(&free) - oh * oh;
        let multiplier = -rise.trace() / along.trace();
        self.layout.with_momentum(&free, &without_trace(&(rise + along * multiplier)))
    }
}

fn without_trace<const N: usize>(matrix: &Matrix<N>) -> Matrix<N> {
    matrix - Matrix::<N>::identity() * (matrix.trace() / N as f64)
}
