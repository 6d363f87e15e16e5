//! What a potential leaves conserved: its derivatives along the generators of the group.

use crate::algebra::evaluate::{Field, evaluate};
use crate::algebra::fault::never_missing;
use crate::algebra::residue::Residue;
use crate::algebra::ring::{Ring, Square, deviator, product, skew, sum, table};
use crate::algebra::{Arena, Expr, Rational};
use crate::mechanics::charts::{Chart, Linear, Momentum};
use crate::mechanics::conserved::Candidate;
use crate::mechanics::constraint::Constraint;
use crate::mechanics::group_point::GroupPoint;
use crate::mechanics::symmetry::Side;
use crate::symbol::{Quantity, Symbol};

use super::base::{Along, Base};
use super::principal::Principal;
use super::rewriting::through_dilatation;
use super::tensors::{Tensors, direction, finger, green};

/// Derivatives of `U` along the generators, at a point modulo a prime.
#[derive(Clone, Debug)]
struct AtAPoint {
    space: Square<Residue>,
    body: Square<Residue>,
    centre: Vec<Residue>,
    orbital: Square<Residue>,
}

/// What shows which derivatives vanish: points of `GL(n)`, or of the group of a constraint, for which they are projected.
#[derive(Clone, Debug)]
pub(super) struct Evidence(Vec<AtAPoint>);

impl Evidence {
    pub(super) fn new(
        arena: &mut Arena,
        n: usize,
        slopes: &[(Base, Expr)],
        group: Option<Constraint>,
    ) -> Self {
        let slopes: Vec<(Base, Expr)> =
            slopes.iter().map(|(base, slope)| (*base, through_dilatation(arena, *slope))).collect();
        let chart = Chart::new(arena, n, Momentum::Body, Some(Linear::Space));
        let points = GroupPoint::all(arena, &chart, group);
        let at = |point: &GroupPoint| {
            let at = AtAPoint::new(arena, n, &slopes, point);
            match group {
                None => at,
                Some(group) => {
                    AtAPoint { space: group.projected(&at.space), body: group.projected(&at.body), ..at }
                }
            }
        };
        Self(points.iter().map(at).collect())
    }

    /// Do the derivatives vanish that would change the candidate?
    pub(super) fn keeps(&self, candidate: Candidate) -> bool {
        self.0.iter().all(|point| point.keeps(candidate))
    }

    /// Do the derivatives with respect to the placement vanish?
    pub(super) fn moves_no_placement(&self) -> bool {
        self.keeps(Candidate::AffineSpin)
    }

    /// The first rotation, of space or body, along which the energy changes; its plane.
    pub(super) fn changed_by(&self, side: Side) -> Option<(usize, usize)> {
        let n = self.0.first()?.space.len();
        let turns = |point: &AtAPoint, (a, b): (usize, usize)| {
            let generators = if side == Side::Space { &point.space } else { &point.body };
            generators[a][b] != generators[b][a]
        };
        let mut planes = (0..n).flat_map(|a| (a + 1..n).map(move |b| (a, b)));
        planes.find(|plane| self.0.iter().any(|point| turns(point, *plane)))
    }
}

impl AtAPoint {
    fn new(arena: &Arena, n: usize, slopes: &[(Base, Expr)], point: &GroupPoint) -> Self {
        let phi = table(n, |i, a| point.value(&Quantity::Placement.at([i + 1, a + 1])));
        let (green, finger) = (table(n, |a, b| green(&phi, a, b)), table(n, |i, j| finger(&phi, i, j)));
        let principal = Principal::on_unit_axes(n, |a, k| point.value(&Quantity::Axis.at([a + 1, k + 1])));
        let squares = [product(&green, &green), product(&finger, &finger)];
        let tensors = Tensors { phi, green, finger, squares, cofactors: Vec::new(), principal };
        let mut known = tensors.values();
        for k in 1..=n {
            let inverse = point.value(&Quantity::Stretches.at([k])).recip();
            let inverse = never_missing(inverse, "a random stretch is not zero", Residue::UNKNOWN);
            known.insert(Quantity::InverseStretch.at([k]), inverse);
        }
        let value = |symbol: &Symbol| Some(known.get(symbol).copied().unwrap_or_else(|| point.value(symbol)));
        let slopes: Vec<(Base, Residue)> = slopes
            .iter()
            .map(|(base, slope)| {
                // What has no value is not taken for zero: nothing is conserved beside it.
                let slope = evaluate(arena, *slope, &value);
                let slope = slope.unwrap_or_else(|| point.random(format!("slope of {}", base.quantity())));
                (*base, slope.mul(&Residue::from_rational(&base.weight(n))))
            })
            .collect();
        let along = |along: Along| {
            table(n, |a, b| {
                let mut sum = Residue::ZERO;
                for (base, slope) in &slopes {
                    sum.plus_product(slope, &direction(*base, along, &tensors, a, b), &Rational::ONE);
                }
                sum
            })
        };
        let position = |i: usize| {
            let found = slopes.iter().find(|(base, _)| *base == Base::Position(i));
            found.map_or(Residue::ZERO, |(_, slope)| *slope)
        };
        Self {
            space: along(Along::Space),
            body: along(Along::Body),
            centre: (0..n).map(position).collect(),
            orbital: table(n, |i, j| point.value(&Quantity::Position.at([i + 1])).mul(&position(j))),
        }
    }

    fn total(&self) -> Square<Residue> {
        sum(&self.orbital, &self.space)
    }

    fn keeps(&self, candidate: Candidate) -> bool {
        let vanish = |list: &[Residue]| list.iter().all(Ring::vanishes);
        match candidate {
            Candidate::Energy => true,
            Candidate::LinearMomentum | Candidate::ComovingLinearMomentum => vanish(&self.centre),
            Candidate::OrbitalAngularMomentum => vanish(&skew(&self.orbital)),
            Candidate::TotalAffineMomentum => vanish(&self.total().concat()),
            Candidate::TotalAngularMomentum => vanish(&skew(&self.total())),
            Candidate::AffineSpin
            | Candidate::CanonicalMomentum
            | Candidate::Casimir2
            | Candidate::Casimir3 => vanish(&self.space.concat()),
            Candidate::ComovingAffineSpin => vanish(&self.body.concat()),
            Candidate::Deviator | Candidate::DeviatorCasimir2 | Candidate::DeviatorCasimir3 => {
                vanish(&deviator(&self.space).concat())
            }
            Candidate::ComovingDeviator => vanish(&deviator(&self.body).concat()),
            Candidate::Spin | Candidate::SpinNorm => vanish(&skew(&self.space)),
            Candidate::Vorticity | Candidate::VorticityNorm => vanish(&skew(&self.body)),
            Candidate::Casimir1 => {
                let mut trace = Residue::ZERO;
                self.space.iter().enumerate().for_each(|(i, row)| trace.plus(&row[i], &Rational::ONE));
                trace.vanishes()
            }
        }
    }
}
