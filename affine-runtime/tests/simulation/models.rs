//! Models written by hand, as the macro would write them but for the reduction.

pub(crate) mod drunk_missile;
pub(crate) mod incompressible_disc;
pub(crate) mod planar;
pub(crate) mod top;
pub(crate) mod vibrating_body;

use affine_runtime::frames::{Matrix, Vector};
use affine_runtime::model::Description;
use affine_runtime::scalar::{Real, Scalar};

/// The placement of the benchmark problems.
pub(crate) fn phi0() -> Matrix<3> {
    Matrix::<3>::new(1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05)
}

/// The co-moving affine spin of the benchmark problems.
pub(crate) fn spin0() -> Matrix<3> {
    Matrix::<3>::new(0.1, 0.4, -0.3, -0.2, -0.15, 0.25, 0.35, -0.1, 0.05)
}

/// A matrix from its rows.
fn matrix<const N: usize, T: Scalar>(rows: &[T]) -> Matrix<N, T> {
    Matrix::<N, T>::from_row_slice(rows)
}

/// A matrix into its rows.
fn write<const N: usize, T: Scalar>(rows: &mut [T], m: &Matrix<N, T>) {
    for (k, entry) in rows.iter_mut().enumerate() {
        *entry = m[(k / N, k % N)];
    }
}

/// `phi^-1` for `N = 3`, by cross products of the rows.
fn inverse<T: Real>(phi: &Matrix<3, T>) -> Matrix<3, T> {
    let rows = [0, 1, 2].map(|i| Vector::<3, T>::new(phi[(i, 0)], phi[(i, 1)], phi[(i, 2)]));
    let determinant = rows[0].dot(&rows[1].cross(&rows[2]));
    let columns = [rows[1].cross(&rows[2]), rows[2].cross(&rows[0]), rows[0].cross(&rows[1])];
    Matrix::<3, T>::from_fn(|a, i| columns[i][a] / determinant)
}

/// `(I tr(Oh^T Oh) + A tr Oh^2 + B (tr Oh)^2)/2`.
fn isotropic_energy<T: Real>(oh: &Matrix<3, T>, [i, a, b]: [f64; 3]) -> T {
    let number = |value: f64| T::constant(0.5 * value, 0.0);
    let trace = oh[(0, 0)] + oh[(1, 1)] + oh[(2, 2)];
    oh.dot(oh) * number(i) + oh.transpose().dot(oh) * number(a) + trace * trace * number(b)
}

/// A description with a name; each fixture fills in what simulations read.
const fn description(name: &'static str) -> Description {
    Description { name, ..Description::PLAIN }
}
