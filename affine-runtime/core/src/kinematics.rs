//! Kinematic quantities of a phase point (Slawianowski et al., section 2).
//!
//! [`Kinematics`] adds them to every [`Phase`]; the quantities themselves are types that remember what they are
//! and where they live:
//!
//! | seen from space | seen from the body | between the two |
//! |---|---|---|
//! | `Spatial<AffineVelocity>` `Omega` | `Comoving<AffineVelocity>` `Omega_hat` | `TwoPoint<AffineVelocity>` `phi_dot` |
//! | `Spatial<AffineSpin>` `Sigma` | `Comoving<AffineSpin>` `Sigma_hat` | `TwoPoint<AffineSpin>` `Pi` |
//! | `Spatial<DeformationTensor>` `C` | `Comoving<DeformationTensor>` `G` | |
//! | `Spatial<InverseDeformationTensor>` `C^-1` | `Comoving<InverseDeformationTensor>` `G^-1` | |
//! | `Spatial<Strain>` `e` | `Comoving<Strain>` `E` | |
//! | `Spatial<AngularMomentum>` `S`, `x p^T - p x^T` | `Comoving<Vorticity>` `Vort` | |
//! | `Spatial<AffineMomentum>` `x p^T`, `I(O)` | | |
//!
//! Quantities that need the metrics of space and body, in the second half of the table and all stretches, are read off points
//! in orthonormal bases alone, [`Euclidean`]: those of every model without `metrics(...)`. A model with metrics gives them,
//! [`Model::orthonormal`](crate::model::Model::orthonormal).
//!
//! Spin and vorticity have different types because one is not the other in another frame: `S` differs from
//! `phi Vort phi^-1`. Like quantities add; everything else does not compile:
//!
//! ```
//! use affine_runtime::kinematics::Kinematics;
//! use affine_runtime::model::Velocity;
//! use affine_runtime::state::{Euclidean, Phase};
//!
//! fn internal_power(point: &impl Phase<3>, velocity: &Velocity<3>) -> f64 {
//!     point.sigma().pair(point.omega(velocity))
//! }
//! fn total_angular_momentum(point: &(impl Phase<3> + Euclidean)) -> f64 {
//!     (point.orbital_angular_momentum() + point.spin()).norm_squared()
//! }
//! ```
//!
//! A spatial momentum is not paired with a co-moving velocity:
//!
//! ```compile_fail,E0308
//! use affine_runtime::kinematics::Kinematics;
//! use affine_runtime::model::Velocity;
//! use affine_runtime::state::Phase;
//!
//! fn internal_power(point: &impl Phase<3>, velocity: &Velocity<3>) -> f64 {
//!     point.sigma().pair(point.omega_hat(velocity))
//! }
//! ```
//!
//! The vorticity is not added to a spatial angular momentum:
//!
//! ```compile_fail,E0308
//! use affine_runtime::kinematics::Kinematics;
//! use affine_runtime::state::{Euclidean, Phase};
//!
//! fn total_angular_momentum(point: &(impl Phase<3> + Euclidean)) -> f64 {
//!     (point.orbital_angular_momentum() + point.vorticity()).norm_squared()
//! }
//! ```
//!
//! An affine velocity is not a momentum, nor is the total affine momentum an affine spin:
//!
//! ```
//! # use affine_runtime::{frames::Momentum, kinematics::Kinematics, model::Velocity, state::Phase};
//! fn start(_momentum: impl Momentum<3, f64>) {}
//! fn restart(point: &impl Phase<3>, velocity: &Velocity<3>) {
//!     start(point.sigma());
//! }
//! ```
//!
//! ```compile_fail,E0277
//! # use affine_runtime::{frames::Momentum, kinematics::Kinematics, model::Velocity, state::Phase};
//! # fn start(_momentum: impl Momentum<3, f64>) {}
//! fn restart(point: &impl Phase<3>, velocity: &Velocity<3>) {
//!     start(point.omega(velocity));
//! }
//! ```
//!
//! ```compile_fail,E0277
//! # use affine_runtime::{frames::Momentum, kinematics::Kinematics, model::Velocity, state::Phase};
//! # fn start(_momentum: impl Momentum<3, f64>) {}
//! fn restart(point: &impl Phase<3>, velocity: &Velocity<3>) {
//!     start(point.total_affine_momentum());
//! }
//! ```

pub(crate) mod deformation;
pub(crate) mod dilatation;
mod momenta;
mod sums;
mod velocities;

use deformation::characteristic_invariants;
pub use deformation::{DeformationTensor, InertialQuadrupole, InverseDeformationTensor, Strain};
pub(crate) use dilatation::{LogDeterminant, integer};
use dilatation::{dilatation, isochoric_part, mean_log_stretch};
pub use momenta::{AffineMomentum, AngularMomentum, LinearMomentum, Vorticity};
pub use velocities::LinearVelocity;

use crate::frames::{AffineVelocity, Comoving, Matrix, Spatial, TwoPoint};
use crate::model::Velocity;
use crate::scalar::Real;
use crate::state::{Euclidean, Phase};

/// Everything that section 2 of the paper reads off a phase point, and off a phase point and a velocity.
pub trait Kinematics<const N: usize, T: Real = f64>: Phase<N, T> {
    /// Spatial affine velocity `Omega = phi_dot phi^-1`.
    fn omega(&self, velocity: &Velocity<N, T>) -> Spatial<AffineVelocity<N, T>> {
        TwoPoint(AffineVelocity(velocity.phi_dot)).spatial(self.phi())
    }
    /// Co-moving affine velocity `Omega_hat = phi^-1 phi_dot`.
    fn omega_hat(&self, velocity: &Velocity<N, T>) -> Comoving<AffineVelocity<N, T>> {
        TwoPoint(AffineVelocity(velocity.phi_dot)).comoving(self.phi())
    }
    /// Co-moving translational velocity `v_hat = phi^-1 x_dot`.
    fn v_hat(&self, velocity: &Velocity<N, T>) -> Comoving<LinearVelocity<N, T>> {
        Spatial(LinearVelocity(velocity.x_dot)).comoving(self.phi())
    }

