//! Motion under a holonomic constraint, by Lagrange's multipliers in canonical coordinates.
//!
//! The constraint is a set of functions `c(phi)`, and nothing else is known about the group: velocities satisfy
//! `Dc phi_dot = 0`, and the forces of the constraint are combinations of the gradients of the `c`. A momentum is
//! given up to such a combination; the one that belongs to a velocity is found with it, from `T` alone:
//! `M v = P + Dc^T mu`, `Dc v = 0`.

use nalgebra::DMatrix;
use num_bigint::BigInt;

use super::Motion;
use crate::differential::Differential;
use crate::error::Error;
use crate::kinetic::Kinetic;
use crate::matrix::Matrix;
use crate::potential::{Place, Slopes};
use crate::ring::{Dual, Ring, exact, rational};
use crate::state::{State, inverse};

/// What a motion is confined to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Constraint {
    /// `det phi = 1`.
    Isochoric,
    /// `phi^T phi = 1`.
    Rigid,
    /// `phi^T phi` is a multiple of the identity.
    Conformal,
}

impl Constraint {
    /// The functions that the constraint keeps constant, as a column.
    fn functions<R: Ring>(self, phi: &Matrix<R>) -> Matrix<R> {
        let n = phi.shape().0;
        let green = &phi.transpose() * phi;
        let entry = |a, b| entry(&green, a, b);
        let above = || (0..n).flat_map(|a| (a + 1..n).map(move |b| (a, b)));
        let list: Vec<Matrix<R>> = match self {
            Constraint::Isochoric => vec![determinant(phi)],
            Constraint::Rigid => (0..n).map(|a| (a, a)).chain(above()).map(|(a, b)| entry(a, b)).collect(),
            Constraint::Conformal => {
                let differences = (1..n).map(|a| &entry(a, a) - &entry(0, 0));
                differences.chain(above().map(|(a, b)| entry(a, b))).collect()
            }
        };
        Matrix::collected(list.len(), 1, &list.iter().collect::<Vec<_>>())
    }

    /// `Dc`, one row for each function, one column for each entry of `phi`, by dual numbers.
    fn gradient(self, phi: &Matrix) -> Matrix {
        let n = phi.shape().0;
        let columns: Vec<Matrix> = (0..n * n)
            .map(|place| {
                let moved = Matrix::<Dual>::along(phi, &Matrix::unit(n, place / n, place % n));
                self.functions(&moved).slope()
            })
            .collect();
        let count = columns[0].shape().0;
        Matrix::collected(n * n, count, &columns.iter().collect::<Vec<_>>()).transpose()
    }

    /// A momentum `Sigma` or `Sigma_hat` without what pairs to zero with every velocity that is allowed: the traceless
    /// part, the skew part, or that and the trace.
    pub fn projected(self, momentum: &Matrix) -> Matrix {
        let skew = momentum.skew().scaled(&rational(1, 2));
        match self {
            Constraint::Isochoric => momentum.deviator(),
            Constraint::Rigid => skew,
            Constraint::Conformal => &skew + &(momentum - &momentum.deviator()),
        }
    }
}

/// One entry, as a `1 x 1` matrix.
fn entry<R: Ring>(matrix: &Matrix<R>, i: usize, j: usize) -> Matrix<R> {
    matrix.rows(i, 1).transpose().rows(j, 1)
}

/// By Leibniz's formula.
fn determinant<R: Ring>(phi: &Matrix<R>) -> Matrix<R> {
    let at = |i, a| entry(phi, i, a);
    if phi.shape().0 == 2 {
        return &(&at(0, 0) * &at(1, 1)) - &(&at(0, 1) * &at(1, 0));
    }
    let turn = |a, b, c| &(&at(0, a) * &at(1, b)) * &at(2, c);
    let even = &(&turn(0, 1, 2) + &turn(1, 2, 0)) + &turn(2, 0, 1);
    let odd = &(&turn(0, 2, 1) + &turn(1, 0, 2)) + &turn(2, 1, 0);
    &even - &odd
}

