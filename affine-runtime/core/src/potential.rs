//! Potentials of a type of your own: what `potential = custom(field, class)` calls.

use crate::frames::{Matrix, Vector};
use crate::scalar::Scalar;

/// What a potential is told: a placement, in the bases that the user states the model in, whatever its metrics. It is told no
/// time, since `H` is conserved under it: what changes with the time is a formula in `t`, or a force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place<const N: usize, T = f64> {
    /// Position of the centre of mass; zero for a potential without `position`, whatever the motion.
    pub x: Vector<N, T>,
    /// Placement.
    pub phi: Matrix<N, T>,
}

/// Derivatives of a potential.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slopes<const N: usize, T = f64> {
    /// `dU/dx`; not read for a potential without `position`.
    pub x: Vector<N, T>,
    /// `dU/dphi`, entry `(i, A)` the derivative by `phi[(i, A)]`.
    pub phi: Matrix<N, T>,
}

/// Rotations under which a potential does not change, `U(A phi B) = U(phi)`: what stays conserved follows from it. In a
/// model with metrics they are the rotations of these.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// `isotropic`: rotations of space and body. Spin and vorticity stay conserved where the kinetic energy has them.
    Isotropic,
    /// `green`: rotations of space; a function of `G = phi^T phi`. The spin stays.
    Green,
    /// `finger`: rotations of the body; a function of `Ct = phi phi^T`. The vorticity stays.
    Finger,
    /// `general`: none.
    General,
}

impl Class {
    /// Does it have all the rotations of the class with this number? The numbers are those of the specification.
    pub(crate) const fn is_within(self, stated: u8) -> bool {
        match stated {
            0 => matches!(self, Self::Isotropic),
            1 => matches!(self, Self::Isotropic | Self::Green),
            2 => matches!(self, Self::Isotropic | Self::Finger),
            _ => true,
        }
    }
}

/// A potential energy as a function of the placement.
///
/// Written once for all numbers. `sampling::check_potential` of `affine_runtime` holds class and derivatives against samples.
///
/// Where it has no value, its energy is no finite number: a motion that comes there ends. Steps are looked at where they end.
/// Give slopes that are NaN there as well, so that no step passes over such a place unseen.
#[diagnostic::on_unimplemented(
    message = "`{Self}` computes no potential in dimension {N}",
    label = "no potential here",
    note = "implement `affine_runtime::potential::Potential<{N}>` for the type of the field that `potential = \
            custom(..)` names"
)]
pub trait Potential<const N: usize> {
    /// Under which rotations it does not change; the specification says the same or less.
    const CLASS: Class;
    /// It depends on `x`; the specification then says `position`.
    const POSITION: bool = false;

    /// `U`.
    fn energy<T: Scalar>(&self, place: &Place<N, T>) -> T;
    /// `dU/dx` and `dU/dphi`.
    fn slopes<T: Scalar>(&self, place: &Place<N, T>) -> Slopes<N, T>;
}