    /// Green deformation tensor `G = phi^T phi`.
    fn green(&self) -> Comoving<DeformationTensor<N, T>>
    where
        Self: Euclidean,
    {
        DeformationTensor::green(self.phi())
    }
    /// Inverse Green deformation tensor `G^-1 = phi^-1 phi^-T`.
    fn green_inverse(&self) -> Comoving<InverseDeformationTensor<N, T>>
    where
        Self: Euclidean,
    {
        InverseDeformationTensor::green(self.phi())
    }
    /// Cauchy deformation tensor `C = phi^-T phi^-1`.
    fn cauchy(&self) -> Spatial<DeformationTensor<N, T>>
    where
        Self: Euclidean,
    {
        DeformationTensor::cauchy(self.phi())
    }
    /// Inverse Cauchy deformation tensor `C^-1 = phi phi^T`.
    fn cauchy_inverse(&self) -> Spatial<InverseDeformationTensor<N, T>>
    where
        Self: Euclidean,
    {
        InverseDeformationTensor::cauchy(self.phi())
    }
    /// Lagrange (Green) strain `E = (G - 1)/2`.
    fn lagrange_strain(&self) -> Comoving<Strain<N, T>>
    where
        Self: Euclidean,
    {
        Strain::lagrange(self.phi())
    }
    /// Euler (Cauchy) strain `e = (1 - C)/2`.
    fn euler_strain(&self) -> Spatial<Strain<N, T>>
    where
        Self: Euclidean,
    {
        Strain::euler(self.phi())
    }
    /// Characteristic invariants `I1..In` of `G`; see [`characteristic_invariants`].
    fn invariants(&self) -> [T; N]
    where
        Self: Euclidean,
    {
        characteristic_invariants(self.phi())
    }
    /// Mean log-stretch `q = ln(det phi)/n`; see [`mean_log_stretch`].
    fn mean_log_stretch(&self) -> T
    where
        Self: Euclidean,
    {
        mean_log_stretch(self.phi())
    }
    /// Dilatation `D = exp(q)`; see [`dilatation`](crate::decompose::dilatation).
    fn dilatation(&self) -> T
    where
        Self: Euclidean,
    {
        dilatation(self.phi())
    }
    /// Isochoric part `Psi = exp(-q) phi`; see [`isochoric_part`].
    fn isochoric_part(&self) -> Matrix<N, T>
    where
        Self: Euclidean,
    {
        isochoric_part(self.phi())
    }
    /// Spatial inertial quadrupole `J[phi] = phi J phi^T` of a body with the co-moving quadrupole `J`.
    fn inertial_quadrupole(
        &self,
        body: Comoving<InertialQuadrupole<N, T>>,
    ) -> Spatial<InertialQuadrupole<N, T>> {
        body.spatial(self.phi())
    }

    /// Spin `S = Sigma - Sigma^T` (2.6).
    fn spin(&self) -> Spatial<AngularMomentum<N, T>>
    where
        Self: Euclidean,
    {
        self.sigma().spin()
    }
    /// Vorticity `Vort = Sigma_hat - Sigma_hat^T` (2.6).
    fn vorticity(&self) -> Comoving<Vorticity<N, T>>
    where
        Self: Euclidean,
    {
        self.sigma_hat().vorticity()
    }
    /// Orbital affine momentum `Lambda = x p^T` about the origin of space; zero for a pinned body.
    fn orbital_affine_momentum(&self) -> Spatial<AffineMomentum<N, T>> {
        Spatial(AffineMomentum(self.x() * self.p().transpose()))
    }
    /// Total affine momentum `I(O) = x p^T + Sigma` about the origin of space.
    fn total_affine_momentum(&self) -> Spatial<AffineMomentum<N, T>> {
        self.orbital_affine_momentum() + Spatial(AffineMomentum(self.sigma().0.0))
    }
    /// Orbital angular momentum `x p^T - p x^T` about the origin of space; zero for a pinned body.
    fn orbital_angular_momentum(&self) -> Spatial<AngularMomentum<N, T>>
    where
        Self: Euclidean,
    {
        self.orbital_affine_momentum().angular_momentum()
    }
    /// Total angular momentum `I(O) - I(O)^T = x p^T - p x^T + S` about the origin of space.
    fn total_angular_momentum(&self) -> Spatial<AngularMomentum<N, T>>
    where
        Self: Euclidean,
    {
        self.orbital_angular_momentum() + self.spin()
    }
    /// Dilatational momentum `p_dil = tr Sigma = tr Sigma_hat`, conjugate to `q`; the Casimir `C(1)`.
    fn dilatational_momentum(&self) -> T {
        self.casimir(1)
    }
    /// Casimir `C(k) = tr Sigma^k = tr Sigma_hat^k`. Independent for `k = 1..n`.
    fn casimir(&self, k: u32) -> T {
        momenta::trace_of_power(&self.mixed_spin(), k)
    }
    /// Casimir `tr sigma^k` of the shear part `sigma = Sigma - (p_dil/n) 1`. Independent for `k = 2..n`.
    fn shear_casimir(&self, k: u32) -> T {
        momenta::trace_of_power(&dilatation::deviator(&self.mixed_spin()), k)
    }
}

impl<const N: usize, T: Real, P: Phase<N, T>> Kinematics<N, T> for P {}
