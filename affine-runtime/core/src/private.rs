//! What emitted code uses besides the public traits. No stable interface: it changes with the macro.

pub use core::primitive::{f64, usize};

pub use crate::balance::{Balance, CentreBalance};
pub use crate::breathing::Breathing;
pub use crate::capability::{Emitted, InLanes, PackedEquations, SecondOrderEquations, Splitting, Taylor};
pub use crate::coefficients::{bases_beside, beside_bases, joined, square, table};
pub use crate::confined::{confined_point, in_the_algebra, on_the_group, projected};
pub use crate::custom::{
    as_force, as_potential, comoving_force, comoving_force_in, components, matrix, potential_energy,
    potential_energy_in, potential_slopes, potential_slopes_in, rows, spatial_force, spatial_force_in,
    translational_force, translational_force_in,
};
pub use crate::decompose::{
    dilatation, inverse, isochoric_part, log_stretches, mean_log_stretch, principal_log_stretches,
    principal_stretches, skew_exponential,
};
pub use crate::dissipation::{semidefinite, semidefinite_form};
pub use crate::divisor::{Divisor, over};
pub use crate::error::Result;
pub use crate::force;
pub use crate::frames::{Body, Canonical, Comoving, Matrix, Momentum, Space, Spatial, TwoPoint, Vector};
pub use crate::geodesic::{Geodesic, Orbit};
pub use crate::kinematics::dilatation::far_from_undeformed;
pub use crate::lanes::{Lanes, gathered, in_lane, set_entries};
pub use crate::matrix_field::symmetric_part;
pub use crate::metrics::forms::{rebased_inertia, rebased_tensor, told_in_given_bases};
pub use crate::metrics::quantities::{form_in_given_bases, inverse_in_given_bases};
pub use crate::metrics::{Bases, orthonormal};
pub use crate::model::{
    Bound, Component, Conserved, Constraint, Description, Entry, Formula, Group, Guard, Handle, Model,
    Operations, Quantity, Regularity, Scope, Velocity,
};
pub use crate::packed::{Four, Packed};
pub use crate::parametric::{Field, Fields, Parametric};
pub use crate::parts::{Given, OfCentre};
pub use crate::reduction::{
    Condition, finite, finite_fields, from_shear_and_turn, inverse_form, principal_axes, shear_and_turn,
    total_affine_momentum, total_size, turn, well_posed,
};
pub use crate::regularity::regular;
pub use crate::scalar::{Real, Scalar};
pub use crate::state::{Centre, Phase, PhasePoint, Pinned};
pub use crate::system::{Packing, Pieces, SecondOrder, Series, Unconstrained};
pub use crate::unprepared::{IsPrepared, NotPrepared, Unprepared, VelocityDeterminesMomentum};
pub use crate::vectors::Vectors;

use crate::frames::Frame;
use crate::parts::{Basis, Translation};

/// The phase point with placement `phi`, a momentum given in any frame, and `centre`.
///
/// # Errors
/// [`Error::Placement`](crate::Error::Placement) unless `phi` is finite and `det phi > 0`;
/// [`Error::NotFinite`](crate::Error::NotFinite) with the name of the momentum, `x` or `p` that is not finite.
pub fn phase_point<const N: usize, F: Frame, C: Translation<N, T>, T: Real, B: Basis>(
    phi: Matrix<N, T>,
    momentum: impl Momentum<N, T>,
    centre: C,
) -> Result<PhasePoint<N, F, C, T, B>> {
    PhasePoint::checked(phi, momentum, centre)
}

/// The same point, unchecked: integrators watch over their states themselves.
pub fn point<const N: usize, F: Frame, C: Translation<N, T>, T: Real, B: Basis>(
    phi: Matrix<N, T>,
    momentum: impl Momentum<N, T>,
    centre: C,
) -> PhasePoint<N, F, C, T, B> {
    PhasePoint::with_momentum(phi, momentum, centre)
}

/// Stops the compilation of a call of `kinetic_energy`.
///
/// ```compile_fail,E0080
/// use affine_runtime::model::Velocity;
/// use affine_runtime::prelude::*;
///
/// #[affine_model(dim = 3, hamiltonian(casimir2 = 1, casimir3 = 0.1))]
/// struct Cubic;
///
/// let velocity = Velocity { x_dot: Vector::<3>::zeros(), phi_dot: Matrix::<3>::identity() };
/// let _ = Cubic.kinetic_energy(&Matrix::<3>::identity(), &velocity);
/// ```
///
/// # Panics
/// Always, and only while the compiler evaluates it.
#[allow(clippy::panic, reason = "evaluated by the compiler alone: the panic is the error message")]
pub const fn no_kinetic_energy_of_velocities<T>() -> T {
    panic!(
        "with `casimir3` several momenta have one velocity, and T is no function of velocities; on momenta it is tr(X O) - H"
    )
}

/// The vector with the given components.
pub fn vector<const N: usize, T: Real>(components: [T; N]) -> Vector<N, T> {
    Vector::from(components)
}

/// What the integrators, and what stands on them, use besides the public traits.
pub mod numerics {
    pub use crate::decompose::exponential::{LN2_HIGH, LN2_LOW, SERIES};
    pub use crate::divisor::{Divisor, HIGHEST_ORDER, LOWEST_ORDER};
    pub use crate::elliptic::{carlson_rf, duplicated};
    pub use crate::error::time::Time;
    #[cfg(feature = "serde")]
    pub use crate::interned::{constant, number, optional_word, word};
    pub use crate::kinematics::dilatation::LogDeterminant;
    pub use crate::norm::{IN_RANGE, larger, norm, scaled_norm, square, sum_of_squares};
    pub use crate::reduction::jacobi;
    pub use crate::scalar::inverse_cbrt::of_regular;
    pub use crate::system::{NotEmitted, is_emitted, of_lane, set_lane};
    pub use crate::vectors::{IS_FUSED, Portable, Vectors};
}
