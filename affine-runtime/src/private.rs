//! What emitted code uses besides the public traits. No stable interface: it changes with the macro.

use crate::error::Result;
use crate::frames::{Frame, Matrix, Momentum};
use crate::scalar::Real;
use crate::state::{PhasePoint, Translation};

/// The phase point with placement `phi`, a momentum given in any frame, and `centre`.
///
/// # Errors
/// [`Error::Placement`](crate::Error::Placement) unless `phi` is finite and `det phi > 0`;
/// [`Error::NotFinite`](crate::Error::NotFinite) with the name of the momentum, `x` or `p` that is not finite.
pub fn phase_point<const N: usize, F: Frame, C: Translation<N, T>, T: Real>(
    phi: Matrix<N, T>,
    momentum: impl Momentum<N, T>,
    centre: C,
) -> Result<PhasePoint<N, F, C, T>> {
    PhasePoint::checked(phi, momentum, centre)
}
