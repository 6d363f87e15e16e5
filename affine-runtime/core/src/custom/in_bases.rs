//! The same calls beside metrics: the equations have orthonormal bases, a field of the model its user's.
//!
//! With `x' = A x`, `phi' = A phi B^-1`: `Q' = A Q A^-1`, `Q_hat' = B Q_hat B^-1`, `Q_tr' = A^-T Q_tr`,
//! `dU/dx' = A^-T dU/dx`, `dU/dphi' = A^-T dU/dphi B^T`. No power changes: `tr(Q' Omega') = tr(Q Omega)`.

use super::{Rows, Told, asked, components, matrix, place, rows};
use crate::force::{Force, Form, Translation};
use crate::frames::{Body, Space, Vector};
use crate::metrics::Bases;
use crate::potential::{Place, Potential, Slopes};
use crate::scalar::Scalar;

fn asked_in<const N: usize, const GYROSCOPIC: bool, T: Scalar, F: Force<N>>(
    force: &F,
    bases: &Bases<N, T>,
    (t, x, phi, x_dot, phi_dot): Told<N, T>,
) -> <F::Form as Form<N>>::Value<T> {
    let vector = |entries: [T; N]| components(&(bases.space_inverse * Vector::<N, T>::from(entries)));
    let placement = |entries: Rows<N, T>| rows(&(bases.space_inverse * matrix(entries) * bases.body));
    asked::<N, GYROSCOPIC, T, F>(force, (t, vector(x), placement(phi), vector(x_dot), placement(phi_dot)))
}

/// `Q`.
#[inline]
pub fn spatial_force_in<const N: usize, const GYROSCOPIC: bool, T: Scalar, F: Force<N, Form = Space>>(
    force: &F,
    bases: &Bases<N, T>,
    told: Told<N, T>,
) -> Rows<N, T> {
    let force = asked_in::<N, GYROSCOPIC, T, F>(force, bases, told);
    rows(&(bases.space * force * bases.space_inverse))
}

/// `Q_hat`.
#[inline]
pub fn comoving_force_in<const N: usize, const GYROSCOPIC: bool, T: Scalar, F: Force<N, Form = Body>>(
    force: &F,
    bases: &Bases<N, T>,
    told: Told<N, T>,
) -> Rows<N, T> {
    let force = asked_in::<N, GYROSCOPIC, T, F>(force, bases, told);
    rows(&(bases.body * force * bases.body_inverse))
}

/// `Q_tr`.
#[inline]
pub fn translational_force_in<const N: usize, const GYROSCOPIC: bool, T: Scalar, F>(
    force: &F,
    bases: &Bases<N, T>,
    told: Told<N, T>,
) -> [T; N]
where
    F: Force<N, Form = Translation>,
{
    let force = asked_in::<N, GYROSCOPIC, T, F>(force, bases, told);
    components(&(bases.space_inverse.transpose() * force))
}

/// The placement in the user's bases.
fn place_in<const N: usize, const CLASS: u8, const POSITION: bool, T: Scalar, P: Potential<N>>(
    bases: &Bases<N, T>,
    x: [T; N],
    phi: Rows<N, T>,
) -> Place<N, T> {
    let x = bases.space_inverse * Vector::<N, T>::from(x);
    let phi = bases.space_inverse * matrix(phi) * bases.body;
    place::<N, CLASS, POSITION, T, P>(x.into(), rows(&phi))
}

/// `U`.
#[inline]
pub fn potential_energy_in<const N: usize, const CLASS: u8, const POSITION: bool, T: Scalar, P>(
    potential: &P,
    bases: &Bases<N, T>,
    x: [T; N],
    phi: Rows<N, T>,
) -> T
where
    P: Potential<N>,
{
    potential.energy(&place_in::<N, CLASS, POSITION, T, P>(bases, x, phi))
}

/// `dU/dx` and `dU/dphi`.
#[inline]
pub fn potential_slopes_in<const N: usize, const CLASS: u8, const POSITION: bool, T: Scalar, P>(
    potential: &P,
    bases: &Bases<N, T>,
    x: [T; N],
    phi: Rows<N, T>,
) -> ([T; N], Rows<N, T>)
where
    P: Potential<N>,
{
    let Slopes { x, phi } = potential.slopes(&place_in::<N, CLASS, POSITION, T, P>(bases, x, phi));
    let to_space = bases.space_inverse.transpose();
    (components(&(to_space * x)), rows(&(to_space * phi * bases.body.transpose())))
}
