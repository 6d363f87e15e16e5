//! Inertias: those of shapes, [`MassDistribution`], and those of a kinetic energy at a placement, [`InertiaTensor`].
//!
//! Those of shapes are the co-moving quadrupole `J = int rho a a^T dV` about the centre of mass (section 2 of Slawianowski et
//! al.), which `dalembert = j` and `body_inertia = j` take.
//!
//! `J` is not the tensor of rotations, `I = tr(J) 1 - J`: a homogeneous ball has `J = m r^2/5` and `I = 2 m r^2/5`.
//!
//! ```
//! use affine_runtime::inertia::MassDistribution;
//! use affine_runtime::prelude::*;
//!
//! #[affine_model(dim = 3, kinetic(dalembert = j, space_translation = m), potential = orthogonality(1e3) + m*9.81*x[3])]
//! struct Brick { j: Matrix<3>, m: f64 }
//!
//! let brick = MassDistribution::block(2.0, [0.25, 0.12, 0.06]);
//! let brick = Brick { j: brick.quadrupole, m: brick.mass }.prepare()?;
//! # Ok::<(), affine_runtime::Error>(())
//! ```

use core::array::from_fn;

use crate::dual::Dual;
use crate::frames::{Comoving, Matrix, Spatial, Vector};
use crate::model::{Model, Velocity};

/// Mass, centre and quadrupole of a body: what is known of the distribution of its mass by moments up to the second.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassDistribution<const N: usize> {
    /// The mass `m = int rho dV`.
    pub mass: f64,
    /// The centre `c = int rho a dV/m`, which is to be the body point `a = 0`; not a number where `m = 0`.
    pub centre: Vector<N>,
    /// `J = int rho (a - c)(a - c)^T dV`. Positive definite where no mass is negative and the body lies in no plane; in two
    /// dimensions, on no line.
    pub quadrupole: Matrix<N>,
}

impl<const N: usize> MassDistribution<N> {
    /// Particles with masses `m_k` at `a_k`: `m = sum m_k`, `c = sum m_k a_k/m`, `J = sum m_k (a_k - c)(a_k - c)^T`.
    #[must_use]
    pub fn particles(particles: &[(f64, Vector<N>)]) -> Self {
        let mass: f64 = particles.iter().map(|(m, _)| m).sum();
        let moment = particles.iter().fold(Vector::<N>::zeros(), |sum, (m, a)| sum + a * *m);
        let centre = moment / mass;
        let quadrupole = particles.iter().fold(Matrix::<N>::zeros(), |sum, (m, a)| {
            let from_centre = a - centre;
            sum + from_centre * from_centre.transpose() * *m
        });
        Self { mass, centre, quadrupole }
    }

    /// A homogeneous box with these edges along the axes, a rectangle for n = 2: `J = m/12 diag(l_1^2, .., l_n^2)`.
    #[must_use]
    pub fn block(mass: f64, edges: [f64; N]) -> Self {
        Self::along_axes(mass, edges.map(|l| mass / 12.0 * l * l))
    }

    /// A homogeneous ellipsoid with these half axes, an ellipse for n = 2: `J = m/(n + 2) diag(a_1^2, .., a_n^2)`.
    #[must_use]
    pub fn ellipsoid(mass: f64, half_axes: [f64; N]) -> Self {
        Self::along_axes(mass, half_axes.map(|a| mass / (N as f64 + 2.0) * a * a))
    }

    /// About the centre of mass.
    fn centred(mass: f64, quadrupole: Matrix<N>) -> Self {
        Self { mass, centre: Vector::zeros(), quadrupole }
    }

    fn along_axes(mass: f64, moments: [f64; N]) -> Self {
        Self::centred(mass, Matrix::from_diagonal(&moments.into()))
    }
}

impl MassDistribution<3> {
    /// A homogeneous cylinder about the third axis: `J = m diag(r^2/4, r^2/4, h^2/12)`.
    #[must_use]
    pub fn cylinder(mass: f64, radius: f64, height: f64) -> Self {
        let across = mass / 4.0 * radius * radius;
        Self::along_axes(mass, [across, across, mass / 12.0 * height * height])
    }

    /// `J = tr(I)/2 1 - I` of a body in space with the tensor `I = tr(J) 1 - J` of rotations about its centre of mass, as tables
    /// of rigid bodies have it.
    ///
    /// Positive definite where each principal moment of `I` is less than the sum of the others, as those of bodies are that are
    /// not flat; `prepare()` refuses what is not.
    #[must_use]
    pub fn from_rotational(mass: f64, inertia: &Matrix<3>) -> Self {
        Self::centred(mass, Matrix::<3>::identity() * (inertia.trace() / 2.0) - inertia)
    }
}

/// The tensor of a kinetic energy at a placement, `T = tr(X O)/2`, without the centre of mass, and whatever constraint the model
/// has: what takes an affine velocity to an affine spin. Not for `casimir3`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InertiaTensor<const N: usize>(
    /// `K^i_j^k_l` as `K[i][j][k][l]`: `X^i_j = K^i_j^k_l O^l_k`.
    pub [[[[f64; N]; N]; N]; N],
);

impl<const N: usize> InertiaTensor<N> {
    /// Seen from the body at the placement `phi`: `Sigma_hat^A_B = L^A_B^C_D Omega_hat^D_C`.
    ///
    /// Constant for energies that are affine in space, `L` of (4.1) and (4.6); for those that are affine in the body it is `R`
    /// carried there, (4.13).
    pub fn comoving<M: Model<N>>(model: &M, phi: &Matrix<N>) -> Comoving<Self> {
        let placed = phi.map(Dual::fixed);
        Comoving(Self(second_derivatives(model, &placed, |velocity| placed * velocity)))
    }

    /// Seen from space at the placement `phi`: `Sigma^i_j = R^i_j^k_l Omega^l_k`.
    ///
    /// Constant for energies that are affine in the body, `R` of (4.2) and (4.8); for those that are affine in space it is `L`
    /// carried there, (4.12).
    pub fn spatial<M: Model<N>>(model: &M, phi: &Matrix<N>) -> Spatial<Self> {
        let placed = phi.map(Dual::fixed);
        Spatial(Self(second_derivatives(model, &placed, |velocity| velocity * placed)))
    }
}

/// `d^2 T/dO^j_i dO^l_k` of a quadratic `T`: its derivative along one unit velocity, at the other.
fn second_derivatives<const N: usize, M: Model<N>>(
    model: &M,
    phi: &Matrix<N, Dual<f64>>,
    flat: impl Fn(Matrix<N, Dual<f64>>) -> Matrix<N, Dual<f64>>,
) -> [[[[f64; N]; N]; N]; N] {
    let at = |i: usize, j: usize, k: usize, l: usize| {
        let mut affine = Matrix::<N, Dual<f64>>::zeros();
        affine[(l, k)].value = 1.0;
        affine[(j, i)].slope = 1.0;
        let velocity = Velocity { x_dot: Vector::<N, Dual<f64>>::zeros(), phi_dot: flat(affine) };
        model.kinetic_energy(phi, &velocity).slope
    };
    from_fn(|i| from_fn(|j| from_fn(|k| from_fn(|l| at(i, j, k, l)))))
}
