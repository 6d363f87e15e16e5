//! What an integration begins with.

#[cfg(feature = "std")]
mod in_lanes;

#[cfg(feature = "std")]
pub use in_lanes::starts_in_lanes;

use super::Pair;
use crate::error_norm::ErrorNorm;
use crate::finite::is_finite;
use crate::step_size::first_step;
use crate::{Failure, sound};
use affine_core::model::{Group, StateVector};

/// Slope, norm and first step at a state.
#[derive(Clone, Copy, Debug)]
pub struct Start<S> {
    /// `f(t0, y0)`.
    pub slope: S,
    /// With the inertias of that state.
    pub error_norm: ErrorNorm,
    /// Length of the first step, which has the sign of no direction.
    pub length: f64,
}

impl<S: StateVector<f64>> Start<S> {
    /// The start of `y' = f(t, y)` from `(t0, y0)` to `t_end`, and the evaluations that it took.
    ///
    /// # Errors
    /// [`Failure::NotFinite`] where `y0` or `f(t0, y0)` is not finite; [`Failure::Time`], [`Failure::Tolerance`].
    pub fn of<P: Pair>(
        f: &dyn Fn(f64, &S) -> S,
        groups: &'static [Group],
        (t0, y0): (f64, &S),
        t_end: f64,
        tolerance: f64,
    ) -> Result<(Self, u64), Failure> {
        sound(t0, t_end, tolerance)?;
        let slope = f(t0, y0);
        if !is_finite(y0) || !is_finite(&slope) {
            return Err(Failure::NotFinite);
        }
        if t_end == t0 {
            return Ok((Self { slope, error_norm: ErrorNorm::new(groups), length: 0.0 }, 1));
        }
        let at_start = (t0, y0, &slope);
        let (error_norm, probes) = ErrorNorm::probed(groups, f, at_start);
        let length = first_step(f, &error_norm, at_start, t_end - t0, (tolerance, P::ERROR_ORDER));
        Ok((Self { slope, error_norm, length }, probes + 2))
    }
}