impl Kinetic {
    /// The motion under the constraint and a potential through `state`, whose momentum counts up to forces of the
    /// constraint. The state of the result is the point with the projected momentum `phi^-1 P(Sigma)`, and its rate the
    /// one of that.
    ///
    /// # Errors
    /// As [`Kinetic::velocity`]; [`Error::NotFinite`] where the potential or its gradient is.
    pub fn constrained_motion(
        &self,
        constraint: Constraint,
        state: &State,
        t: f64,
        potential: &dyn Fn(&Place) -> Differential,
    ) -> Result<Motion<'_>, Error> {
        let n = self.dimension();
        let (x_dot, phi_dot) = self.constrained_velocity(constraint, state)?;
        let slopes = Slopes::of(potential, t, &state.x.to_f64(), &state.phi.to_f64());
        let energy = self.energy(&state.phi, &x_dot, &phi_dot)?.entry(0, 0)
            + exact(slopes.value).ok_or(Error::NotFinite { quantity: "U" })?;
        // The momentum of the velocity, and its rate but for a force of the constraint.
        let full = self.legendre(&state.x, &state.phi, &x_dot, &phi_dot)?;
        let force = Matrix::from_f64("dU/dphi", n, n, &slopes.phi)?;
        let full_rate = &self.slope_of_placement(&state.phi, &x_dot, &phi_dot)? - &force.transpose();
        let sigma = constraint.projected(&(&state.phi * &full.pi));
        let sigma_dot = constraint.projected(&(&(&phi_dot * &full.pi) + &(&state.phi * &full_rate)));
        // phi Pi = P(Sigma) along the motion.
        let phi_inverse = inverse(&state.phi)?;
        let pi = &phi_inverse * &sigma;
        let pi_dot = &phi_inverse * &(&sigma_dot - &(&phi_dot * &pi));
        let p_dot = Matrix::from_f64("dU/dx", n, 1, &slopes.x)?.scaled(&rational(-1, 1));
        Ok(Motion {
            kinetic: self,
            state: State { pi, ..state.clone() },
            rate: State { x: x_dot, phi: phi_dot, p: p_dot, pi: pi_dot },
            energy,
        })
    }

    /// `M v = P + Dc^T mu`, `Dc v = 0`, as `(x_dot, phi_dot)`.
    fn constrained_velocity(&self, constraint: Constraint, state: &State) -> Result<(Matrix, Matrix), Error> {
        let mass = self.mass_matrix(&state.phi)?;
        let momentum = self.joined(&state.p, &state.pi.transpose());
        let gradient = constraint.gradient(&state.phi);
        let (count, size) = (gradient.shape().0, mass.shape().0);
        // No constraint contains x.
        let normals = Matrix::zeros(size - gradient.shape().1, count).above(&gradient.transpose());
        let upper = mass.above(&normals.transpose()).transpose();
        let lower = normals.above(&Matrix::zeros(count, count)).transpose();
        let bordered = upper.above(&lower);
        let known = momentum.above(&Matrix::zeros(count, 1));
        let solution = BigInt::solve(&bordered, &known).ok_or(Error::SingularMass)?;
        Ok(self.split(&solution.rows(0, size)))
    }

    /// The condition of the constrained problem in floating point: of the mass matrix between velocities that the
    /// constraint allows.
    ///
    /// # Errors
    /// As [`Kinetic::mass_matrix`].
    pub fn constrained_condition(&self, constraint: Constraint, phi: &Matrix) -> Result<f64, Error> {
        let mass = self.mass_matrix(phi)?;
        let size = mass.shape().0;
        let gradient = constraint.gradient(phi);
        let (count, columns) = gradient.shape();
        let mass = DMatrix::from_row_slice(size, size, &mass.to_f64());
        let gradient = DMatrix::from_row_slice(count, columns, &gradient.to_f64());
        let mut normal = DMatrix::zeros(count, size);
        normal.columns_mut(size - columns, columns).copy_from(&gradient);
        // The kernel of Dc: eigenvectors of Dc^T Dc with the smallest eigenvalues.
        let eigen = (normal.transpose() * &normal).symmetric_eigen();
        let mut order: Vec<usize> = (0..size).collect();
        order.sort_by(|&a, &b| eigen.eigenvalues[a].total_cmp(&eigen.eigenvalues[b]));
        let basis = DMatrix::from_fn(size, size - count, |i, k| eigen.eigenvectors[(i, order[k])]);
        let eigenvalues = (basis.transpose() * mass * basis).symmetric_eigenvalues().abs();
        Ok(eigenvalues.max() / eigenvalues.min())
    }
}
