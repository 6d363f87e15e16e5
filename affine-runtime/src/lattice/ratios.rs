//! The lattice in ratios of stretches.

use super::{Lattice, TwoPolarForm};
use crate::frames::{Matrix, Vector};
use crate::model::{Operations, StateVector};
use crate::scalar::Scalar;

/// `emit(two_polar, ratios)`: the lattice of a model of affine velocities without potential, whose equations have neither
/// exponentials nor coefficients in
///
/// ```text
/// t_ab = exp(q_b - q_a),  b = a + 1;   p_a/alpha;   U = (M + N)/(2 alpha),  W = (M - N)/(2 alpha)
/// ```
///
/// The state is `t_12, (t_23,) p_1, .., ` and for `n = 3` `U_12, U_13, U_23, W_12, W_13, W_23`; for `n = 2` `U_12, W_12` are
/// the couplings, which do not move. Nothing overflows for `q_1 >= .. >= q_n`. The mean of `q_a` is no part of it: it moves
/// uniformly, [`mean_rate`](Self::mean_rate); the frames follow from the closed form of the geodesics.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no lattice in ratios of stretches in dimension {N}",
    label = "no ratios here",
    note = "write `emit(two_polar, ratios)` in its `#[affine_model(...)]`"
)]
pub trait RatioForm<const N: usize>: TwoPolarForm<N> {
    /// Operations of the equations.
    const RATIO_OPERATIONS: Operations;

    /// The state.
    type Ratios<T: Scalar>: StateVector<T>;

    /// The time derivative of the state.
    fn ratio_equations<T: Scalar>(
        &self,
        couplings: &Self::Couplings<T>,
        state: &Self::Ratios<T>,
    ) -> Self::Ratios<T>;

    /// Couplings and state of a lattice, its stretches taken in the order in which they stand.
    fn in_ratios(&self, lattice: &Lattice<N>) -> (Self::Couplings<f64>, Self::Ratios<f64>) {
        let scale = self.inverse_alpha();
        let (mut couplings, mut state) = (Self::Couplings::<f64>::zeros(), Self::Ratios::<f64>::zeros());
        let ratios = (1..N).map(|b| libm::exp(lattice.q[b] - lattice.q[b - 1]));
        let momenta = lattice.p.iter().map(|p| p * scale);
        let half = |sign: f64| {
            let above = (0..N).flat_map(|a| (a + 1..N).map(move |b| (a, b)));
            above.map(move |at| 0.5 * scale * (lattice.m[at] + sign * lattice.n[at]))
        };
        let skew = half(1.0).chain(half(-1.0));
        let moving = ratios.chain(momenta).chain(skew.clone().take(if N == 2 { 0 } else { N * (N - 1) }));
        state.as_mut().iter_mut().zip(moving).for_each(|(place, value)| *place = value);
        couplings.as_mut().iter_mut().zip(skew).for_each(|(place, value)| *place = value);
        (couplings, state)
    }

    /// The lattice of such a state with the mean `q` of its log-stretches, and `L = R = 1`.
    fn of_ratios(&self, couplings: &Self::Couplings<f64>, state: &Self::Ratios<f64>, q: f64) -> Lattice<N> {
        let (scale, values) = (1.0 / self.inverse_alpha(), state.as_ref());
        let mut places = Vector::<N>::zeros();
        (1..N).for_each(|b| places[b] = places[b - 1] + libm::log(values[b - 1]));
        let shift = q - places.sum() / N as f64;
        let skew = if N == 2 { couplings.as_ref() } else { &values[2 * N - 1..] };
        let (mut m, mut n) = (Matrix::<N>::zeros(), Matrix::<N>::zeros());
        let pairs = N * (N - 1) / 2;
        for (k, (a, b)) in (0..N).flat_map(|a| (a + 1..N).map(move |b| (a, b))).enumerate() {
            let (u, w) = (skew[k], skew[pairs + k]);
            (m[(a, b)], m[(b, a)]) = (scale * (u + w), -scale * (u + w));
            (n[(a, b)], n[(b, a)]) = (scale * (u - w), -scale * (u - w));
        }
        Lattice {
            q: places.map(|place| place + shift),
            p: Vector::<N>::from_fn(|a, _| scale * values[N - 1 + a]),
            m,
            n,
            left: Matrix::identity(),
            right: Matrix::identity(),
        }
    }

    /// `d/dt (q_1 + .. + q_n)/n = p (1/(n alpha) + 1/beta)`, `p` the conserved sum of the momenta.
    fn mean_rate(&self, lattice: &Lattice<N>) -> f64 {
        let rate = self.isotropic().map_or(0.0, |h| h.inverse_alpha / N as f64 + h.inverse_beta);
        lattice.p.sum() * rate
    }

    /// `1/alpha`: d'Alembert's model, which has none, has no ratios either.
    #[doc(hidden)]
    fn inverse_alpha(&self) -> f64 {
        self.isotropic().map_or(1.0, |h| h.inverse_alpha)
    }
}
