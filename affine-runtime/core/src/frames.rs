//! Spatial, co-moving and two-point quantities as types.
//!
//! A formula that adds a spatial to a co-moving quantity, or passes a velocity where a momentum belongs, does
//! not compile. Index conventions: `phi[(i, A)]` with the space index first; the canonical momentum
//! `Pi[(A, i)]` is conjugate to `phi[(i, A)]`, so that the pairing is `tr(Pi phi_dot)`.

use crate::matrix::inverse;
pub use crate::matrix::{Matrix, Vector};
use crate::metrics::Bases;
use crate::scalar::Real;

/// A quantity seen from space: `Omega = phi_dot phi^-1`, `Sigma = phi Pi`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spatial<Q>(pub Q);

/// A quantity seen from the body: `Omega_hat = phi^-1 phi_dot`, `Sigma_hat = Pi phi`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comoving<Q>(pub Q);

/// A two-point quantity with one index in space and one in the body: `phi_dot`, `Pi`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoPoint<Q>(pub Q);

/// Affine velocity: `phi_dot phi^-1` in space, `phi^-1 phi_dot` in the body, `phi_dot` between the two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AffineVelocity<const N: usize, T = f64>(pub Matrix<N, T>);

/// Affine spin, the momentum conjugate to the affine velocity: `Sigma = (dT/dOmega)^T` in space,
/// `Sigma_hat = (dT/dOmega_hat)^T` in the body, `Pi = (dT/dphi_dot)^T` between the two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AffineSpin<const N: usize, T = f64>(pub Matrix<N, T>);

/// A frame in which affine spins are stored: [`Space`], [`Body`] or [`Canonical`].
pub trait Frame:
    Copy + core::fmt::Debug + Default + PartialEq + Send + Sync + sealed::Sealed + 'static
{
    /// Name of the momentum in this frame, as in the paper.
    const MOMENTUM: &'static str;

    /// `Sigma` from the affine spin of this frame.
    fn to_space<const N: usize, T: Real>(phi: &Matrix<N, T>, spin: &Matrix<N, T>) -> Matrix<N, T>;
    /// `Sigma_hat` from the affine spin of this frame.
    fn to_body<const N: usize, T: Real>(phi: &Matrix<N, T>, spin: &Matrix<N, T>) -> Matrix<N, T>;
    /// `Pi` from the affine spin of this frame.
    fn to_canonical<const N: usize, T: Real>(phi: &Matrix<N, T>, spin: &Matrix<N, T>) -> Matrix<N, T>;
    /// `Sigma` or `Sigma_hat`, whichever takes no inverse of `phi`. The two are similar matrices: traces of
    /// their powers agree.
    fn to_mixed<const N: usize, T: Real>(phi: &Matrix<N, T>, spin: &Matrix<N, T>) -> Matrix<N, T>;
    /// The affine spin of this frame from that of another.
    fn convert<F: Frame, const N: usize, T: Real>(phi: &Matrix<N, T>, spin: &Matrix<N, T>) -> Matrix<N, T>;
    /// The affine spin of this frame in other bases: `A Sigma A^-1`, `B Sigma_hat B^-1`, `B Pi A^-1`.
    fn rebased<const N: usize, T: Real>(bases: &Bases<N, T>, spin: &Matrix<N, T>) -> Matrix<N, T>;
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::Space {}
    impl Sealed for super::Body {}
    impl Sealed for super::Canonical {}
}

/// Spatial frame: the affine spin is `Sigma = phi Pi`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Space;

/// Co-moving frame: the affine spin is `Sigma_hat = Pi phi`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Body;

/// Neither: the momentum is `Pi` itself, conjugate to `phi`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Canonical;

/// A frame by what its affine spin is in the others, and in other bases.
macro_rules! frame {
    ($frame:ident, $momentum:literal, converted by $convert:ident, |$phi:ident, $spin:ident|
     $($to:ident => $in_frame:expr),+; |$bases:ident| $rebased:expr) => {
        impl Frame for $frame {
            const MOMENTUM: &'static str = $momentum;

            $(#[allow(unused_variables, reason = "in its own frame a spin does not read `phi`")]
            fn $to<const N: usize, T: Real>($phi: &Matrix<N, T>, $spin: &Matrix<N, T>) -> Matrix<N, T> {
                $in_frame
            })+
            fn convert<F: Frame, const N: usize, T: Real>(
                $phi: &Matrix<N, T>,
                $spin: &Matrix<N, T>,
            ) -> Matrix<N, T> {
                F::$convert($phi, $spin)
            }
            fn rebased<const N: usize, T: Real>(
                $bases: &Bases<N, T>,
                $spin: &Matrix<N, T>,
            ) -> Matrix<N, T> {
                $rebased
            }
        }
    };
}

frame!(Space, "Sigma", converted by to_space, |phi, spin|
    to_space => *spin,
    to_body => inverse(phi) * spin * phi,
    to_canonical => inverse(phi) * spin,
    to_mixed => *spin;
    |bases| bases.space * spin * bases.space_inverse);
frame!(Body, "Sigma_hat", converted by to_body, |phi, spin|
    to_space => phi * spin * inverse(phi),
    to_body => *spin,
    to_canonical => spin * inverse(phi),
    to_mixed => *spin;
    |bases| bases.body * spin * bases.body_inverse);
frame!(Canonical, "Pi", converted by to_canonical, |phi, spin|
    to_space => phi * spin,
    to_body => spin * phi,
    to_canonical => *spin,
    to_mixed => spin * phi;
    |bases| bases.body * spin * bases.space_inverse);

/// A momentum given in some frame: what `at_momentum` accepts.
///
/// `Spatial(sigma)`, `Comoving(sigma_hat)` and `TwoPoint(pi)`, of a bare matrix or of an [`AffineSpin`]; an
/// [`AffineVelocity`] is no momentum and does not compile here.
#[diagnostic::on_unimplemented(
    message = "this is no affine spin in a frame, of a body in dimension {N}",
    label = "no frame, or no momentum",
    note = "write `Spatial(sigma)` for Sigma = phi Pi, `Comoving(sigma_hat)` for Sigma_hat = Pi phi, `TwoPoint(pi)` for Pi, \
            of matrices of that dimension; velocities go to `at_velocity`"
)]
pub trait Momentum<const N: usize, T: Real> {
    /// The frame the matrix is written in.
    type Frame: Frame;
    /// The matrix.
    fn matrix(self) -> Matrix<N, T>;
}

macro_rules! momentum {
    ($wrapper:ident, $frame:ident) => {
        impl<const N: usize, T: Real> Momentum<N, T> for $wrapper<Matrix<N, T>> {
            type Frame = $frame;
            fn matrix(self) -> Matrix<N, T> {
                self.0
            }
        }
        impl<const N: usize, T: Real> Momentum<N, T> for $wrapper<AffineSpin<N, T>> {
            type Frame = $frame;
            fn matrix(self) -> Matrix<N, T> {
                self.0.0
            }
        }
    };
}

momentum!(Spatial, Space);
momentum!(Comoving, Body);
momentum!(TwoPoint, Canonical);
