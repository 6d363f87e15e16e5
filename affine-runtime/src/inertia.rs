//! Inertias: those of shapes, and the tensors of a kinetic energy at a placement.
//!
//! Those of shapes are the co-moving quadrupole `J = int rho a a^T dV` about the centre of mass (section 2 of Slawianowski et
//! al.), which `dalembert = j` and `body_inertia = j` take.
//!
//! `J` is not the tensor of rotations, `I = tr(J) 1 - J`: a homogeneous ball has `J = m r^2/5` and `I = 2 m r^2/5`.
//!
//! ```
//! use affine_runtime::inertia;
//! use affine_runtime::prelude::*;
//!
//! #[affine_model(dim = 3, kinetic(dalembert = j, space_translation = m), potential = orthogonality(1e3) + m*9.81*x[3])]
//! struct Brick { j: Matrix<3>, m: f64 }
//!
//! let m = 2.0;
//! let brick = Brick { j: inertia::block(m, [0.25, 0.12, 0.06]), m }.prepare()?;
//! # Ok::<(), affine_runtime::Error>(())
//! ```

use core::array::from_fn;

use crate::dual::Dual;
use crate::frames::{Comoving, Matrix, Spatial, Vector};
use crate::model::{Model, Velocity};

/// `K^i_j^k_l` as `K[i][j][k][l]`: what takes an affine velocity to an affine spin, `X^i_j = K^i_j^k_l O^l_k`.
type Tensor<const N: usize> = [[[[f64; N]; N]; N]; N];

/// Particles as a body sees them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Particles<const N: usize> {
    /// Their mass `m = sum m_k`.
    pub mass: f64,
    /// Their centre `c = sum m_k a_k/m`, which is to be the body point `a = 0`; not a number where `m = 0`.
    pub centre: Vector<N>,
    /// `J = sum m_k (a_k - c)(a_k - c)^T`. Positive definite where the masses are positive and the points lie in no plane; in
    /// two dimensions, on no line.
    pub quadrupole: Matrix<N>,
}

/// Mass, centre and quadrupole of particles with masses `m_k` at `a_k`.
pub fn particles<const N: usize>(particles: &[(f64, Vector<N>)]) -> Particles<N> {
    let mass: f64 = particles.iter().map(|(m, _)| m).sum();
    let moment = particles.iter().fold(Vector::<N>::zeros(), |sum, (m, a)| sum + a * *m);
    let centre = moment / mass;
    let quadrupole = particles.iter().fold(Matrix::<N>::zeros(), |sum, (m, a)| {
        let from_centre = a - centre;
        sum + from_centre * from_centre.transpose() * *m
    });
    Particles { mass, centre, quadrupole }
}

/// A homogeneous box with these edges along the axes, a rectangle for n = 2: `J = m/12 diag(l_1^2, .., l_n^2)`.
pub fn block<const N: usize>(mass: f64, edges: [f64; N]) -> Matrix<N> {
    diagonal(edges.map(|l| mass / 12.0 * l * l))
}

/// A homogeneous ellipsoid with these half axes, an ellipse for n = 2: `J = m/(n + 2) diag(a_1^2, .., a_n^2)`.
pub fn ellipsoid<const N: usize>(mass: f64, half_axes: [f64; N]) -> Matrix<N> {
    diagonal(half_axes.map(|a| mass / (N as f64 + 2.0) * a * a))
}

/// A homogeneous cylinder about the third axis: `J = m diag(r^2/4, r^2/4, h^2/12)`.
pub fn cylinder(mass: f64, radius: f64, height: f64) -> Matrix<3> {
    let across = mass / 4.0 * radius * radius;
    diagonal([across, across, mass / 12.0 * height * height])
}

/// `J = tr(I)/2 1 - I` of a body in space with the tensor `I = tr(J) 1 - J` of rotations, as tables of rigid bodies have it.
///
/// Positive definite where each principal moment of `I` is less than the sum of the others, as those of bodies are that are
/// not flat; `prepare()` refuses what is not.
pub fn from_rotational(inertia: &Matrix<3>) -> Matrix<3> {
    Matrix::<3>::identity() * (inertia.trace() / 2.0) - inertia
}

/// The tensor of a kinetic energy seen from the body at the placement `phi`: `Sigma_hat^A_B = L^A_B^C_D Omega_hat^D_C`, as
/// `L[A][B][C][D]`.
///
/// Constant for energies that are affine in space, `L` of (4.1) and (4.6); for those that are affine in the body it is `R` carried
/// there, (4.13). Without the centre of mass, and whatever constraint the model has. Not for `casimir3`.
pub fn comoving_tensor<const N: usize, M: Model<N>>(
    model: &M,
    phi: &Matrix<N>,
) -> Comoving<[[[[f64; N]; N]; N]; N]> {
    let placed = phi.map(Dual::fixed);
    Comoving(second_derivatives(model, &placed, |velocity| placed * velocity))
}

/// The tensor of a kinetic energy seen from space at the placement `phi`: `Sigma^i_j = R^i_j^k_l Omega^l_k`, as
/// `R[i][j][k][l]`.
///
/// Constant for energies that are affine in the body, `R` of (4.2) and (4.8); for those that are affine in space it is `L` carried
/// there, (4.12). Without the centre of mass, and whatever constraint the model has. Not for `casimir3`.
pub fn spatial_tensor<const N: usize, M: Model<N>>(
    model: &M,
    phi: &Matrix<N>,
) -> Spatial<[[[[f64; N]; N]; N]; N]> {
    let placed = phi.map(Dual::fixed);
    Spatial(second_derivatives(model, &placed, |velocity| velocity * placed))
}

/// `d^2 T/dO^j_i dO^l_k` of a quadratic `T`: its derivative along one unit velocity, at the other.
fn second_derivatives<const N: usize, M: Model<N>>(
    model: &M,
    phi: &Matrix<N, Dual<f64>>,
    flat: impl Fn(Matrix<N, Dual<f64>>) -> Matrix<N, Dual<f64>>,
) -> Tensor<N> {
    let at = |i: usize, j: usize, k: usize, l: usize| {
        let mut affine = Matrix::<N, Dual<f64>>::zeros();
        affine[(l, k)].value = 1.0;
        affine[(j, i)].slope = 1.0;
        let velocity = Velocity { x_dot: Vector::<N, Dual<f64>>::zeros(), phi_dot: flat(affine) };
        model.kinetic_energy(phi, &velocity).slope
    };
    from_fn(|i| from_fn(|j| from_fn(|k| from_fn(|l| at(i, j, k, l)))))
}

fn diagonal<const N: usize>(entries: [f64; N]) -> Matrix<N> {
    Matrix::from_diagonal(&entries.into())
}
