//! Structs whose fields were not looked at yet: models in type alone, so that a forgotten `prepare()` is one error, where
//! the first phase point is asked for, and not one more at every later use.

use crate::frames::{Body, Matrix, Vector};
use crate::geodesic::Geodesic;
use crate::metrics::Bases;
use crate::model::{Description, Model, Regularity, Velocity};
use crate::parts::Translation;
use crate::scalar::{Real, Scalar};
use crate::state::PhasePoint;

/// A struct with fields that `prepare()` makes a model of dimension `N`; implemented by the macro alone.
///
/// It has no phase points: whatever computes with them does not compile.
///
/// ```compile_fail,E0308
/// use affine_runtime::prelude::*;
///
/// #[affine_model(dim = 2, kinetic(casimir2 = a, body_inertia = 1))]
/// struct Disc { a: f64 }
///
/// fn energy(prepared: &PreparedDisc, start: &<PreparedDisc as Model<2>>::Point<f64>) -> f64 {
///     Disc { a: 0.2 }.hamiltonian(0.0, start)
/// }
/// ```
///
/// Nor does what needs none of them compile, once it is called.
///
/// ```compile_fail,E0080
/// use affine_runtime::prelude::*;
///
/// #[affine_model(dim = 2, kinetic(casimir2 = a, body_inertia = 1))]
/// struct Disc { a: f64 }
///
/// let condition = Disc { a: 0.2 }.condition(&Matrix::<2>::identity());
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a prepared model of an affinely-rigid body in dimension {N}",
    label = "no Hamilton equations here",
    note = "put `#[affine_model(...)]` on the struct; a struct with fields becomes a model by `.prepare()?`"
)]
pub trait Unprepared<const N: usize> {}

/// What `at_momentum` and `at_velocity` of a struct with fields ask of it in vain; nothing implements it.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not prepared: a struct with coefficients to compute becomes a model by `.prepare()?`",
    label = "`.prepare()?` is missing before this",
    note = "`prepare()` checks the values of the fields and computes the coefficients of the equations, \
            those of fields as those of numbers like `sqrt(2)`: `let model = {Self} {{ .. }}.prepare()?;`"
)]
pub trait IsPrepared {
    /// What follows from it.
    fn never<T>(&self) -> T;
}

/// A model whose momenta are a function of the velocities, as the `at_velocity` of a model with `C(3)` in its
/// Hamiltonian asks of it in vain; nothing implements it.
#[diagnostic::on_unimplemented(
    message = "the velocity does not determine the momentum of `{Self}`",
    label = "no Legendre transformation from velocities",
    note = "with `casimir3` the velocity is quadratic in the momentum: several momenta, or none, have a given velocity",
    note = "use `at_momentum`; `velocity()` gives the velocity of a phase point"
)]
pub trait VelocityDeterminesMomentum {
    /// What follows from it.
    fn never<T>(&self) -> T;
}

/// The centre of mass of phase points that do not exist.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NotPrepared {}

impl<const N: usize, T: Real> Translation<N, T> for NotPrepared {
    fn replaced(&self, _: Vector<N, T>, _: Vector<N, T>) -> Self {
        *self
    }
    fn position(&self) -> Vector<N, T> {
        match *self {}
    }
    fn momentum(&self) -> Vector<N, T> {
        match *self {}
    }
    fn moved(&self, _: Vector<N, T>) -> Self {
        *self
    }
    fn rebased(&self, _: &Bases<N, T>) -> Self {
        *self
    }
}

#[cfg(feature = "serde")]
impl<const N: usize> crate::state::serde::Written<N> for NotPrepared {
    const MOVES: bool = false;
    fn read(_x: Vector<N>, _p: Vector<N>) -> Option<Self> {
        None
    }
}

/// Stops the compilation of whatever calls it: of what is compiled for some `U`, not of this crate.
#[allow(clippy::panic, reason = "evaluated by the compiler alone: the panic is the error message")]
const fn unprepared<U, T>() -> T {
    // Not known before there is some `U`: what is the same for all of them the compiler may evaluate at once.
    let is_some_type = size_of::<U>() < usize::MAX;
    assert!(!is_some_type, "a struct with fields becomes a model by `.prepare()?`");
    unreachable!()
}

impl<const N: usize, U: Unprepared<N>> Model<N> for U {
    const DESCRIPTION: Description = unprepared::<U, _>();
    type Point<T: Real> = PhasePoint<N, Body, NotPrepared, T>;
    type Reduced<T: Scalar> = [T; 0];
    type Constants<T: Scalar> = ();
    type Full<T: Scalar> = [T; 0];

    fn velocity<T: Real>(&self, _: &Self::Point<T>) -> Velocity<N, T> {
        const { unprepared::<U, _>() }
    }
    fn kinetic_energy<T: Real>(&self, _: &Matrix<N, T>, _: &Velocity<N, T>) -> T {
        const { unprepared::<U, _>() }
    }
    fn hamiltonian<T: Real>(&self, _: T, _: &Self::Point<T>) -> T {
        const { unprepared::<U, _>() }
    }
    fn flatten<T: Real>(&self, _: &Self::Point<T>) -> [T; 0] {
        const { unprepared::<U, _>() }
    }
    fn unflatten<T: Real>(&self, _: &[T; 0]) -> Self::Point<T> {
        const { unprepared::<U, _>() }
    }
    fn hamilton_equations<T: Scalar>(&self, _: T, _: &[T; 0]) -> [T; 0] {
        const { unprepared::<U, _>() }
    }
    fn reduce<T: Real>(&self, _: T, _: &Self::Point<T>) -> ([T; 0], ()) {
        const { unprepared::<U, _>() }
    }
    fn reduced_equations<T: Scalar>(&self, _: T, (): &(), _: &[T; 0]) -> [T; 0] {
        const { unprepared::<U, _>() }
    }
    fn expand<T: Real>(&self, _: T, (): &(), _: &[T; 0]) -> Self::Point<T> {
        const { unprepared::<U, _>() }
    }
    fn regularity(&self, _: &Matrix<N>) -> Option<Regularity> {
        const { unprepared::<U, _>() }
    }
    fn bases(&self) -> Option<Bases<N>> {
        const { unprepared::<U, _>() }
    }
    fn domain(&self, _: f64, _: &Self::Point<f64>, _: &mut dyn FnMut(f64)) {
        const { unprepared::<U, _>() }
    }
    fn geodesic(&self, _: f64, _: &Self::Point<f64>) -> Option<Geodesic<N>> {
        const { unprepared::<U, _>() }
    }
}
