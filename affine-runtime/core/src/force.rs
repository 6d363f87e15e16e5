//! Forces of a type of your own: what `forces = custom(field, form)` calls.
//!
//! ```text
//! dSigma/dt = ... + Q        dSigma_hat/dt = ... + Q_hat,  Q_hat = phi^-1 Q phi        dp/dt = ... + Q_tr
//! power = tr(Q Omega) = tr(Q_hat Omega_hat),  Q_tr . dx/dt
//! ```
//!
//! (balance laws (3.1), (4.9), (4.11) of Slawianowski et al.).

use crate::frames::{Body, Matrix, Space, Vector};
use crate::matrix::inverse;
use crate::scalar::Scalar;

/// What a force is told: a placement and its velocity at a time, in the bases that the user states the model in, whatever
/// its metrics; there it answers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion<const N: usize, T = f64> {
    /// Time.
    pub t: T,
    /// Position of the centre of mass; zero for a model without translation.
    pub x: Vector<N, T>,
    /// Placement.
    pub phi: Matrix<N, T>,
    /// Velocity of the centre of mass; zero for a model without translation.
    pub x_dot: Vector<N, T>,
    /// Velocity of the placement; `Omega = phi_dot phi^-1`.
    pub phi_dot: Matrix<N, T>,
}

/// A generalised force as a function of the motion.
///
/// Written once for all numbers: the equations are evaluated over `f64` and over whatever else a user integrates with.
///
/// ```
/// use affine_runtime::force::{Force, Motion, Translation};
/// use affine_runtime::frames::Vector;
/// use affine_runtime::scalar::Scalar;
///
/// /// Air that drags the centre of mass along.
/// struct Wind { strength: f64 }
///
/// impl Force<3> for Wind {
///     type Form = Translation;
///     fn force<T: Scalar>(&self, motion: &Motion<3, T>) -> Vector<3, T> {
///         let strength = T::constant(self.strength, 0.0);
///         Vector::<3, T>::from_fn(|i, _| if i == 0 { strength } else { T::zero() } - motion.x_dot[i])
///     }
/// }
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` computes no force in dimension {N}",
    label = "no force here",
    note = "implement `affine_runtime::force::Force<{N}>` for the type of the field that `forces = custom(..)` names"
)]
pub trait Force<const N: usize> {
    /// What it acts on: [`Space`], [`Body`] or [`Translation`]; the specification says the same.
    type Form: Form<N>;
    /// It has no power, whatever the motion: `tr(Q Omega) = 0`, `Q_tr . x_dot = 0`. The specification then says
    /// `gyroscopic`, and the energy stays conserved; `sampling::check_force` of `affine_runtime` looks whether it is true.
    const GYROSCOPIC: bool = false;

    /// The force.
    fn force<T: Scalar>(&self, motion: &Motion<N, T>) -> <Self::Form as Form<N>>::Value<T>;
}

/// The momentum that a force acts on.
///
/// | form | in the specification | the force | acts on |
/// |---|---|---|---|
/// | [`Space`] | `spatial` | `Q`, an `N` by `N` matrix | `Sigma` |
/// | [`Body`] | `comoving` | `Q_hat`, an `N` by `N` matrix | `Sigma_hat` |
/// | [`Translation`] | `translation` | `Q_tr`, an `N`-vector | `p` |
pub trait Form<const N: usize>: sealed::Sealed {
    /// A matrix or a vector.
    type Value<T: Scalar>;

    /// The power of a force along a motion with this `phi^-1`.
    #[doc(hidden)]
    fn power(force: &Self::Value<f64>, motion: &Motion<N>) -> (f64, f64);
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::Space {}
    impl Sealed for super::Body {}
    impl Sealed for super::Translation {}
}

/// A force on the centre of mass, `translation`: a vector that acts on `p`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Translation;

impl<const N: usize> Form<N> for Space {
    type Value<T: Scalar> = Matrix<N, T>;

    fn power(force: &Matrix<N>, motion: &Motion<N>) -> (f64, f64) {
        let omega = motion.phi_dot * inverse(&motion.phi);
        ((force * omega).trace(), force.norm() * omega.norm())
    }
}

impl<const N: usize> Form<N> for Body {
    type Value<T: Scalar> = Matrix<N, T>;

    fn power(force: &Matrix<N>, motion: &Motion<N>) -> (f64, f64) {
        let omega_hat = inverse(&motion.phi) * motion.phi_dot;
        ((force * omega_hat).trace(), force.norm() * omega_hat.norm())
    }
}

impl<const N: usize> Form<N> for Translation {
    type Value<T: Scalar> = Vector<N, T>;

    fn power(force: &Vector<N>, motion: &Motion<N>) -> (f64, f64) {
        (force.dot(&motion.x_dot), force.norm() * motion.x_dot.norm())
    }
}
