//! Phase points: placement and momentum, with the centre of mass only where a model has one.

#[cfg(feature = "approx")]
mod approx;
#[cfg(feature = "serde")]
pub(crate) mod serde;
#[cfg(feature = "std")]
mod transforms;

use core::fmt::Debug;

use crate::error::{Error, Result};
use crate::frames::{AffineSpin, Comoving, Frame, Matrix, Momentum, Spatial, TwoPoint, Vector};
use crate::kinematics::{LinearMomentum, LogDeterminant};
use crate::metrics::Bases;
use crate::parts::{Basis, Translation};
use crate::scalar::Real;

pub use crate::parts::Orthonormal;

/// No translation: the model has neither `x` nor `p`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pinned;

impl<const N: usize, T: Real> Translation<N, T> for Pinned {
    fn replaced(&self, _x: Vector<N, T>, _p: Vector<N, T>) -> Self {
        *self
    }
    fn position(&self) -> Vector<N, T> {
        Vector::<N, T>::zeros()
    }
    fn momentum(&self) -> Vector<N, T> {
        Vector::<N, T>::zeros()
    }
    fn rebased(&self, _bases: &Bases<N, T>) -> Self {
        *self
    }
}

/// Centre of mass and its conjugate momentum, both in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Centre<const N: usize, T = f64> {
    /// Position `x`.
    pub x: Vector<N, T>,
    /// Linear momentum `p = dT/dx_dot`.
    pub p: Vector<N, T>,
}

impl<const N: usize, T: Real> Translation<N, T> for Centre<N, T> {
    fn replaced(&self, x: Vector<N, T>, p: Vector<N, T>) -> Self {
        Self { x, p }
    }
    fn position(&self) -> Vector<N, T> {
        self.x
    }
    fn momentum(&self) -> Vector<N, T> {
        self.p
    }
    fn rebased(&self, bases: &Bases<N, T>) -> Self {
        Self { x: bases.space * self.x, p: bases.space_inverse.tr_mul(&self.p) }
    }
}

/// A phase point in orthonormal bases: what the deformation tensors, the spin and the stretches are read off.
#[diagnostic::on_unimplemented(
    message = "the metrics of this model are not the identity in the bases of its phase points",
    label = "deformation tensors, stretches, spin and vorticity need the metrics",
    note = "ask the model for the point in orthonormal bases: `model.orthonormal(&point)`; `model.components(quantity)` gives \
            the components of what is read off it in the bases of the model"
)]
pub trait Euclidean {}

impl<const N: usize, F, C, T: Real> Euclidean for PhasePoint<N, F, C, T, Orthonormal> {}

/// A point of phase space: placement `phi` with `det phi > 0`, affine spin in the frame `F` of the model, and
/// the centre of mass where the model has one; components belong to the bases `B`, those of a model without
/// `metrics(...)` are [`Orthonormal`].
///
/// Points are made by the models (`at_momentum`, `at_velocity`), which check them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhasePoint<const N: usize, F, C, T: Real = f64, B = Orthonormal> {
    phi: Matrix<N, T>,
    spin: Matrix<N, T>,
    centre: C,
    frame: core::marker::PhantomData<(F, B)>,
}

