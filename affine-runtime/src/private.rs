//! What emitted code uses besides the public traits. No stable interface: it changes with the macro.

pub use affine_core::__private::*;
pub use affine_integrators::__private::*;

pub use crate::dual::Dual;
pub use crate::elliptic::ellipsoid::{ellipsoidal, ellipsoidal_slopes};
pub use crate::lattice::conversion::{LatticeFrame, far_on_axes};
pub use crate::lattice::pieces::{rotation, turned};
pub use crate::lattice::{
    Isotropic, Lattice, LatticeDescription, LatticeForm, LatticePieces, MetricSide, PotentialClass,
    RatioForm, TwoPolarForm, Variables,
};
pub use crate::variation::Tangent;

/// The lattice of a placement and its affine spin in the frame `F`, with labels and frames nearest to those before.
///
/// # Errors
/// [`Error::Placement`](crate::Error::Placement) where the stretches cannot be told from zero.
pub fn lattice_of<const N: usize, F: LatticeFrame>(
    phi: &Matrix<N>,
    spin: &Matrix<N>,
    before: Option<&Lattice<N>>,
) -> Result<Lattice<N>> {
    crate::lattice::lattice_of::<N, F>(phi, spin, before)
}

/// The placement of a lattice and its affine spin in the frame `F`.
///
/// # Errors
/// [`Error::CoincidentStretches`](crate::Error::CoincidentStretches) where two stretches are equal.
pub fn placement_and_spin<const N: usize, F: LatticeFrame>(
    lattice: &Lattice<N>,
) -> Result<(Matrix<N>, Matrix<N>)> {
    crate::lattice::placement_and_spin::<N, F>(lattice)
}
