//! Forces and potentials that fields compute, and each a second time as forces on the canonical momenta.

use affine_oracle::{Differential, Place as OraclePlace};
use affine_runtime::force::{Force, Motion, Translation};
use affine_runtime::frames::{Body as OnBody, Space as OnSpace};
use affine_runtime::potential::{Class, Place, Potential, Slopes};
use affine_runtime::prelude::*;
use affine_runtime::scalar::Scalar;

use crate::charts::matrix;
use crate::reference::entries;

/// `Q = c (x_dot phi[1]^T - Omega Ct) cos t`, which needs everything that a force is told.
#[derive(Clone)]
pub struct Stirring {
    /// `c`
    pub strength: f64,
}

impl<const N: usize> Force<N> for Stirring {
    type Form = OnSpace;
    fn force<T: Scalar>(&self, m: &Motion<N, T>) -> Matrix<N, T> {
        let c = T::constant(self.strength, 0.0) * m.t.cos();
        let friction = m.phi_dot * m.phi.transpose();
        Matrix::<N, T>::from_fn(|i, j| c * ((m.x_dot[i] + m.x[j]) * m.phi[(j, 0)] - friction[(i, j)]))
    }
}

/// `Q_hat = c phi^T phi_dot`.
#[derive(Clone)]
pub struct Kneading {
    /// `c`
    pub strength: f64,
}

impl<const N: usize> Force<N> for Kneading {
    type Form = OnBody;
    fn force<T: Scalar>(&self, m: &Motion<N, T>) -> Matrix<N, T> {
        (m.phi.transpose() * m.phi_dot) * T::constant(self.strength, 0.0)
    }
}

/// `Q_tr = c (tr phi, ..) - x_dot`.
#[derive(Clone)]
pub struct Wind {
    /// `c`
    pub strength: f64,
}

impl<const N: usize> Force<N> for Wind {
    type Form = Translation;
    fn force<T: Scalar>(&self, m: &Motion<N, T>) -> Vector<N, T> {
        let c = T::constant(self.strength, 0.0);
        Vector::<N, T>::from_fn(|i, _| c * m.phi[(i, i)] - m.x_dot[i])
    }
}

/// `Q_tr = c J x_dot`, `J` skew: a magnetic field.
#[derive(Clone)]
pub struct Magnet {
    /// `c`
    pub strength: f64,
}

impl<const N: usize> Force<N> for Magnet {
    type Form = Translation;
    const GYROSCOPIC: bool = true;
    fn force<T: Scalar>(&self, m: &Motion<N, T>) -> Vector<N, T> {
        let c = T::constant(self.strength, 0.0);
        let mut force = Vector::<N, T>::from_fn(|_, _| T::zero());
        force[0] = c * m.x_dot[1];
        force[1] = -(c * m.x_dot[0]);
        force
    }
}

/// `Q_hat = c (Omega_hat_12, -Omega_hat_11; ..)`: `tr(Q_hat Omega_hat) = 0` although `Q_hat` is not skew.
#[derive(Clone)]
pub struct Gyroscope {
    /// `c`
    pub strength: f64,
}

impl<const N: usize> Force<N> for Gyroscope {
    type Form = OnSpace;
    const GYROSCOPIC: bool = true;
    /// `Q = c phi (phi_dot^T S phi_dot - ..)` would do; here `N = c S phi_dot^T` with a skew `S`, and `Q = phi N`.
    fn force<T: Scalar>(&self, m: &Motion<N, T>) -> Matrix<N, T> {
        let c = T::constant(self.strength, 0.0);
        let turned = Matrix::<N, T>::from_fn(|a, i| match a {
            0 => c * m.phi_dot[(i, 1)],
            1 => -(c * m.phi_dot[(i, 0)]),
            _ => T::zero(),
        });
        m.phi * turned
    }
}

/// `U = c tr G`, isotropic.
#[derive(Clone)]
pub struct Spring {
    /// `c`
    pub strength: f64,
}

impl<const N: usize> Potential<N> for Spring {
    const CLASS: Class = Class::Isotropic;
    fn energy<T: Scalar>(&self, place: &Place<N, T>) -> T {
        let squares = place.phi.iter().fold(T::zero(), |sum, entry| entry.fma(*entry, sum));
        T::constant(self.strength, 0.0) * squares
    }
    fn slopes<T: Scalar>(&self, place: &Place<N, T>) -> Slopes<N, T> {
        let twice = T::constant(2.0 * self.strength, 0.0);
        Slopes { x: Vector::<N, T>::from_fn(|_, _| T::zero()), phi: place.phi * twice }
    }
}

/// `U = c G_11^2`, a function of `G`.
#[derive(Clone)]
pub struct Fibre {
    /// `c`
    pub strength: f64,
}

impl<const N: usize> Potential<N> for Fibre {
    const CLASS: Class = Class::Green;
    fn energy<T: Scalar>(&self, place: &Place<N, T>) -> T {
        let square = (0..N).fold(T::zero(), |sum, i| sum + place.phi[(i, 0)] * place.phi[(i, 0)]);
        T::constant(self.strength, 0.0) * square * square
    }
    fn slopes<T: Scalar>(&self, place: &Place<N, T>) -> Slopes<N, T> {
        let square = (0..N).fold(T::zero(), |sum, i| sum + place.phi[(i, 0)] * place.phi[(i, 0)]);
        let four = T::constant(4.0 * self.strength, 0.0) * square;
        let phi = Matrix::<N, T>::from_fn(|i, a| if a == 0 { four * place.phi[(i, 0)] } else { T::zero() });
        Slopes { x: Vector::<N, T>::from_fn(|_, _| T::zero()), phi }
    }
}

