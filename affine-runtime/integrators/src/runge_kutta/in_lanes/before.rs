//! Where the steps of bodies in lanes began.

use crate::lanes::Lanes;
use affine_core::model::StateVector;

/// Where steps began, and the polynomials over them.
pub(super) struct Before<T, S> {
    pub(super) t: T,
    pub(super) y: S,
    pub(super) coefficients: [S; 7],
    /// The coefficients are those of the last steps.
    pub(super) is_dense: bool,
}

impl<T: Lanes, S: StateVector<T>> Before<T, S> {
    /// At a time, before any step.
    pub(super) fn none(t: T) -> Self {
        let zero = S::zeros();
        Self { t, y: zero, coefficients: [zero; 7], is_dense: false }
    }

    /// Takes over where steps begin.
    pub(super) fn begin(&mut self, t: T, y: &S) {
        (self.t, self.y, self.is_dense) = (t, *y, false);
    }
}
