//! The same calls beside metrics: the equations have orthonormal bases, a field of the model its user's.
//!
//! With `x' = A x`, `phi' = A phi B^-1`: `Q' = A Q A^-1`, `Q_hat' = B Q_hat B^-1`, `Q_tr' = A^-T Q_tr`,
//! `dU/dx' = A^-T dU/dx`, `dU/dphi' = A^-T dU/dphi B^T`. No power changes: `tr(Q' Omega') = tr(Q Omega)`.

use super::{Rows, asked, components, matrix, place, rows};
use crate::force::{Comoving, Force, Form, Motion, Spatial, Translation};
use crate::frames::Vector;
use crate::metrics::Bases;
use crate::potential::{Place, Potential, Slopes};
use crate::scalar::Scalar;

/// A motion in the user's bases, from one in orthonormal ones.
fn moving<const N: usize, T: Scalar>(
    bases: &Bases<N, T>,
    t: T,
    [x, x_dot]: [[T; N]; 2],
    [phi, phi_dot]: [Rows<N, T>; 2],
) -> Motion<N, T> {
    let vector = |components: [T; N]| bases.space_inverse * Vector::<N, T>::from(components);
    let placement = |rows: Rows<N, T>| bases.space_inverse * matrix(rows) * bases.body;
    Motion { t, x: vector(x), phi: placement(phi), x_dot: vector(x_dot), phi_dot: placement(phi_dot) }
}

fn asked_in<const N: usize, const GYROSCOPIC: bool, T: Scalar, F: Force<N>>(
    force: &F,
    bases: &Bases<N, T>,
    t: T,
    vectors: [[T; N]; 2],
    placements: [Rows<N, T>; 2],
) -> <F::Form as Form<N>>::Value<T> {
    let Motion { t, x, phi, x_dot, phi_dot } = moving(bases, t, vectors, placements);
    asked::<N, GYROSCOPIC, T, F>(force, t, x.into(), rows(&phi), x_dot.into(), rows(&phi_dot))
}

/// `Q`.
#[inline]
pub fn spatial_force_in<const N: usize, const GYROSCOPIC: bool, T: Scalar, F: Force<N, Form = Spatial>>(
    force: &F,
    bases: &Bases<N, T>,
    t: T,
    x: [T; N],
    phi: Rows<N, T>,
    x_dot: [T; N],
    phi_dot: Rows<N, T>,
) -> Rows<N, T> {
    let force = asked_in::<N, GYROSCOPIC, T, F>(force, bases, t, [x, x_dot], [phi, phi_dot]);
    rows(&(bases.space * force * bases.space_inverse))
}

/// `Q_hat`.
#[inline]
pub fn comoving_force_in<const N: usize, const GYROSCOPIC: bool, T: Scalar, F: Force<N, Form = Comoving>>(
    force: &F,
    bases: &Bases<N, T>,
    t: T,
    x: [T; N],
    phi: Rows<N, T>,
    x_dot: [T; N],
    phi_dot: Rows<N, T>,
) -> Rows<N, T> {
    let force = asked_in::<N, GYROSCOPIC, T, F>(force, bases, t, [x, x_dot], [phi, phi_dot]);
    rows(&(bases.body * force * bases.body_inverse))
}

/// `Q_tr`.
#[inline]
pub fn translational_force_in<
    const N: usize,
    const GYROSCOPIC: bool,
    T: Scalar,
    F: Force<N, Form = Translation>,
>(
    force: &F,
    bases: &Bases<N, T>,
    t: T,
    x: [T; N],
    phi: Rows<N, T>,
    x_dot: [T; N],
    phi_dot: Rows<N, T>,
) -> [T; N] {
    let force = asked_in::<N, GYROSCOPIC, T, F>(force, bases, t, [x, x_dot], [phi, phi_dot]);
    components(&(bases.space_inverse.transpose() * force))
}

/// The placement in the user's bases.
fn place_in<const N: usize, const CLASS: u8, const POSITION: bool, T: Scalar, P: Potential<N>>(
    bases: &Bases<N, T>,
    t: T,
    x: [T; N],
    phi: Rows<N, T>,
) -> Place<N, T> {
    let x = bases.space_inverse * Vector::<N, T>::from(x);
    let phi = bases.space_inverse * matrix(phi) * bases.body;
    place::<N, CLASS, POSITION, T, P>(t, x.into(), rows(&phi))
}

/// `U`.
#[inline]
pub fn potential_energy_in<
    const N: usize,
    const CLASS: u8,
    const POSITION: bool,
    T: Scalar,
    P: Potential<N>,
>(
    potential: &P,
    bases: &Bases<N, T>,
    t: T,
    x: [T; N],
    phi: Rows<N, T>,
) -> T {
    potential.energy(&place_in::<N, CLASS, POSITION, T, P>(bases, t, x, phi))
}

/// `dU/dx` and `dU/dphi`.
#[inline]
pub fn potential_slopes_in<
    const N: usize,
    const CLASS: u8,
    const POSITION: bool,
    T: Scalar,
    P: Potential<N>,
>(
    potential: &P,
    bases: &Bases<N, T>,
    t: T,
    x: [T; N],
    phi: Rows<N, T>,
) -> ([T; N], Rows<N, T>) {
    let Slopes { x, phi } = potential.slopes(&place_in::<N, CLASS, POSITION, T, P>(bases, t, x, phi));
    let to_space = bases.space_inverse.transpose();
    (components(&(to_space * x)), rows(&(to_space * phi * bases.body.transpose())))
}