/// `U = c Ct_12^2`, a function of `Ct`.
#[derive(Clone)]
pub struct Wall {
    /// `c`
    pub strength: f64,
}

impl<const N: usize> Potential<N> for Wall {
    const CLASS: Class = Class::Finger;
    fn energy<T: Scalar>(&self, place: &Place<N, T>) -> T {
        let entry = (0..N).fold(T::zero(), |sum, a| sum + place.phi[(0, a)] * place.phi[(1, a)]);
        T::constant(self.strength, 0.0) * entry * entry
    }
    fn slopes<T: Scalar>(&self, place: &Place<N, T>) -> Slopes<N, T> {
        let entry = (0..N).fold(T::zero(), |sum, a| sum + place.phi[(0, a)] * place.phi[(1, a)]);
        let twice = T::constant(2.0 * self.strength, 0.0) * entry;
        let phi = Matrix::<N, T>::from_fn(|i, a| match i {
            0 => twice * place.phi[(1, a)],
            1 => twice * place.phi[(0, a)],
            _ => T::zero(),
        });
        Slopes { x: Vector::<N, T>::from_fn(|_, _| T::zero()), phi }
    }
}

/// `U = c x_1 tr G`.
#[derive(Clone)]
pub struct Field {
    /// `c`
    pub strength: f64,
}

impl<const N: usize> Potential<N> for Field {
    const CLASS: Class = Class::General;
    const POSITION: bool = true;
    fn energy<T: Scalar>(&self, place: &Place<N, T>) -> T {
        let squares = place.phi.iter().fold(T::zero(), |sum, entry| entry.fma(*entry, sum));
        T::constant(self.strength, 0.0) * place.x[0] * squares
    }
    fn slopes<T: Scalar>(&self, place: &Place<N, T>) -> Slopes<N, T> {
        let c = T::constant(self.strength, 0.0);
        let squares = place.phi.iter().fold(T::zero(), |sum, entry| entry.fma(*entry, sum));
        let x = Vector::<N, T>::from_fn(|i, _| if i == 0 { c * squares } else { T::zero() });
        Slopes { x, phi: place.phi * (c * (place.x[0] + place.x[0])) }
    }
}

/// What acts on the canonical momenta at a motion, `on_p` and `on_pi` row-major.
pub fn canonical<const N: usize>(
    q: Option<Matrix<N>>,
    q_hat: Option<Matrix<N>>,
    q_tr: Option<Vector<N>>,
    phi: &Matrix<N>,
) -> (Vec<f64>, Vec<f64>) {
    let inverse = phi.try_inverse().unwrap();
    let mut push = Matrix::<N>::zeros();
    push += q.map_or_else(Matrix::<N>::zeros, |q| inverse * q);
    push += q_hat.map_or_else(Matrix::<N>::zeros, |q_hat| q_hat * inverse);
    (q_tr.unwrap_or_else(Vector::<N>::zeros).as_slice().to_vec(), entries(&push))
}

/// The force of [`Stirring`] with `c = 0.75` on `p` and `Pi`.
pub fn stirred<const N: usize>(m: &Motion<N>) -> (Vec<f64>, Vec<f64>) {
    let omega = m.phi_dot * m.phi.try_inverse().unwrap();
    let friction = omega * m.phi * m.phi.transpose();
    let along = (m.x_dot * Vector::<N>::from_element(1.0).transpose()
        + Vector::<N>::from_element(1.0) * m.x.transpose())
        * Matrix::<N>::from_diagonal(&m.phi.column(0).into_owned());
    canonical(Some((along - friction) * (0.75 * m.t.cos())), None, None, &m.phi)
}

/// That of [`Kneading`].
pub fn kneaded<const N: usize>(m: &Motion<N>) -> (Vec<f64>, Vec<f64>) {
    canonical(None, Some(m.phi.tr_mul(&m.phi_dot) * 0.75), None, &m.phi)
}

/// That of [`Wind`].
pub fn blown<const N: usize>(m: &Motion<N>) -> (Vec<f64>, Vec<f64>) {
    canonical(None, None, Some(m.phi.diagonal() * 0.75 - m.x_dot), &m.phi)
}

/// The force on `Pi` of a skew form in the body: `S phi_dot^T`.
pub fn gyrated<const N: usize>(m: &Motion<N>) -> (Vec<f64>, Vec<f64>) {
    let mut s = Matrix::<N>::zeros();
    (s[(0, 1)], s[(1, 0)]) = (0.75, -0.75);
    (vec![0.0; N], entries(&(s * m.phi_dot.transpose())))
}

/// That of [`Magnet`].
pub fn deflected<const N: usize>(m: &Motion<N>) -> (Vec<f64>, Vec<f64>) {
    let mut force = Vector::<N>::zeros();
    (force[0], force[1]) = (0.75 * m.x_dot[1], -0.75 * m.x_dot[0]);
    canonical(None, None, Some(force), &m.phi)
}

/// The forces of a potential by forward differentiation of its plain definition.
pub fn under<const N: usize>(
    m: &Motion<N>,
    energy: fn(&OraclePlace) -> Differential,
) -> (Vec<f64>, Vec<f64>) {
    let slopes = affine_oracle::Slopes::of(&energy, m.t, m.x.as_slice(), &entries(&m.phi));
    let on_phi = matrix::<N>(&slopes.phi);
    (slopes.x.iter().map(|slope| -slope).collect(), entries(&-on_phi.transpose()))
}
