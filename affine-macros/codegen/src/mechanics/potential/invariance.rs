//! What a potential leaves conserved: its derivatives along the generators of the group.

use crate::algebra::residue::Residue;
use crate::algebra::ring::{Ring, Square, deviator, skew, sum, table};
use crate::algebra::{Arena, Expr, Polynomial, Rational};
use crate::mechanics::charts::{Chart, Linear, Momentum};
use crate::mechanics::conserved::Candidate;
use crate::mechanics::constraint::Constraint;
use crate::mechanics::group_point::GroupPoint;

use super::principal::Principal;
use super::rewriting::through_dilatation;
use super::tensors::{Along, Tensors, definitions, direction, finger, green, placement};
use super::{Base, Potential};

impl Potential {
    /// Does every motion that conserves the candidate without the potential conserve it with it? The kinetic
    /// energy is quadratic in the momenta, so that its bracket and that of the potential vanish each for itself.
    #[must_use]
    pub fn keeps(&self, candidate: Candidate) -> bool {
        if candidate == Candidate::Energy {
            return !self.depends_on_time();
        }
        match &self.invariance {
            Evidence::Identities(one) => one.keeps(candidate),
            Evidence::OnTheGroup(points) => points.iter().all(|point| point.keeps(candidate)),
        }
    }
}

/// What shows that derivatives vanish.
#[derive(Clone, Debug)]
pub(super) enum Evidence {
    /// They are zero as polynomials.
    Identities(Invariance<Polynomial>),
    /// They are zero at random points of the group of a constraint, projected for it.
    OnTheGroup(Vec<Invariance<Residue>>),
}

impl Evidence {
    pub(super) fn identities(arena: &mut Arena, n: usize, slopes: &[(Base, Expr)]) -> Self {
        Self::Identities(Invariance::new(arena, n, slopes))
    }

    pub(super) fn on_the_group(
        arena: &mut Arena,
        n: usize,
        slopes: &[(Base, Expr)],
        group: Constraint,
    ) -> Self {
        let mut through = Vec::new();
        for (base, slope) in slopes {
            through.push((*base, through_dilatation(arena, *slope)));
        }
        let chart = chart(arena, n);
        let symbolic = Invariance::new(arena, n, &through);
        let points = GroupPoint::all(arena, &chart, group);
        let at = |point: &GroupPoint| {
            let value = |p: &Polynomial| point.evaluate(arena, p);
            let values = |m: &Square<Polynomial>| table(n, |a, b| value(&m[a][b]));
            Invariance {
                space: group.projected(&values(&symbolic.space)),
                body: group.projected(&values(&symbolic.body)),
                centre: symbolic.centre.iter().map(value).collect(),
                orbital: values(&symbolic.orbital),
            }
        };
        Self::OnTheGroup(points.iter().map(at).collect())
    }

    /// Do the derivatives with respect to the placement vanish?
    pub(super) fn moves_no_placement(&self) -> bool {
        match self {
            Self::Identities(one) => one.keeps(Candidate::AffineSpin),
            Self::OnTheGroup(points) => points.iter().all(|point| point.keeps(Candidate::AffineSpin)),
        }
    }
}

/// Derivatives of `U` along the generators, as polynomials in `phi`, `x` and functions.
#[derive(Clone, Debug)]
pub(super) struct Invariance<R> {
    pub(super) space: Square<R>,
    pub(super) body: Square<R>,
    centre: Vec<R>,
    orbital: Square<R>,
}

/// The chart whose placement and position the derivatives are written in.
fn chart(arena: &mut Arena, n: usize) -> Chart {
    Chart::new(arena, n, Momentum::Body, Some(Linear::Space))
}

impl Invariance<Polynomial> {
    fn new(arena: &mut Arena, n: usize, slopes: &[(Base, Expr)]) -> Self {
        let chart = chart(arena, n);
        let phi = placement(&chart);
        let (green, finger) = (table(n, |a, b| green(&phi, a, b)), table(n, |i, j| finger(&phi, i, j)));
        let definitions = definitions(arena, n, &chart);
        let value =
            |atom: Expr| definitions.iter().find(|(symbol, _)| *symbol == atom).map(|(_, p)| p.clone());
        let slopes: Vec<(Base, Polynomial)> = slopes
            .iter()
            .map(|(base, slope)| {
                // Traces are sums of entries of tensors, tensors are polynomials in phi.
                let form = Polynomial::normal_form(arena, *slope).substitute(&value).substitute(&value);
                (*base, form.scaled(&base.weight(n)))
            })
            .collect();
        let principal = Principal::on_unit_axes(arena, n);
        let tensors = Tensors { phi, green, finger, cofactors: Vec::new(), principal };
        let along = |along: Along| {
            table(n, |a, b| {
                let mut sum = Polynomial::zero();
                for (base, slope) in &slopes {
                    sum.add_product(slope, &direction(*base, along, &tensors, a, b), &Rational::ONE);
                }
                sum
            })
        };
        let position = |i: usize| {
            let found = slopes.iter().find(|(base, _)| *base == Base::Position(i));
            found.map_or_else(Polynomial::zero, |(_, slope)| slope.clone())
        };
        Self {
            space: along(Along::Space),
            body: along(Along::Body),
            centre: (0..n).map(position).collect(),
            orbital: table(n, |i, j| Polynomial::atom(chart.x[i]).mul(&position(j))),
        }
    }
}

impl<R: Ring> Invariance<R> {
    fn total(&self) -> Square<R> {
        sum(&self.orbital, &self.space)
    }

    fn keeps(&self, candidate: Candidate) -> bool {
        let vanish = |list: &[R]| list.iter().all(Ring::vanishes);
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
                let mut trace = R::zero();
                self.space.iter().enumerate().for_each(|(i, row)| trace.plus(&row[i], &Rational::ONE));
                trace.vanishes()
            }
        }
    }
}
