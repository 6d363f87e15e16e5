//! Deformation tensors, strains, invariants and the inertial quadrupole.

use super::dilatation::LogDeterminant;
use super::momenta::trace_of_power;
use crate::frames::{Comoving, Matrix, Spatial};
use crate::matrix::inverse;
use crate::scalar::Real;

/// Deformation tensor, a metric carried along with the deformation: Green's `G = phi^T phi` in the body, that of space, and
/// Cauchy's `C = phi^-T phi^-1` in space, that of the body.
///
/// `phi -> A phi B` takes `G` to `B^T G B` for an orthogonal `A` and any `B`, and `C` to `A^-T C A^-1` for an orthogonal `B` and
/// any `A`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeformationTensor<const N: usize, T = f64>(pub Matrix<N, T>);

/// Inverse deformation tensor: `G^-1 = phi^-1 phi^-T` in the body, `C^-1 = phi phi^T` in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InverseDeformationTensor<const N: usize, T = f64>(pub Matrix<N, T>);

/// Strain: Lagrange's `E = (G - 1)/2` in the body, Euler's `e = (1 - C)/2` in space.
///
/// With `l` an eigenvalue of `G`, they have the eigenvalues `(l - 1)/2` and `(1 - 1/l)/2`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strain<const N: usize, T = f64>(pub Matrix<N, T>);

/// Inertial quadrupole: `J`, constant, in the body and `J[phi] = phi J phi^T` in space (section 3).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InertialQuadrupole<const N: usize, T = f64>(pub Matrix<N, T>);

impl<const N: usize, T: Real> DeformationTensor<N, T> {
    /// `G = phi^T phi`.
    pub fn green(phi: &Matrix<N, T>) -> Comoving<Self> {
        Comoving(Self(phi.tr_mul(phi)))
    }

    /// `C = phi^-T phi^-1`; not finite where `phi` is singular.
    pub fn cauchy(phi: &Matrix<N, T>) -> Spatial<Self> {
        let inverse = inverse(phi);
        Spatial(Self(inverse.tr_mul(&inverse)))
    }
}

impl<const N: usize, T: Real> InverseDeformationTensor<N, T> {
    /// `G^-1 = phi^-1 phi^-T`; not finite where `phi` is singular.
    pub fn green(phi: &Matrix<N, T>) -> Comoving<Self> {
        let inverse = inverse(phi);
        Comoving(Self(inverse * inverse.transpose()))
    }

    /// `C^-1 = phi phi^T`.
    pub fn cauchy(phi: &Matrix<N, T>) -> Spatial<Self> {
        Spatial(Self(phi * phi.transpose()))
    }
}

impl<const N: usize, T: Real> Comoving<DeformationTensor<N, T>> {
    /// `tr G^k`, the sum of the `2k`-th powers of the stretches.
    pub fn power_trace(&self, k: u32) -> T {
        trace_of_power(&self.0.0, k)
    }
}

impl<const N: usize, T: Real> Spatial<DeformationTensor<N, T>> {
    /// `tr C^k`, the sum of the `-2k`-th powers of the stretches.
    pub fn power_trace(&self, k: u32) -> T {
        trace_of_power(&self.0.0, k)
    }
}

impl<const N: usize, T: Real> Strain<N, T> {
    /// `E = (H + H^T + H^T H)/2` with `H = phi - 1`, so that nothing of size 1 is subtracted.
    ///
    /// Error: a few epsilons times `|H| + |H|^2`. A small strain keeps its digits beside a small `H`; beside a
    /// rotation by a finite angle it has the absolute error of a few epsilons, which the entries of `phi` have.
    pub fn lagrange(phi: &Matrix<N, T>) -> Comoving<Self> {
        let displacement = phi - Matrix::<N, T>::identity();
        let quadratic = displacement.tr_mul(&displacement);
        Comoving(Self(halved(displacement + displacement.transpose() + quadratic)))
    }

    /// `e = (h + h^T - h^T h)/2` with `h = 1 - phi^-1 = phi^-1 (phi - 1)`; not finite where `phi` is singular.
    ///
    /// Error: a few epsilons times `|h| + |h|^2` and the condition number of `phi`.
    pub fn euler(phi: &Matrix<N, T>) -> Spatial<Self> {
        let displacement = inverse(phi) * (phi - Matrix::<N, T>::identity());
        let quadratic = displacement.tr_mul(&displacement);
        Spatial(Self(halved(displacement + displacement.transpose() - quadratic)))
    }
}

fn halved<const N: usize, T: Real>(matrix: Matrix<N, T>) -> Matrix<N, T> {
    matrix * T::from_f64(0.5)
}

impl<const N: usize, T: Real> Comoving<InertialQuadrupole<N, T>> {
    /// `J[phi] = phi J phi^T`.
    pub fn spatial(&self, phi: &Matrix<N, T>) -> Spatial<InertialQuadrupole<N, T>> {
        Spatial(InertialQuadrupole(phi * self.0.0 * phi.transpose()))
    }
}

/// Characteristic invariants `I1..In` of `G`, the elementary symmetric functions of its eigenvalues:
/// `det(G - x) = sum_k (-x)^(n-k) I_k`, `I1 = tr G`, `In = (det phi)^2`.
///
/// `I_k` is computed as the sum of the squared `k` by `k` minors of `phi` (Cauchy-Binet), in which no two terms
/// cancel, not from power traces. Only for `N = 2` and `3`; anything else does not compile.
pub fn characteristic_invariants<const N: usize, T: Real>(phi: &Matrix<N, T>) -> [T; N] {
    const { assert!(N == 2 || N == 3, "characteristic invariants are there for n = 2 and n = 3") };
    let mut invariants = [T::zero(); N];
    invariants[0] = phi.iter().fold(T::zero(), |sum, &entry| sum + entry * entry);
    if N == 3 {
        invariants[1] = sum_of_squared_minors(phi);
    }
    invariants[N - 1] = LogDeterminant::of(phi).squared();
    invariants
}

/// The sum of the squared 2 by 2 minors of a 3 by 3 matrix.
fn sum_of_squared_minors<const N: usize, T: Real>(phi: &Matrix<N, T>) -> T {
    let others = [(1, 2), (2, 0), (0, 1)];
    let mut sum = T::zero();
    for (i, j) in others {
        for (a, b) in others {
            let minor = phi[(i, a)] * phi[(j, b)] - phi[(i, b)] * phi[(j, a)];
            sum += minor * minor;
        }
    }
    sum
}
