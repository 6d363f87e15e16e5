//! Points of phase space and tangent vectors there, in canonical coordinates.

use num_bigint::BigInt;

use crate::error::Error;
use crate::matrix::Matrix;
use crate::ring::{Dual, Ring};

/// Canonical coordinates `(x, phi; p, Pi)` of a point, or the components of a tangent vector such as the canonical
/// vector field `(x_dot, phi_dot; p_dot, Pi_dot)`.
///
/// `x`, `p` are `n x 1`, both zero for a body without translation; `phi[i][A]`, and `Pi[A][i]` conjugate to it.
#[derive(Clone, Debug)]
pub struct State<R = BigInt> {
    /// Position of the centre of mass.
    pub x: Matrix<R>,
    /// Placement.
    pub phi: Matrix<R>,
    /// Linear momentum.
    pub p: Matrix<R>,
    /// Canonical momentum, `Pi[A][i] = dT/dphi_dot[i][A]`.
    pub pi: Matrix<R>,
}

impl<R: Ring> State<R> {
    /// The dimension `n`.
    pub fn dimension(&self) -> usize {
        self.phi.shape().0
    }

    /// `phi`, checked to be square and of dimension 2 or 3, with the other shapes to match.
    pub(crate) fn checked(self) -> Result<Self, Error> {
        let n = self.dimension();
        if !(2..=3).contains(&n) {
            return Err(Error::Dimension(n));
        }
        check("x", &self.x, (n, 1))?;
        check("phi", &self.phi, (n, n))?;
        check("p", &self.p, (n, 1))?;
        check("Pi", &self.pi, (n, n))?;
        Ok(self)
    }
}

pub(crate) fn check<R: Ring>(
    quantity: &'static str,
    matrix: &Matrix<R>,
    expected: (usize, usize),
) -> Result<(), Error> {
    let found = matrix.shape();
    if found == expected { Ok(()) } else { Err(Error::Shape { quantity, expected, found }) }
}

impl State {
    /// The point with these matrices.
    ///
    /// # Errors
    /// [`Error::Dimension`], [`Error::Shape`].
    pub fn new(x: Matrix, phi: Matrix, p: Matrix, pi: Matrix) -> Result<Self, Error> {
        State { x, phi, p, pi }.checked()
    }

    /// The point with the spatial affine spin `Sigma = phi Pi`.
    ///
    /// # Errors
    /// As [`State::new`], and [`Error::SingularPlacement`].
    pub fn with_affine_spin(x: Matrix, phi: Matrix, p: Matrix, sigma: &Matrix) -> Result<Self, Error> {
        check("Sigma", sigma, phi.shape())?;
        let pi = &inverse(&phi)? * sigma;
        State { x, phi, p, pi }.checked()
    }

    /// The point with the co-moving affine spin `Sigma_hat = Pi phi`.
    ///
    /// # Errors
    /// As [`State::new`], and [`Error::SingularPlacement`].
    pub fn with_comoving_affine_spin(
        x: Matrix,
        phi: Matrix,
        p: Matrix,
        sigma_hat: &Matrix,
    ) -> Result<Self, Error> {
        check("Sigma_hat", sigma_hat, phi.shape())?;
        let pi = sigma_hat * &inverse(&phi)?;
        State { x, phi, p, pi }.checked()
    }

    /// The point with these coordinates, taken exactly: `x`, `p` of length `n`, `phi`, `pi` row-major.
    ///
    /// # Errors
    /// [`Error::Dimension`], [`Error::Shape`], [`Error::NotFinite`].
    pub fn from_f64(n: usize, x: &[f64], phi: &[f64], p: &[f64], pi: &[f64]) -> Result<Self, Error> {
        State::new(
            Matrix::from_f64("x", n, 1, x)?,
            Matrix::from_f64("phi", n, n, phi)?,
            Matrix::from_f64("p", n, 1, p)?,
            Matrix::from_f64("Pi", n, n, pi)?,
        )
    }

    /// The same point at rest: `p = 0`.
    pub fn at_rest(&self) -> Self {
        State { p: Matrix::zeros(self.dimension(), 1), ..self.clone() }
    }

    /// `self + epsilon tangent`.
    pub fn along(&self, tangent: &State) -> State<Dual> {
        State {
            x: Matrix::along(&self.x, &tangent.x),
            phi: Matrix::along(&self.phi, &tangent.phi),
            p: Matrix::along(&self.p, &tangent.p),
            pi: Matrix::along(&self.pi, &tangent.pi),
        }
    }
}

pub(crate) fn inverse<R: Ring>(phi: &Matrix<R>) -> Result<Matrix<R>, Error> {
    let (rows, columns) = phi.shape();
    check("phi", phi, (rows, rows.max(columns)))?;
    phi.inverse().ok_or(Error::SingularPlacement)
}