/// What integrators and reports read of a phase point, whatever the model.
pub trait Phase<const N: usize, T: Real = f64>: Copy + Debug + PartialEq {
    /// Placement `phi`.
    fn phi(&self) -> &Matrix<N, T>;
    /// Position `x` of the centre of mass; zero for a pinned body.
    fn x(&self) -> Vector<N, T>;
    /// Linear momentum `p`, spatial; zero for a pinned body.
    fn p(&self) -> Vector<N, T>;
    /// Co-moving linear momentum `p_hat = phi^T p`; zero for a pinned body.
    fn p_hat(&self) -> Comoving<LinearMomentum<N, T>> {
        Comoving(LinearMomentum(self.phi().tr_mul(&self.p())))
    }
    /// Spatial affine spin `Sigma = phi Pi`.
    fn sigma(&self) -> Spatial<AffineSpin<N, T>>;
    /// Co-moving affine spin `Sigma_hat = Pi phi`.
    fn sigma_hat(&self) -> Comoving<AffineSpin<N, T>>;
    /// Canonical momentum `Pi`.
    fn pi(&self) -> TwoPoint<AffineSpin<N, T>>;
    /// `Sigma` or `Sigma_hat`, whichever the point gives without an inverse of `phi`: for what depends on the
    /// conjugacy class alone, such as Casimirs, which then carry no rounding of a conversion.
    fn mixed_spin(&self) -> Matrix<N, T>;
    /// The point at another placement and position, with `p` kept and the affine spin of the model's own frame
    /// mapped.
    #[must_use]
    fn moved(
        &self,
        x: Vector<N, T>,
        phi: Matrix<N, T>,
        spin: impl FnOnce(&Matrix<N, T>) -> Matrix<N, T>,
    ) -> Self;
    /// The type of phase points of the same model in orthonormal bases; the same type where these are the model's own.
    type InOrthonormal: Phase<N, T, InOrthonormal = Self::InOrthonormal> + Euclidean;
    /// The point in orthonormal bases, to which `bases` lead; `None` where the model's own are orthonormal. See
    /// [`Model::orthonormal`](crate::model::Model::orthonormal).
    fn in_orthonormal(&self, bases: Option<&Bases<N, T>>) -> Self::InOrthonormal;
    /// The point from one in orthonormal bases, to which `bases` lead.
    #[must_use]
    fn from_orthonormal(point: &Self::InOrthonormal, bases: &Bases<N, T>) -> Self;
    /// All numbers of the point as it stands, in its own frame and unconverted: `phi`, the affine spin, `x`, `p`.
    fn entries(&self, each: &mut dyn FnMut(T));
    /// The point with other numbers, in the order of [`entries`](Self::entries), unchecked.
    #[must_use]
    fn with_entries(&self, next: &mut dyn FnMut() -> T) -> Self;
    /// The point with other canonical coordinates, unchecked; a pinned body has no `x` and no `p`.
    #[must_use]
    fn with_canonical(&self, phi: Matrix<N, T>, pi: Matrix<N, T>, x: Vector<N, T>, p: Vector<N, T>) -> Self;
    /// Placement, momentum and centre of mass are finite.
    fn is_finite(&self) -> bool;
}

impl<const N: usize, F: Frame, C: Translation<N, T>, T: Real, B: Basis> PhasePoint<N, F, C, T, B> {
    /// The point as it stands, unchecked; `spin` is the affine spin in the frame `F`.
    pub(crate) fn new(phi: Matrix<N, T>, spin: Matrix<N, T>, centre: C) -> Self {
        Self { phi, spin, centre, frame: core::marker::PhantomData }
    }

    /// The same point with components in other bases.
    fn rebased<O: Basis>(&self, bases: &Bases<N, T>) -> PhasePoint<N, F, C, T, O> {
        let spin = F::rebased(bases, &self.spin);
        PhasePoint::new(bases.placement(&self.phi), spin, self.centre.rebased(bases))
    }

    /// The point with a momentum given in any frame, unchecked.
    pub(crate) fn with_momentum(phi: Matrix<N, T>, momentum: impl MomentumIn<N, T>, centre: C) -> Self {
        Self::new(phi, momentum.in_frame::<F>(&phi), centre)
    }

    /// The point with a momentum given in any frame, checked.
    ///
    /// The sign of `det phi` comes from an elimination on the scaled placement, so that neither large nor small
    /// entries decide it; it is certain where the condition number then is below about `1/(10 epsilon)`.
    ///
    /// # Errors
    /// [`Error::Placement`] unless `phi` is finite and `det phi > 0`; [`Error::NotFinite`] with the name of the
    /// momentum, `x` or `p` that is not finite, or not finite once in the frame `F`.
    pub(crate) fn checked<M: Momentum<N, T>>(phi: Matrix<N, T>, momentum: M, centre: C) -> Result<Self> {
        let determinant = LogDeterminant::of(&phi);
        if !determinant.is_positive() {
            return Err(Error::Placement { determinant: determinant.to_f64() });
        }
        let point = Self::with_momentum(phi, momentum, centre);
        for (quantity, entries) in [
            (M::Frame::MOMENTUM, point.spin.as_slice()),
            ("x", point.x().as_slice()),
            ("p", point.p().as_slice()),
        ] {
            if !is_finite(entries) {
                return Err(Error::NotFinite { quantity });
            }
        }
        Ok(point)
    }
}

