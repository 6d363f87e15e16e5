//! Constant metrics of space and body: bases in which they are the identity.

pub(crate) mod forms;
pub(crate) mod quantities;
mod tensor;

use crate::error::{Error, IllPosed, Result};
use crate::frames::Matrix;
use crate::model::Velocity;
use crate::scalar::{Real, Scalar};

pub use tensor::Tensor;

/// A change of the bases of space and body, `x' = A x`, `phi' = A phi B^-1`.
///
/// With `g = A^T A` and `eta = B^T B` the metrics are the identity in the new bases: `phi^T g phi` is
/// `B^T phi'^T phi' B`. Momenta follow: `p' = A^-T p`, `Sigma' = A Sigma A^-1`, `Sigma_hat' = B Sigma_hat B^-1`,
/// `Pi' = B Pi A^-1`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bases<const N: usize, T: Scalar = f64> {
    /// `A`.
    pub space: Matrix<N, T>,
    /// `A^-1`.
    pub space_inverse: Matrix<N, T>,
    /// `B`.
    pub body: Matrix<N, T>,
    /// `B^-1`.
    pub body_inverse: Matrix<N, T>,
}

impl<const N: usize, T: Real> Bases<N, T> {
    /// The change of bases in the other direction.
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self {
            space: self.space_inverse,
            space_inverse: self.space,
            body: self.body_inverse,
            body_inverse: self.body,
        }
    }

    /// `phi' = A phi B^-1`.
    #[must_use]
    pub fn placement(&self, phi: &Matrix<N, T>) -> Matrix<N, T> {
        self.space * phi * self.body_inverse
    }

    /// `x_dot' = A x_dot`, `phi_dot' = A phi_dot B^-1`.
    #[must_use]
    pub fn velocity(&self, velocity: &Velocity<N, T>) -> Velocity<N, T> {
        Velocity { x_dot: self.space * velocity.x_dot, phi_dot: self.placement(&velocity.phi_dot) }
    }
}

impl<const N: usize, T: Scalar> Bases<N, T> {
    /// With `A` and `B`, each beside its inverse.
    #[must_use]
    pub fn of_factors(
        (space, space_inverse): (Matrix<N, T>, Matrix<N, T>),
        (body, body_inverse): (Matrix<N, T>, Matrix<N, T>),
    ) -> Self {
        Self { space, space_inverse, body, body_inverse }
    }
}

impl<const N: usize> Bases<N> {
    /// The same numbers as another scalar.
    #[must_use]
    pub fn over<T: Scalar>(&self) -> Bases<N, T> {
        let over = |matrix: &Matrix<N>| matrix.map(|entry| T::constant(entry, 0.0));
        Bases {
            space: over(&self.space),
            space_inverse: over(&self.space_inverse),
            body: over(&self.body),
            body_inverse: over(&self.body_inverse),
        }
    }
}

/// `A` upper triangular with `A^T A` the given symmetric metric (Cholesky), and `A^-1`.
///
/// # Errors
/// [`Error::IllPosed`] with the first pivot that is not above `eps` times the summands that it is a difference of.
pub fn orthonormal<const N: usize, T: Real>(
    metric: [[T; N]; N],
    condition: &'static str,
) -> Result<(Matrix<N, T>, Matrix<N, T>)> {
    let mut factor = Matrix::<N, T>::zeros();
    for k in 0..N {
        let known = |j: usize| (0..k).fold(T::zero(), |sum, i| sum + factor[(i, k)] * factor[(i, j)]);
        let (pivot, size) = (metric[k][k] - known(k), metric[k][k].abs() + known(k));
        let (value, threshold) = (pivot.to_f64(), f64::EPSILON * size.to_f64());
        // NaN holds nothing.
        if !(value > threshold && value.is_finite()) {
            return Err(Error::IllPosed(IllPosed {
                condition,
                reason: "the value is a pivot of the metric: one that is not positive definite to rounding gives a \
                         vector no length; choose fields that make every vector but zero longer than zero",
                value,
                threshold,
                velocity: None,
            }));
        }
        let root = pivot.sqrt();
        let row: [T; N] = core::array::from_fn(|j| match j {
            j if j < k => T::zero(),
            j if j == k => root,
            _ => (metric[k][j] - known(j)) / root,
        });
        row.into_iter().enumerate().for_each(|(j, entry)| factor[(k, j)] = entry);
    }
    // Upper triangular, column after column.
    let mut inverse = Matrix::<N, T>::zeros();
    for j in 0..N {
        for i in (0..=j).rev() {
            let unit = if i == j { T::one() } else { T::zero() };
            let known = (i + 1..=j).fold(T::zero(), |sum, k| sum + factor[(i, k)] * inverse[(k, j)]);
            inverse[(i, j)] = (unit - known) / factor[(i, i)];
        }
    }
    Ok((factor, inverse))
}
