//! Angular and affine momenta, vorticity, the pairing with velocities, Casimirs.

use super::dilatation::deviator;
use super::velocities::LinearVelocity;
use crate::frames::{AffineSpin, AffineVelocity, Comoving, Matrix, Spatial, TwoPoint, Vector};
use crate::scalar::Real;

/// Linear momentum: `p` in space, `p_hat = phi^T p` in the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearMomentum<const N: usize, T = f64>(pub Vector<N, T>);

/// Skew angular momentum in space: the spin `S`, the orbital `x p^T - p x^T`, or their sum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AngularMomentum<const N: usize, T = f64>(pub Matrix<N, T>);

/// Vorticity `Vort = Sigma_hat - Sigma_hat^T` (2.6), skew, in the body. Not the spin in another frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vorticity<const N: usize, T = f64>(pub Matrix<N, T>);

/// Affine momentum about the origin of space: the orbital `Lambda = x p^T`, or the total
/// `I(O) = x p^T + Sigma`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AffineMomentum<const N: usize, T = f64>(pub Matrix<N, T>);

impl<const N: usize, T: Real> Spatial<AffineMomentum<N, T>> {
    /// The angular momentum `I - I^T`.
    pub fn angular_momentum(&self) -> Spatial<AngularMomentum<N, T>> {
        Spatial(AngularMomentum(twice_skew_part(&self.0.0)))
    }
}

impl<const N: usize, T: Real> Spatial<AffineSpin<N, T>> {
    /// Spin `S = Sigma - Sigma^T` (2.6).
    pub fn spin(&self) -> Spatial<AngularMomentum<N, T>> {
        Spatial(AngularMomentum(twice_skew_part(&self.0.0)))
    }
}

impl<const N: usize, T: Real> Comoving<AffineSpin<N, T>> {
    /// Vorticity `Vort = Sigma_hat - Sigma_hat^T` (2.6).
    pub fn vorticity(&self) -> Comoving<Vorticity<N, T>> {
        Comoving(Vorticity(twice_skew_part(&self.0.0)))
    }
}

impl<const N: usize, T: Real> Spatial<AngularMomentum<N, T>> {
    /// `|S|^2 = -tr(S^2)/2`, the sum of the squared entries above the diagonal.
    pub fn norm_squared(&self) -> T {
        sum_of_squares_above_diagonal(&self.0.0)
    }
}

impl<const N: usize, T: Real> Comoving<Vorticity<N, T>> {
    /// `|Vort|^2 = -tr(Vort^2)/2`, the sum of the squared entries above the diagonal.
    pub fn norm_squared(&self) -> T {
        sum_of_squares_above_diagonal(&self.0.0)
    }
}

/// The pairing of momenta with velocities in one frame: the same number in each, `tr(Sigma Omega) =
/// tr(Sigma_hat Omega_hat) = tr(Pi phi_dot)`, without a transpose.
macro_rules! pairing {
    ($frame:ident, $formula:literal) => {
        impl<const N: usize, T: Real> $frame<AffineSpin<N, T>> {
            #[doc = concat!("The pairing `", $formula, "`, the same number in every frame.")]
            pub fn pair(&self, velocity: $frame<AffineVelocity<N, T>>) -> T {
                self.0.0.transpose().dot(&velocity.0.0)
            }
        }
    };
}

pairing!(Spatial, "tr(Sigma Omega)");
pairing!(Comoving, "tr(Sigma_hat Omega_hat)");
pairing!(TwoPoint, "tr(Pi phi_dot)");

impl<const N: usize, T: Real> Comoving<LinearMomentum<N, T>> {
    /// The pairing `p_hat . v_hat = p . x_dot`.
    pub fn pair(&self, velocity: Comoving<LinearVelocity<N, T>>) -> T {
        self.0.0.dot(&velocity.0.0)
    }
}

/// Dilatation, shear and Casimirs exist in space and in the body; `Pi` has no trace.
macro_rules! dilatation_and_shear {
    ($frame:ident) => {
        impl<const N: usize, T: Real> $frame<AffineSpin<N, T>> {
            /// Dilatational momentum `p_dil = tr Sigma = tr Sigma_hat`, conjugate to `q`.
            pub fn dilatational_momentum(&self) -> T {
                self.0.0.trace()
            }
            /// Shear part, the traceless `sigma = Sigma - (p_dil/n) 1` in the same frame.
            #[must_use]
            pub fn deviator(&self) -> Self {
                $frame(AffineSpin(deviator(&self.0.0)))
            }
            /// Casimir `C(k) = tr Sigma^k = tr Sigma_hat^k`.
            pub fn casimir(&self, k: u32) -> T {
                trace_of_power(&self.0.0, k)
            }
        }
    };
}

dilatation_and_shear!(Spatial);
dilatation_and_shear!(Comoving);

/// `tr X^k`.
pub(super) fn trace_of_power<const N: usize, T: Real>(matrix: &Matrix<N, T>, k: u32) -> T {
    (0..k).fold(Matrix::<N, T>::identity(), |power, _| power * matrix).trace()
}

/// `X - X^T`.
fn twice_skew_part<const N: usize, T: Real>(matrix: &Matrix<N, T>) -> Matrix<N, T> {
    matrix - matrix.transpose()
}

fn sum_of_squares_above_diagonal<const N: usize, T: Real>(matrix: &Matrix<N, T>) -> T {
    let mut sum = T::zero();
    for row in 0..N {
        for column in row + 1..N {
            sum += matrix[(row, column)] * matrix[(row, column)];
        }
    }
    sum
}
