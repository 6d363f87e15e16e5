//! A model at a point, in vectors and matrices of linear algebra.

use nalgebra::{DMatrix, DVector};

use super::generator::Generator;
use super::linear::{Column, Dense};
use super::rates::rates;
use crate::dual::Dual;
use crate::frames::{Matrix, inverse};
use crate::model::{Constraint, Model, StateVector};
use crate::scalar::Real;
use crate::simulate::has_multiplier;
use crate::state::Phase;

/// A plain array of a model.
pub(super) fn full<const N: usize, M: Model<N>>(z: &Column) -> M::Full<f64> {
    let mut full = M::Full::<f64>::zeros();
    full.as_mut().iter_mut().zip(z.iter()).for_each(|(entry, value)| *entry = *value);
    full
}

pub(super) fn vector<S: AsRef<[f64]>>(state: &S) -> Column {
    DVector::from_column_slice(state.as_ref())
}

/// `X_H`.
pub(super) fn motion<const N: usize, M: Model<N>>(model: &M, z: &Column) -> Column {
    vector(&rates(model, 0.0, &full::<N, M>(z)))
}

/// `X_zeta`.
pub(super) fn generated<const N: usize, M: Model<N>>(model: &M, zeta: &Generator<N>, z: &Column) -> Column {
    vector(&zeta.field(model, &full::<N, M>(z)))
}

/// Columns of fields of generators.
pub(super) fn orbit<const N: usize, M: Model<N>>(
    model: &M,
    generators: &[Generator<N>],
    z: &Column,
) -> Dense {
    let columns: Vec<_> = generators.iter().map(|zeta| generated(model, zeta, z)).collect();
    if columns.is_empty() { DMatrix::zeros(z.len(), 0) } else { DMatrix::from_columns(&columns) }
}

/// `D(X_H - X_zeta)`.
pub(super) fn linear_motion<const N: usize, M: Model<N>>(
    model: &M,
    zeta: &Generator<N>,
    z: &Column,
) -> Dense {
    let motion = columns::<N, M>(z, |full| rates(model, Dual::fixed(0.0), full).as_ref().to_vec());
    motion - linear_generated(model, zeta, z)
}

/// `D X_zeta`.
pub(super) fn linear_generated<const N: usize, M: Model<N>>(
    model: &M,
    zeta: &Generator<N>,
    z: &Column,
) -> Dense {
    columns::<N, M>(z, |full| zeta.field(model, full).as_ref().to_vec())
}

/// The Jacobian of a map from plain arrays, one column a pass.
fn columns<const N: usize, M: Model<N>>(
    z: &Column,
    map: impl Fn(&M::Full<Dual<f64>>) -> Vec<Dual<f64>>,
) -> Dense {
    let column = |k: usize| {
        let mut varied = M::Full::<Dual<f64>>::zeros();
        varied.as_mut().iter_mut().zip(z.iter()).for_each(|(both, value)| *both = Dual::fixed(*value));
        varied.as_mut()[k].slope = 1.0;
        DVector::from_vec(map(&varied).iter().map(|number| number.slope).collect())
    };
    DMatrix::from_columns(&(0..z.len()).map(column).collect::<Vec<_>>())
}

/// The potential contains the time.
pub(super) fn depends_on_time<const N: usize, M: Model<N>>(model: &M, z: &Column) -> bool {
    let mut fixed = M::Full::<Dual<f64>>::zeros();
    fixed.as_mut().iter_mut().zip(z.iter()).for_each(|(both, value)| *both = Dual::fixed(*value));
    // No time at which a sine or a cosine is flat.
    let rates = model.free_equations(Dual { value: 0.7310585786, slope: 1.0 }, &fixed);
    rates.as_ref().iter().any(|rate| rate.slope != 0.0)
}

/// The momentum of a generator.
pub(super) fn momentum<const N: usize, M: Model<N>>(model: &M, zeta: &Generator<N>, z: &Column) -> f64 {
    zeta.momentum(model, &model.unflatten(&full::<N, M>(z)))
}

/// What vanishes on the phase points of a confined model.
fn constraints<const N: usize, M: Model<N>, T: Real>(model: &M, full: &M::Full<T>) -> Vec<T> {
    let Some(constraint) = M::DESCRIPTION.constraint else { return Vec::new() };
    let point = model.orthonormal(&model.unflatten(full));
    let phi = *point.phi();
    let green = phi.transpose() * phi;
    let mean = green.trace() / T::constant(N as f64, 0.0);
    let pairs = || (0..N).flat_map(|a| (0..a).map(move |b| (a, b)));
    let mut values: Vec<T> = match constraint {
        Constraint::Isochoric => vec![determinant(&phi) - T::one()],
        Constraint::Rigid => (0..N).map(|a| green[(a, a)] - T::one()).collect(),
        Constraint::Conformal => (1..N).map(|a| green[(a, a)] - mean).collect(),
    };
    if constraint != Constraint::Isochoric {
        values.extend(pairs().map(|(a, b)| green[(a, b)]));
    }
    if has_multiplier(&M::DESCRIPTION) {
        let velocity = model.velocity(&model.unflatten(full)).phi_dot;
        values.push((inverse(model.unflatten(full).phi()) * velocity).trace());
    }
    values
}

/// A determinant in any numbers.
pub(super) fn determinant<const N: usize, T: Real>(phi: &Matrix<N, T>) -> T {
    let minor = |i: usize, j: usize| {
        let (r, c) = ([(i + 1) % 3, (i + 2) % 3], [(j + 1) % 3, (j + 2) % 3]);
        phi[(r[0], c[0])] * phi[(r[1], c[1])] - phi[(r[0], c[1])] * phi[(r[1], c[0])]
    };
    match N {
        2 => phi[(0, 0)] * phi[(1, 1)] - phi[(0, 1)] * phi[(1, 0)],
        _ => (0..3).fold(T::zero(), |sum, j| phi[(0, j)].fma(minor(0, j), sum)),
    }
}

/// Values of the constraints.
pub(super) fn confinement<const N: usize, M: Model<N>>(model: &M, z: &Column) -> Vec<f64> {
    constraints(model, &full::<N, M>(z))
}

/// Their derivatives, in rows.
pub(super) fn normals<const N: usize, M: Model<N>>(model: &M, z: &Column) -> Dense {
    columns::<N, M>(z, |full| constraints(model, full))
}

/// The canonical symplectic form, `omega(u, v) = u^T W v = u_q.v_p - u_p.v_q`, over the plain array.
pub(super) fn symplectic_form<const N: usize, M: Model<N>>(model: &M, z: &Column) -> Dense {
    let canonical = canonical_slopes(model, z);
    let half = canonical.nrows() / 2;
    let (positions, momenta) = (canonical.rows(0, half), canonical.rows(half, half));
    positions.transpose() * momenta - momenta.transpose() * positions
}

/// `d(x, phi, p, Pi^T)/dz`.
pub(super) fn canonical_slopes<const N: usize, M: Model<N>>(model: &M, z: &Column) -> Dense {
    columns::<N, M>(z, |full| {
        let point = model.unflatten(full);
        let pi = point.pi().0.0.transpose();
        let (x, phi, p) = (point.x(), *point.phi(), point.p());
        x.iter().chain(phi.iter()).chain(p.iter()).chain(pi.iter()).copied().collect()
    })
}
