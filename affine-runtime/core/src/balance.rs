//! The balance laws of energies of `phi_dot`, which `emit(balance)` computes (section 3): of d'Alembert's
//!
//! ```text
//! K     = phi J phi_dot^T           dK/dt     = phi_dot J phi_dot^T + N = Omega K + N      (3.6), (3.8)
//! K_hat = phi^-1 K phi^-T           dK_hat/dt = -K_hat J^-1 K_hat + N_hat                  (3.9)
//! k     = m x_dot                   dk/dt     = F                                          (3.3)
//! k_hat = phi^-1 k                  dk_hat/dt = -K_hat^T J^-1 k_hat + F_hat                (3.9)
//! ```
//!
//! Other energies have `K = phi Pi` and `K_hat = Pi phi^-T` of their momentum `Pi`, `inertia = phi_dot Pi + phi dT/dphi` and
//! `inertia_hat = (dT/dphi) phi^-T - K_hat Omega_hat^T`, the slope at fixed velocities taken with the indices of `Pi`.
//!
//! `K` has the components of the affine spin `Sigma`, since every force here is one beside the Lagrangian. Seen from the
//! body it is another tensor: `K_hat = J Omega_hat^T`, whereas `Sigma_hat = K_hat G`. The moment `N = Q` and the force
//! `F = Q_tr` are the sums over potentials, dissipation and forces, `N_hat = phi^-1 N phi^-T`, `F_hat = phi^-1 F`.

use crate::frames::{Comoving, Matrix, Spatial, Vector};

/// The balance of the kinematical spin, `N` by `N` matrices.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Balance<const N: usize> {
    /// `K = phi Pi`, `phi J phi_dot^T` of d'Alembert's energy.
    pub spin: Spatial<Matrix<N>>,
    /// The part of `dK/dt` without forces, `phi_dot J phi_dot^T = Omega K` of d'Alembert's energy.
    pub inertia: Spatial<Matrix<N>>,
    /// `N`, the moment of the forces.
    pub moment: Spatial<Matrix<N>>,
    /// `K_hat = phi^-1 K phi^-T = J Omega_hat^T`; not `Sigma_hat`.
    pub spin_hat: Comoving<Matrix<N>>,
    /// The part of `dK_hat/dt` without forces, `-K_hat J^-1 K_hat` of d'Alembert's energy.
    pub inertia_hat: Comoving<Matrix<N>>,
    /// `N_hat = phi^-1 N phi^-T`.
    pub moment_hat: Comoving<Matrix<N>>,
}

impl<const N: usize> Balance<N> {
    /// `dK/dt = phi_dot J phi_dot^T + N` (3.6).
    #[must_use]
    pub fn rate(&self) -> Spatial<Matrix<N>> {
        Spatial(self.inertia.0 + self.moment.0)
    }

    /// `dK_hat/dt = -K_hat J^-1 K_hat + N_hat` (3.9).
    #[must_use]
    pub fn rate_hat(&self) -> Comoving<Matrix<N>> {
        Comoving(self.inertia_hat.0 + self.moment_hat.0)
    }
}

/// The balance of the momentum of the centre of mass, `N`-vectors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CentreBalance<const N: usize> {
    /// `k = m x_dot`.
    pub momentum: Spatial<Vector<N>>,
    /// `F = dk/dt` (3.3).
    pub force: Spatial<Vector<N>>,
    /// `k_hat = phi^-1 k`.
    pub momentum_hat: Comoving<Vector<N>>,
    /// `-K_hat^T J^-1 k_hat = -Omega_hat k_hat`, the part of `dk_hat/dt` without forces.
    pub inertia_hat: Comoving<Vector<N>>,
    /// `F_hat = phi^-1 F`.
    pub force_hat: Comoving<Vector<N>>,
}

impl<const N: usize> CentreBalance<N> {
    /// `dk_hat/dt = -K_hat^T J^-1 k_hat + F_hat` (3.9).
    #[must_use]
    pub fn rate_hat(&self) -> Comoving<Vector<N>> {
        Comoving(self.inertia_hat.0 + self.force_hat.0)
    }
}
