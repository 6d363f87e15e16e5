//! What emitted code uses besides the public traits. No stable interface: it changes with the macro.

use crate::error::Result;
use crate::frames::{Frame, Matrix, Momentum};
use crate::model::{Description, Formula, Operations};
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

/// The phase point with placement `phi`, affine spin `spin` in the frame `F`, and `centre`, unchecked: for states
/// on the way, which are checked when they are recorded.
pub fn unchecked_point<const N: usize, F: Frame, C: Translation<N, T>, T: Real>(
    phi: Matrix<N, T>,
    spin: Matrix<N, T>,
    centre: C,
) -> PhasePoint<N, F, C, T> {
    PhasePoint::new(phi, spin, centre)
}

/// The affine spin of a phase point in the frame it is stored in.
pub fn stored_spin<const N: usize, F: Frame, C: Translation<N, T>, T: Real>(
    point: &PhasePoint<N, F, C, T>,
) -> &Matrix<N, T> {
    point.spin()
}

/// A description with a name and nothing else: other crates cannot write the struct out, but can fill in fields.
#[must_use]
pub const fn description(name: &'static str) -> Description {
    const NO_FORMULA: Formula = Formula { text: "", latex: "" };
    const NO_OPERATIONS: Operations = Operations { mul: 0, add: 0, div: 0, sqrt: 0, exp: 0, ln: 0 };
    Description {
        name,
        kinetic_energy: NO_FORMULA,
        hamiltonian: NO_FORMULA,
        equations: &[],
        reduced_equations: &[],
        signature: None,
        conserved: &[],
        conserved_at_rest: &[],
        full: &[],
        reduced: &[],
        full_operations: NO_OPERATIONS,
        reduced_operations: NO_OPERATIONS,
        left_out: &[],
    }
}
