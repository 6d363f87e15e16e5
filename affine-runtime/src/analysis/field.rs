//! A model at a point, in vectors and matrices of linear algebra.

use nalgebra::{DMatrix, DVector};

use super::generator::Generator;
use super::linear::{Column, Dense, from_columns};
use crate::decompose::LinearMap;
use crate::dual::{Dual, fixed};
use crate::frames::Matrix;
use crate::inner::projected;
use crate::model::{Constraint, Model, Quantity, StateVector};
use crate::scalar::Real;
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
    vector(&model.hamilton_equations(0.0, &full::<N, M>(z)))
}

/// Columns of fields of generators.
pub(super) fn orbit<const N: usize, M: Model<N>>(
    model: &M,
    generators: &[Generator<N>],
    z: &Column,
) -> Dense {
    let columns: Vec<_> =
        generators.iter().map(|zeta| vector(&zeta.field(model, &full::<N, M>(z)))).collect();
    from_columns(z.len(), &columns)
}

/// `D(X_H - X_zeta)`.
pub(super) fn linear_motion<const N: usize, M: Model<N>>(
    model: &M,
    zeta: &Generator<N>,
    z: &Column,
) -> Dense {
    let motion =
        columns::<N, M>(z, |full| model.hamilton_equations(Dual::fixed(0.0), full).as_ref().to_vec());
    motion - linear_field(model, zeta, z)
}

/// `D X_zeta`.
pub(super) fn linear_field<const N: usize, M: Model<N>>(model: &M, zeta: &Generator<N>, z: &Column) -> Dense {
    columns::<N, M>(z, |full| zeta.field(model, full).as_ref().to_vec())
}

/// The Jacobian of a map from plain arrays, one column a pass.
pub(super) fn columns<const N: usize, M: Model<N>>(
    z: &Column,
    map: impl Fn(&M::Full<Dual<f64>>) -> Vec<Dual<f64>>,
) -> Dense {
    let axes = Dense::identity(z.len(), z.len());
    let columns = axes.column_iter().map(|axis| slope_along::<N, M>(z, &axis.into_owned(), &map));
    DMatrix::from_columns(&columns.collect::<Vec<_>>())
}

/// The derivative of a map from plain arrays along a direction.
pub(super) fn slope_along<const N: usize, M: Model<N>>(
    z: &Column,
    direction: &Column,
    map: impl Fn(&M::Full<Dual<f64>>) -> Vec<Dual<f64>>,
) -> Column {
    let mut varied: M::Full<Dual<f64>> = fixed(z.as_slice());
    varied.as_mut().iter_mut().zip(direction.iter()).for_each(|(entry, slope)| entry.slope = *slope);
    DVector::from_vec(map(&varied).iter().map(|number| number.slope).collect())
}

/// Where places and momenta are in the plain array.
pub(super) struct Kinds {
    pub(super) places: Vec<usize>,
    pub(super) momenta: Vec<usize>,
}

impl Kinds {
    pub(super) fn of<const N: usize, M: Model<N>>() -> Self {
        let is_place = |quantity| matches!(quantity, Quantity::Position | Quantity::Placement);
        let groups = M::DESCRIPTION.full.iter();
        let all = groups.flat_map(|group| vec![is_place(group.quantity); group.len]).enumerate();
        let (places, momenta): (Vec<_>, Vec<_>) = all.partition(|(_, is_place)| *is_place);
        let [places, momenta] = [places, momenta].map(|kind| kind.into_iter().map(|(k, _)| k).collect());
        Self { places, momenta }
    }

    /// By what momenta change a motion, and places its momenta.
    pub(super) fn slopes(&self, jacobian: &Dense) -> [f64; 2] {
        [(&self.places, &self.momenta), (&self.momenta, &self.places)]
            .map(|(rows, columns)| jacobian.select_rows(rows).select_columns(columns).norm())
    }

    /// How large momenta are that belong to places of size 1, by the masses and the stiffnesses, where there are both.
    pub(super) fn momentum(&self, jacobian: &Dense) -> Option<f64> {
        let [by_mass, stiffness] = self.slopes(jacobian);
        (by_mass > 0.0 && stiffness > 0.0).then(|| (stiffness / by_mass).sqrt())
    }
}

/// What vanishes on the phase points of a confined model.
fn constraints<const N: usize, M: Model<N>, T: Real>(model: &M, full: &M::Full<T>) -> Vec<T> {
    let Some(constraint) = M::DESCRIPTION.constraint else { return Vec::new() };
    let point = model.orthonormal(&model.unflatten(full));
    let phi = *point.phi();
    let green = phi.tr_mul(&phi);
    let defect = match constraint {
        Constraint::Isochoric => return vec![phi.mean_log_stretch()],
        Constraint::Rigid => green - Matrix::<N, T>::identity(),
        Constraint::Conformal => green - projected(constraint, &green),
    };
    (0..N).flat_map(|a| (0..=a).map(move |b| (a, b))).map(|place| defect[place]).collect()
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
