//! What a potential leaves conserved: its derivatives along the generators of the group.

use crate::algebra::ring::{Square, deviator, skew, sum, table};
use crate::algebra::{Arena, Expr, Polynomial, Rational};
use crate::mechanics::charts::{Chart, Linear, Momentum};
use crate::mechanics::conserved::Candidate;

use super::principal::Principal;
use super::{Along, Base, Potential, Tensors, definitions, direction, finger, green, placement};

impl Potential {
    /// Does every motion that conserves the candidate without the potential conserve it with it? The kinetic
    /// energy is quadratic in the momenta, so that its bracket and that of the potential vanish each for itself.
    #[must_use]
    pub fn keeps(&self, candidate: Candidate) -> bool {
        let invariance = &self.invariance;
        let vanish = |list: &[Polynomial]| list.iter().all(Polynomial::is_zero);
        match candidate {
            Candidate::Energy => !self.depends_on_time(),
            Candidate::LinearMomentum | Candidate::ComovingLinearMomentum => vanish(&invariance.centre),
            Candidate::OrbitalAngularMomentum => vanish(&skew(&invariance.orbital)),
            Candidate::TotalAffineMomentum => vanish(&invariance.total().concat()),
            Candidate::TotalAngularMomentum => vanish(&skew(&invariance.total())),
            Candidate::AffineSpin
            | Candidate::CanonicalMomentum
            | Candidate::Casimir2
            | Candidate::Casimir3 => vanish(&invariance.space.concat()),
            Candidate::ComovingAffineSpin => vanish(&invariance.body.concat()),
            Candidate::Deviator | Candidate::DeviatorCasimir2 | Candidate::DeviatorCasimir3 => {
                vanish(&deviator(&invariance.space).concat())
            }
            Candidate::ComovingDeviator => vanish(&deviator(&invariance.body).concat()),
            Candidate::Spin | Candidate::SpinNorm => vanish(&skew(&invariance.space)),
            Candidate::Vorticity | Candidate::VorticityNorm => vanish(&skew(&invariance.body)),
            Candidate::Casimir1 => {
                let mut trace = Polynomial::zero();
                (0..self.dim).for_each(|i| trace.add_scaled(&invariance.space[i][i], &Rational::ONE));
                trace.is_zero()
            }
        }
    }
}

/// Derivatives of `U` along the generators, as polynomials in `phi`, `x` and functions.
#[derive(Clone, Debug)]
pub(super) struct Invariance {
    space: Square<Polynomial>,
    body: Square<Polynomial>,
    centre: Vec<Polynomial>,
    orbital: Square<Polynomial>,
}

impl Invariance {
    pub(super) fn new(arena: &mut Arena, n: usize, slopes: &[(Base, Expr)]) -> Self {
        let chart = Chart::new(arena, n, Momentum::Body, Some(Linear::Space));
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
        let tensors = Tensors { phi, green, finger, inverse: Vec::new(), principal };
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

    fn total(&self) -> Square<Polynomial> {
        sum(&self.orbital, &self.space)
    }
}