impl<const N: usize, F, C: Copy, T: Real, B> PhasePoint<N, F, C, T, B> {
    /// The point with another affine spin of its own frame.
    pub(crate) fn respinned(self, spin: impl FnOnce(&Matrix<N, T>) -> Result<Matrix<N, T>>) -> Result<Self> {
        Ok(Self { spin: spin(&self.spin)?, ..self })
    }
}

/// A [`Momentum`] brought to another frame.
pub(crate) trait MomentumIn<const N: usize, T: Real>: Momentum<N, T> + Sized {
    /// The matrix in the frame `F`.
    fn in_frame<F: Frame>(self, phi: &Matrix<N, T>) -> Matrix<N, T> {
        F::convert::<Self::Frame, N, T>(phi, &self.matrix())
    }
}

impl<const N: usize, T: Real, M: Momentum<N, T>> MomentumIn<N, T> for M {}

impl<const N: usize, F: Frame, C: Translation<N, T>, T: Real, B: Basis> Phase<N, T>
    for PhasePoint<N, F, C, T, B>
{
    type InOrthonormal = PhasePoint<N, F, C, T, Orthonormal>;

    fn phi(&self) -> &Matrix<N, T> {
        &self.phi
    }
    fn x(&self) -> Vector<N, T> {
        self.centre.position()
    }
    fn p(&self) -> Vector<N, T> {
        self.centre.momentum()
    }
    fn sigma(&self) -> Spatial<AffineSpin<N, T>> {
        Spatial(AffineSpin(F::to_space(&self.phi, &self.spin)))
    }
    fn sigma_hat(&self) -> Comoving<AffineSpin<N, T>> {
        Comoving(AffineSpin(F::to_body(&self.phi, &self.spin)))
    }
    fn pi(&self) -> TwoPoint<AffineSpin<N, T>> {
        TwoPoint(AffineSpin(F::to_canonical(&self.phi, &self.spin)))
    }
    fn mixed_spin(&self) -> Matrix<N, T> {
        F::to_mixed(&self.phi, &self.spin)
    }
    fn moved(
        &self,
        x: Vector<N, T>,
        phi: Matrix<N, T>,
        spin: impl FnOnce(&Matrix<N, T>) -> Matrix<N, T>,
    ) -> Self {
        Self::new(phi, spin(&self.spin), self.centre.moved(x))
    }
    fn in_orthonormal(&self, bases: Option<&Bases<N, T>>) -> Self::InOrthonormal {
        match bases {
            Some(bases) => self.rebased(bases),
            None => PhasePoint::new(self.phi, self.spin, self.centre),
        }
    }
    fn from_orthonormal(point: &Self::InOrthonormal, bases: &Bases<N, T>) -> Self {
        point.rebased(&bases.reversed())
    }
    fn entries(&self, each: &mut dyn FnMut(T)) {
        self.phi.iter().chain(self.spin.iter()).for_each(|entry| each(*entry));
        self.x().iter().chain(self.p().iter()).for_each(|entry| each(*entry));
    }
    fn with_entries(&self, next: &mut dyn FnMut() -> T) -> Self {
        let (phi, spin) = (Matrix::<N, T>::from_fn(|_, _| next()), Matrix::<N, T>::from_fn(|_, _| next()));
        let (x, p) = (Vector::<N, T>::from_fn(|_, _| next()), Vector::<N, T>::from_fn(|_, _| next()));
        Self::new(phi, spin, self.centre.replaced(x, p))
    }
    fn with_canonical(&self, phi: Matrix<N, T>, pi: Matrix<N, T>, x: Vector<N, T>, p: Vector<N, T>) -> Self {
        Self::with_momentum(phi, TwoPoint(AffineSpin(pi)), self.centre.replaced(x, p))
    }
    fn is_finite(&self) -> bool {
        is_finite(self.phi.as_slice())
            && is_finite(self.spin.as_slice())
            && is_finite(self.x().as_slice())
            && is_finite(self.p().as_slice())
    }
}

/// All entries are finite.
fn is_finite<T: Real>(entries: &[T]) -> bool {
    entries.iter().all(|entry| entry.is_finite())
}
