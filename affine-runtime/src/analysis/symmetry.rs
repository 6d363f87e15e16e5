//! Symmetries of equations of motion, whether or not something conserved belongs to them.

use super::field::{Kinds, full, motion, slope_along, vector};
use super::generator::{Generator, bases, confined, isometries, symmetries};
use super::linear::{Column, Dense, RANK, absolute_kernel, from_columns};
use crate::decompose::LinearMap;
use crate::dual::Dual;
use crate::frames::{Matrix, Vector};
use crate::model::{Conserved, Model};
use crate::state::Phase;

/// Points at which it is seen whether fields commute.
const POINTS: usize = 4;
/// How far these are away, in parts of stretches.
const APART: f64 = 0.1;

/// Generators of symmetries of the equations: those of the energy where it is conserved. Friction and forces take momenta away, and may
/// keep the symmetries: there these are the isometries whose fields commute with the motion, `[X_H, X_zeta] = 0`, at points around one
/// that has a linearised motion.
pub(super) fn equivariances<const N: usize, M: Model<N>>(
    model: &M,
    z: &Column,
    slopes: &Dense,
) -> Vec<Generator<N>> {
    let (proved, all) = (symmetries(model), isometries::<N, M>());
    let kinds = Kinds::of::<N, M>();
    if M::DESCRIPTION.conserved.contains(&Conserved::Energy) {
        return proved;
    }
    let points = (1..=POINTS).map(|k| beside(model, z, (k, kinds.momentum(slopes).unwrap_or(1.0))));
    let rows: Vec<Column> = points.flat_map(|z| brackets(model, &all, &z, &kinds)).collect();
    let commuting = absolute_kernel(&from_columns(all.len(), &rows).transpose(), RANK);
    // Where the equations have no values at the points, nothing is known but what is proved.
    if commuting.ncols() < proved.len() {
        return proved;
    }
    commuting.column_iter().map(|column| Generator::sum(column.iter().copied().zip(&all))).collect()
}

/// Components of the brackets of the motion with the fields of generators, in parts of what they are differences of.
fn brackets<const N: usize, M: Model<N>>(
    model: &M,
    generators: &[Generator<N>],
    z: &Column,
    kinds: &Kinds,
) -> Vec<Column> {
    let rates = motion(model, z);
    let [along, against] = [true, false].map(|is_along| {
        let columns = generators.iter().map(|zeta| match is_along {
            true => slope_along::<N, M>(z, &rates, |full| zeta.field(model, full).as_ref().to_vec()),
            false => slope_along::<N, M>(z, &vector(&zeta.field(model, &full::<N, M>(z))), |full| {
                model.hamilton_equations(Dual::fixed(0.0), full).as_ref().to_vec()
            }),
        });
        from_columns(z.len(), &columns.collect::<Vec<_>>())
    });
    let rows = |kind: &Vec<usize>| {
        let [along, against] = [&along, &against].map(|one| one.select_rows(kind));
        let size = (along.norm() + against.norm()).max(f64::MIN_POSITIVE);
        let difference = (along - against) / size;
        difference.row_iter().map(|row| row.transpose()).collect::<Vec<_>>()
    };
    [&kinds.places, &kinds.momenta].into_iter().flat_map(rows).collect()
}

/// A point in no special direction from another, on its group.
fn beside<const N: usize, M: Model<N>>(model: &M, z: &Column, (k, momentum): (usize, f64)) -> Column {
    let mut count = 100 * k;
    let mut drawn = || {
        count += 1;
        APART * ((count * count) as f64 * 12.9898).sin()
    };
    let [space, body] = [(); 2].map(|()| Matrix::<N>::from_fn(|_, _| drawn()));
    let Generator { space, body, .. } = confined::<N, M>(&Generator { space, body, ..Generator::zero() });
    let [x, p] = [(); 2].map(|()| Vector::<N>::from_fn(|_, _| drawn()));
    let point = model.orthonormal::<f64>(&model.unflatten(&full::<N, M>(z)));
    let phi = space.exponential() * point.phi();
    let pi = (point.sigma_hat().0.0 + body * momentum) * phi.inverse();
    let moved = point.with_canonical(phi, pi, point.x() + x, point.p() + p * momentum);
    vector(&model.flatten(&M::Point::from_orthonormal(&moved, &bases(model))))
}
