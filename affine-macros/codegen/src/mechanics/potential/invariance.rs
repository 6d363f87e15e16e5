//! What a potential leaves conserved: its derivatives along the generators of the group.

use crate::algebra::evaluate::{Field, evaluate};
use crate::algebra::fault::never_missing;
use crate::algebra::residue::Residue;
use crate::algebra::ring::{Ring, Square, above_diagonal, outer, product, table, times, transpose};
use crate::algebra::substitute::listed;
use crate::algebra::{Arena, Expr, Rational};
use crate::mechanics::charts::{Chart, Linear, Momentum};
use crate::mechanics::conserved::{Candidate, Momenta};
use crate::mechanics::constraint::Constraint;
use crate::mechanics::group_point::{GroupPoint, POINTS, inverse};
use crate::mechanics::symmetry::Side;
use crate::symbol::{Frame, Quantity, Symbol};

use super::base::Base;
use super::principal::Principal;
use super::rewriting::through_dilatation;
use super::tensors::{Tensors, direction, finger, green};

/// What shows which derivatives vanish: points of `GL(n)`, or of the group of a constraint, for which they are projected.
#[derive(Clone, Debug)]
pub(super) struct Evidence {
    dim: usize,
    slopes: Vec<(Base, Expr)>,
    group: Option<Constraint>,
    /// Derivatives along what each momentum generates, which are its rates but for the sign, at the points that decide.
    points: Vec<Momenta>,
}

impl Evidence {
    pub(super) fn new(
        arena: &mut Arena,
        dim: usize,
        slopes: &[(Base, Expr)],
        group: Option<Constraint>,
    ) -> Self {
        let slopes: Vec<(Base, Expr)> =
            slopes.iter().map(|(base, slope)| (*base, through_dilatation(arena, *slope))).collect();
        let mut evidence = Self { dim, slopes, group, points: Vec::new() };
        let chart = Chart::new(arena, dim, Momentum::Body, Some(Linear::Space));
        evidence.points = (0..POINTS).map(|seed| evidence.at(arena, &chart, seed)).collect();
        evidence
    }

    /// The derivatives at the point of this number; `chart` is that of `Sigma_hat` and `p`.
    pub(super) fn at(&self, arena: &Arena, chart: &Chart, seed: usize) -> Momenta {
        let (n, point) = (self.dim, GroupPoint::numbered(arena, chart, self.group, seed));
        let phi = table(n, |i, a| point.value(&Quantity::Placement.at([i + 1, a + 1])));
        let tensors = tensors(&point, phi.clone());
        let slopes = self.slopes_at(arena, &point, &tensors);
        let along = |along: Frame| {
            let derivative = table(n, |a, b| {
                let mut sum = Residue::ZERO;
                for (base, slope) in &slopes {
                    sum.plus_product(slope, &direction(*base, along, &tensors, a, b), &Rational::ONE);
                }
                sum
            });
            self.group.map_or_else(|| derivative.clone(), |group| group.projected(&derivative))
        };
        let position = |i: usize| listed(&slopes)(Base::Position(i)).unwrap_or(Residue::ZERO);
        let centre: Vec<Residue> = (0..n).map(position).collect();
        let x: Vec<Residue> = (1..=n).map(|i| point.value(&Quantity::Position.at([i]))).collect();
        let space = along(Frame::Space);
        let moved = (centre.as_slice(), times(&transpose(&phi), &centre), outer(&x, &centre));
        Momenta::new(
            Some((moved.0, &moved.1, &moved.2)),
            [&space, &along(Frame::Body), &product(&inverse(&phi), &space)],
        )
    }

    fn slopes_at(
        &self,
        arena: &Arena,
        point: &GroupPoint,
        tensors: &Tensors<Residue>,
    ) -> Vec<(Base, Residue)> {
        let mut known = tensors.values();
        for k in 1..=self.dim {
            let inverse = point.value(&Quantity::Stretches.at([k])).recip();
            let inverse = never_missing(inverse, "a random stretch is not zero", Residue::UNKNOWN);
            known.insert(Quantity::InverseStretch.at([k]), inverse);
        }
        let value = |symbol: &Symbol| Some(known.get(symbol).copied().unwrap_or_else(|| point.value(symbol)));
        let at = |(base, slope): &(Base, Expr)| {
            // What has no value is not taken for zero: nothing is conserved beside it.
            let slope = evaluate(arena, *slope, &value);
            let slope = slope.unwrap_or_else(|| point.random(format!("slope of {}", base.quantity())));
            (*base, slope.mul(&Residue::from_rational(&base.weight(self.dim))))
        };
        self.slopes.iter().map(at).collect()
    }

    /// Do the derivatives vanish that would change the candidate?
    pub(super) fn keeps(&self, candidate: Candidate) -> bool {
        self.points.iter().all(|point| point.keep(candidate))
    }

    /// The first rotation, of space or body, along which the energy changes; its plane.
    pub(super) fn changed_by(&self, side: Side) -> Option<(usize, usize)> {
        let momentum = if side == Side::Space { Candidate::Spin } else { Candidate::Vorticity };
        let changes = |k: usize| self.points.iter().any(|point| point.entries(momentum)[k].is_nonzero());
        let planes = above_diagonal(self.dim);
        planes.enumerate().find(|(k, _)| changes(*k)).map(|(_, plane)| plane)
    }
}

/// The tensors of a placement.
fn tensors(point: &GroupPoint, phi: Square<Residue>) -> Tensors<Residue> {
    let n = phi.len();
    let (green, finger) = (table(n, |a, b| green(&phi, a, b)), table(n, |i, j| finger(&phi, i, j)));
    let principal = Principal::on_unit_axes(n, |a, k| point.value(&Quantity::Axis.at([a + 1, k + 1])));
    let squares = [product(&green, &green), product(&finger, &finger)];
    Tensors { phi, green, finger, squares, cofactors: Vec::new(), principal }
}
