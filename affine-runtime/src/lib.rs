//! Phase points, kinematics, integrators and reports for affinely-rigid bodies.
//!
//! An affinely-rigid body has the placement `x, phi` with `phi` in GL+(n), n = 2 or 3: the body point `a` is at
//! `x + phi a`. The attribute `#[affine_model(...)]` turns a kinetic energy into a [`Model`]; a `Simulation` runs
//! it to an end, and a `Flow` steps it in a loop of your own.
//!
//! ```text
//! Omega     = phi_dot phi^-1     Sigma     = phi Pi = (dT/dOmega)^T        spatial
//! Omega_hat = phi^-1 phi_dot     Sigma_hat = Pi phi = (dT/dOmega_hat)^T    co-moving
//!                                Pi        = (dT/dphi_dot)^T               conjugate to phi
//! ```
//!
//! Space and body carry the identity metric, or that of `metrics(...)`, of which a phase point is read in orthonormal bases,
//! [`Model::orthonormal`]; there `^T` is the plain transpose. Spatial, co-moving and two-point
//! quantities, velocities and momenta are different types (see [`frames`] and [`kinematics`]): a formula that
//! mixes them does not compile. Equation numbers are those of Slawianowski et al., *Affine symmetry in mechanics
//! of collective and internal modes, Part I*; where that differs, [`guide::errata`] says so.
#![cfg_attr(not(feature = "std"), no_std)]

#[cfg(feature = "std")]
pub mod counting;
pub mod dual;
pub mod force;
pub mod lattice;
pub mod potential;
mod private;
#[cfg(feature = "report")]
pub mod report;
pub mod sampling;
pub mod signature;
#[cfg(feature = "std")]
pub mod simulate;
pub mod variation;
#[cfg(all(feature = "std", not(feature = "report")))]
mod without_report;

pub use affine_core::{
    balance, conserved, decompose, error, frames, geodesic, kinematics, metrics, model, parametric, scalar,
    state, system,
};
pub use affine_integrators as integrate;
pub use affine_integrators::lanes;

/// What a model has beyond the default, by `emit(...)`, and how code that serves every model finds it.
pub mod capability {
    pub use crate::variation::Tangent;
    pub use affine_core::capability::*;
}

/// What of the other crates is for this one alone.
mod inner {
    pub(crate) use affine_core::__private::numerics::*;
    pub(crate) use affine_integrators::__private::runs::*;
}

/// What emitted code uses besides the public traits. No stable interface: it changes with the macro.
#[doc(hidden)]
pub mod __private {
    pub use crate::private::*;
}

pub use error::{Error, Result};
pub use model::Model;
#[cfg(feature = "std")]
pub use simulate::{Ensemble, Flow, Method, Simulation, Trajectory};

#[cfg(feature = "macros")]
pub use affine_macros::affine_model;

/// What a scene needs.
pub mod prelude {
    pub use crate::frames::{AffineSpin, AffineVelocity, Comoving, Matrix, Spatial, TwoPoint, Vector};
    pub use crate::kinematics::Kinematics;
    pub use crate::model::Model;
    pub use crate::state::Phase;

    #[cfg(feature = "std")]
    pub use crate::simulate::{Ensemble, Event, Flow, Method, Simulation, Trajectory};

    #[cfg(feature = "macros")]
    pub use crate::affine_model;
}

/// Pages to read, one a subject; the README is where to begin.
#[cfg(all(doc, feature = "macros", feature = "std"))]
pub mod guide {
    #[doc = include_str!("../docs/energies.md")]
    pub mod energies {}

    #[doc = include_str!("../docs/errata.md")]
    pub mod errata {}

    #[doc = include_str!("../docs/forces.md")]
    pub mod forces {}

    #[doc = include_str!("../docs/lattice.md")]
    pub mod lattice {}

    #[doc = include_str!("../docs/methods.md")]
    pub mod methods {}

    #[doc = include_str!("../docs/runs.md")]
    pub mod runs {}
}

/// The examples of the README, compiled.
#[cfg(all(doctest, feature = "macros", feature = "std"))]
#[doc = include_str!("../../README.md")]
mod readme {}
