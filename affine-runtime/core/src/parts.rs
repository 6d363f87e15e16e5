//! What types of phase points are made of beside those that users name: emitted code writes them.

use core::fmt::Debug;

use crate::matrix::Vector;
use crate::metrics::Bases;
use crate::scalar::Real;

/// What a phase point carries besides placement and affine spin: nothing ([`Pinned`](crate::state::Pinned)) or the centre of mass
/// ([`Centre`](crate::state::Centre)).
pub trait Translation<const N: usize, T: Real>: Copy + Debug + PartialEq {
    /// Position of the centre of mass; zero for a pinned body.
    fn position(&self) -> Vector<N, T>;
    /// Linear momentum `p = dT/dx_dot`, a spatial covector; zero for a pinned body.
    fn momentum(&self) -> Vector<N, T>;
    /// The same momentum at another position; a pinned body stays.
    #[must_use]
    fn moved(&self, x: Vector<N, T>) -> Self {
        self.replaced(x, self.momentum())
    }
    /// The same at another position and with another momentum; a pinned body stays.
    #[must_use]
    fn replaced(&self, x: Vector<N, T>, p: Vector<N, T>) -> Self;
    /// The same in another basis of space: `x' = A x`, `p' = A^-T p`; a pinned body stays.
    #[must_use]
    fn rebased(&self, bases: &Bases<N, T>) -> Self;
}

/// The bases of space and body that the components of a phase point belong to: [`Orthonormal`] or [`Given`].
pub trait Basis: Copy + Debug + PartialEq + Send + Sync + sealed::Sealed + 'static {}

/// Orthonormal bases: both metrics are the identity, transposes and norms are the plain ones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orthonormal;

/// The bases in which a model states its `metrics(...)`: the metrics are `g` and `eta`, which the model knows and the
/// point does not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Given;

impl Basis for Orthonormal {}
impl Basis for Given {}

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::Orthonormal {}
    impl Sealed for super::Given {}
}

/// A vector of the centre of mass: its position `x`, its velocity `x_dot`, its momentum `p`.
#[diagnostic::on_unimplemented(
    message = "this is no vector of the centre of mass, `x`, `x_dot` or `p`, in dimension {N}",
    label = "no vector of the centre of mass",
    note = "a body with translation has `at_velocity(x, phi, x_dot, phi_dot)` and `at_momentum(x, phi, p, spin)`"
)]
pub trait OfCentre<const N: usize> {
    /// The vector.
    fn vector(self) -> Vector<N>;
}

impl<const N: usize> OfCentre<N> for Vector<N> {
    fn vector(self) -> Vector<N> {
        self
    }
}
