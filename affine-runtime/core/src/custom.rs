//! Calls of fields from emitted code: arrays in, arrays out.

mod in_bases;

use crate::force::{Force, Form, Motion, Translation};
use crate::frames::{Body, Matrix, Space, Vector};
use crate::potential::{Place, Potential, Slopes};
use crate::scalar::Scalar;

pub use in_bases::{
    comoving_force_in, potential_energy_in, potential_slopes_in, spatial_force_in, translational_force_in,
};

type Rows<const N: usize, T> = [[T; N]; N];

/// What a force is told: the time, `x`, `phi`, `x_dot`, `phi_dot`.
type Told<const N: usize, T> = (T, [T; N], Rows<N, T>, [T; N], Rows<N, T>);

/// The matrix with the given rows.
pub fn matrix<const N: usize, T: Scalar>(rows: Rows<N, T>) -> Matrix<N, T> {
    Matrix::from_fn(|i, j| rows[i][j])
}

/// The rows of a matrix.
pub fn rows<const N: usize, T: Scalar>(matrix: &Matrix<N, T>) -> Rows<N, T> {
    core::array::from_fn(|i| core::array::from_fn(|j| matrix[(i, j)]))
}

/// The components of a vector.
pub fn components<const N: usize, T: Scalar>(vector: &Vector<N, T>) -> [T; N] {
    core::array::from_fn(|i| vector[i])
}

/// A field as the potential that it computes; emitted where the specification names the field, so that the compiler says
/// there what its type lacks.
#[inline]
pub fn as_potential<const N: usize, P: Potential<N>>(field: &P) -> &impl Potential<N> {
    field
}

/// A field as the force that it computes.
#[inline]
pub fn as_force<const N: usize, Q: Form<N>, F: Force<N, Form = Q>>(field: &F) -> &impl Force<N, Form = Q> {
    field
}

fn asked<const N: usize, const GYROSCOPIC: bool, T: Scalar, F: Force<N>>(
    force: &F,
    told: Told<N, T>,
) -> <F::Form as Form<N>>::Value<T> {
    const {
        assert!(
            F::GYROSCOPIC == GYROSCOPIC,
            "`gyroscopic` in `forces = custom(..)` and `Force::GYROSCOPIC` of the field's type differ"
        );
    }
    let (t, x, phi, x_dot, phi_dot) = told;
    let motion = Motion { t, x: x.into(), phi: matrix(phi), x_dot: x_dot.into(), phi_dot: matrix(phi_dot) };
    force.force(&motion)
}

/// `Q`.
#[inline]
pub fn spatial_force<const N: usize, const GYROSCOPIC: bool, T: Scalar, F: Force<N, Form = Space>>(
    force: &F,
    told: Told<N, T>,
) -> Rows<N, T> {
    rows(&asked::<N, GYROSCOPIC, T, F>(force, told))
}

/// `Q_hat`.
#[inline]
pub fn comoving_force<const N: usize, const GYROSCOPIC: bool, T: Scalar, F: Force<N, Form = Body>>(
    force: &F,
    told: Told<N, T>,
) -> Rows<N, T> {
    rows(&asked::<N, GYROSCOPIC, T, F>(force, told))
}

/// `Q_tr`.
#[inline]
pub fn translational_force<const N: usize, const GYROSCOPIC: bool, T: Scalar, F>(
    force: &F,
    told: Told<N, T>,
) -> [T; N]
where
    F: Force<N, Form = Translation>,
{
    components(&asked::<N, GYROSCOPIC, T, F>(force, told))
}

fn place<const N: usize, const CLASS: u8, const POSITION: bool, T: Scalar, P: Potential<N>>(
    x: [T; N],
    phi: Rows<N, T>,
) -> Place<N, T> {
    const {
        assert!(
            P::CLASS.is_within(CLASS),
            "`potential = custom(..)` states a class of more symmetry than `Potential::CLASS` of the field's type"
        );
        assert!(
            P::POSITION == POSITION,
            "`position` in `potential = custom(..)` and `Potential::POSITION` of the field's type differ"
        );
    }
    let x = if POSITION { x.into() } else { Vector::from([T::zero(); N]) };
    Place { x, phi: matrix(phi) }
}

/// `U`.
#[inline]
pub fn potential_energy<const N: usize, const CLASS: u8, const POSITION: bool, T: Scalar, P: Potential<N>>(
    potential: &P,
    x: [T; N],
    phi: Rows<N, T>,
) -> T {
    potential.energy(&place::<N, CLASS, POSITION, T, P>(x, phi))
}

/// `dU/dx` and `dU/dphi`.
#[inline]
pub fn potential_slopes<const N: usize, const CLASS: u8, const POSITION: bool, T: Scalar, P: Potential<N>>(
    potential: &P,
    x: [T; N],
    phi: Rows<N, T>,
) -> ([T; N], Rows<N, T>) {
    let Slopes { x, phi } = potential.slopes(&place::<N, CLASS, POSITION, T, P>(x, phi));
    (components(&x), rows(&phi))
}
