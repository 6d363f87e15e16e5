//! The forces on the affine momentum, put together from the slopes of a potential.

use crate::algebra::ring::{Square, add_multiple, add_scalar, pairs, product, sum, transpose};
use crate::algebra::substitute::listed;
use crate::algebra::{Polynomial, Rational};
use crate::symbol::Quantity;

use super::base::Base;
use super::load::Draft;
use super::strain::Strains;
use super::tensors::{Tensors, direction, second_invariant};
use super::writing::Writing;

/// Slopes with their weights.
type Slopes<'a> = &'a [(Base, Polynomial)];

fn of(slopes: Slopes, wanted: Base) -> Polynomial {
    listed(slopes)(wanted).unwrap_or_else(Polynomial::zero)
}

impl Draft<'_> {
    /// On `Pi`: `F = phi S + v cof + ..` with the second Piola-Kirchhoff tensor `S`, a symmetric matrix.
    pub(super) fn on_placement(&mut self, slopes: Slopes) -> Square<Polynomial> {
        let tensors = self.means.tensors(self.arena, self.chart);
        let mut force = match self.means.strains.clone() {
            None => self.stress(slopes, &tensors),
            Some(strains) if self.means.writing == Writing::Differences => {
                self.stress_from_strains(slopes, &tensors, &strains)
            }
            Some(strains) => self.stress_pulled_back(slopes, &tensors, &strains),
        };
        let has = |base| matches!(base, Base::Trace(_) | Base::Green(..) | Base::MeanLogStretch);
        self.add_others(&mut force, slopes, &tensors, has);
        transpose(&force)
    }

    /// On affine spins: the slopes along the group.
    pub(super) fn on_spin(&mut self, slopes: Slopes) -> Square<Polynomial> {
        let tensors = self.means.tensors(self.arena, self.chart);
        let strains = self.means.strains.clone();
        let mut force = match &strains {
            Some(strains) => self.about_the_mean(slopes, strains),
            None => self.empty(),
        };
        let has = |base| strains.is_some() && matches!(base, Base::MeanLogStretch | Base::Trace(_));
        self.add_others(&mut force, slopes, &tensors, has);
        force
    }

    /// Adds what slopes make along the group by base functions that the force does not have yet.
    fn add_others(
        &mut self,
        force: &mut Square<Polynomial>,
        slopes: Slopes,
        tensors: &Tensors<Polynomial>,
        has: impl Fn(Base) -> bool,
    ) {
        for (base, slope) in slopes.iter().filter(|(base, _)| !has(*base)) {
            for (a, b) in pairs(self.chart.dim) {
                let entry = direction(*base, self.along, tensors, a, b);
                if !entry.is_zero() {
                    let slope = self.coefficient(*base, slope);
                    force[a][b].add_product(&slope, &entry, &Rational::ONE);
                }
            }
        }
    }

    /// `phi (a + b G + c G^2 + E) + v cof`, `E` from single entries of `G`.
    fn stress(&mut self, slopes: Slopes, tensors: &Tensors<Polynomial>) -> Square<Polynomial> {
        let [first, second, third] = Base::TRACES.map(|base| self.named(base.slope(), &of(slopes, base)));
        let mut stress = self.of_entries(slopes);
        add_scalar(&mut stress, &first);
        add_multiple(&mut stress, &second, &tensors.green);
        add_multiple(&mut stress, &third, &tensors.squares[0]);
        let mut force = self.times_stress(&tensors.phi, &stress);
        let swelling = self.swelling(&of(slopes, Base::MeanLogStretch));
        add_multiple(&mut force, &swelling, &tensors.cofactors);
        force
    }

    /// What stands before the cofactors: a function of the volume in lowest powers; what has tensors in it is formed first, for
    /// its powers of `D` keep these in the range of numbers, and then divided by `det`.
    fn swelling(&mut self, slope: &Polynomial) -> Polynomial {
        let over = self.means.over_det(slope);
        if self.means.is_of_volume(self.arena, slope) {
            return self.named(Quantity::Swelling, &over);
        }
        let pressure = self.named(Base::MeanLogStretch.slope(), slope);
        let inverse_det = Polynomial::atom(self.means.volume.inverse_det);
        self.named(Quantity::Swelling, &pressure.mul(&inverse_det))
    }

    /// The same with `G = 1 + M` on the diagonal, and there `s phi + v cof = (s + v) phi + v (cof - phi)`: what cancels is one
    /// coefficient, and neither large nor small bodies lose by it.
    fn stress_from_strains(
        &mut self,
        slopes: Slopes,
        tensors: &Tensors<Polynomial>,
        strains: &Strains,
    ) -> Square<Polynomial> {
        let [first, second, third] = Base::TRACES.map(|base| of(slopes, base));
        // a + b G + c G^2 = a + b + c + (b + 2 c) M + c M^2
        let along = first.add(&second).add(&third);
        let second = second.add(&third.scaled(&Rational::from(2)));
        let swelling = self.means.over_det(&of(slopes, Base::MeanLogStretch));
        let splits = !swelling.is_zero() && !along.is_zero();
        let second = self.named(Base::Trace(2).slope(), &second);
        let third = self.named(Base::Trace(3).slope(), &third);
        let mut stress = self.of_entries(slopes);
        let own = self.means.counted(self.arena, &along);
        let own = self.named(Quantity::Stress, &own);
        add_multiple(&mut stress, &second, &strains.strain(self.arena));
        add_multiple(&mut stress, &third, &strains.square(self.arena).atoms());
        if !splits {
            add_scalar(&mut stress, &own);
        }
        let mut force = self.times_stress(&tensors.phi, &stress);
        let volume = self.means.counted(self.arena, &swelling);
        let volume = self.named(Quantity::Swelling, &volume);
        let offset = self.means.counted(self.arena, &along.add(&swelling));
        if !splits {
            add_multiple(&mut force, &volume, &tensors.cofactors);
            return force;
        }
        let offset = self.named(Quantity::Offset, &offset);
        for (i, a) in pairs(self.chart.dim) {
            let (before_phi, beside) = match i == a {
                true => (&offset, &Polynomial::atom(strains.asymmetry[a])),
                false => (&own, &tensors.cofactors[i][a]),
            };
            force[i][a].add_product(before_phi, &tensors.phi[i][a], &Rational::ONE);
            force[i][a].add_product(&volume, beside, &Rational::ONE);
        }
        force
    }

    /// The symmetric matrix of the slopes by single entries of `G`.
    fn of_entries(&mut self, slopes: Slopes) -> Square<Polynomial> {
        let mut matrix = self.empty();
        for (base, slope) in slopes {
            let Base::Green(c, d) = *base else { continue };
            let slope = self.coefficient(*base, slope);
            matrix[c][d].add_scaled(&slope, &Rational::ONE);
            matrix[d][c].add_scaled(&slope, &Rational::ONE);
        }
        matrix
    }

    /// `phi S`; entries of `S` that are more than a symbol are shared.
    fn times_stress(&mut self, phi: &Square<Polynomial>, stress: &Square<Polynomial>) -> Square<Polynomial> {
        let mut force = self.empty();
        for (a, b) in pairs(self.chart.dim) {
            let (c, d) = (a.min(b), a.max(b));
            let form = &stress[c][d];
            let bare = form.terms().all(|(monomial, k)| monomial.len() == 1 && k.abs().is_one());
            let entry = match form.terms().len() {
                0 => continue,
                1 if bare => form.clone(),
                _ => self.named(Quantity::Piola.at([c + 1, d + 1]), form),
            };
            for (row, of_phi) in force.iter_mut().zip(phi) {
                row[b].add_product(&of_phi[a], &entry, &Rational::ONE);
            }
        }
        force
    }

    /// `cof (c + k B + b B^2)/det + phi E` with the deviator `B` of `G`.
    fn stress_pulled_back(
        &mut self,
        slopes: Slopes,
        tensors: &Tensors<Polynomial>,
        strains: &Strains,
    ) -> Square<Polynomial> {
        let over: Vec<(Base, Polynomial)> =
            slopes.iter().map(|(base, slope)| (*base, self.means.over_det(slope))).collect();
        let mut shared = self.load.shared.iter().map(|(symbol, _)| self.arena.quantity(*symbol));
        let needs_tensor = slopes.iter().any(|(base, _)| matches!(base, Base::Trace(2) | Base::Green(..)))
            || shared.any(|quantity| quantity == Some(Quantity::IsochoricExcess));
        // In the plane products of matrices are shorter.
        if self.means.writing == Writing::Deviators && !needs_tensor && self.chart.dim == 3 {
            return self.stress_of_trace(tensors, strains, &of(slopes, Base::Trace(1)), &over);
        }
        let stress = self.about_the_mean(&over, strains);
        let force = self.times_stress(&tensors.cofactors, &stress);
        sum(&force, &product(&tensors.phi, &self.of_entries(slopes)))
    }

    /// `cof (c + k B)/det` with the deviator `B` of `G`: `k cof B = a phi - k m cof`, on the diagonal through differences.
    fn stress_of_trace(
        &mut self,
        tensors: &Tensors<Polynomial>,
        strains: &Strains,
        slope: &Polynomial,
        over: Slopes,
    ) -> Square<Polynomial> {
        let n = self.chart.dim;
        let [v, along] = [Base::MeanLogStretch, Base::Trace(1)].map(|base| of(over, base));
        let trace = Base::Trace(1).symbol(self.arena);
        let value = strains.trace_through_axes(self.arena);
        self.share(vec![(trace, value)]);
        let offset = self.offset(strains, &[&v, &along]);
        let along = self.named(Quantity::Stress, &along);
        let of_mean = self.named(Quantity::MeanStress, &along.scaled(&Rational::one_over(n)));
        let slope = self.named(Base::Trace(1).slope(), slope);
        let swelling = offset.sub(&of_mean.mul(&Polynomial::atom(trace)));
        let swelling = self.named(Quantity::Swelling, &swelling);
        let mut force = self.empty();
        for (i, a) in pairs(n) {
            let (mut before_cofactor, mut before_phi) = (swelling.clone(), slope.clone());
            if i == a {
                let [deviator, others] = strains.on_axis(self.arena, a);
                before_cofactor = offset.add(&of_mean.mul(&deviator));
                before_phi = along.mul(&others);
            }
            force[i][a].add_product(&before_cofactor, &tensors.cofactors[i][a], &Rational::ONE);
            force[i][a].add_product(&before_phi, &tensors.phi[i][a], &Rational::ONE);
        }
        force
    }

    /// What stands before the unit matrix: `v + a m + b m^2 + ..`, where the mean `m` of `G` is `tr(G)/n` or 1.
    fn offset(&mut self, strains: &Strains, powers: &[&Polynomial]) -> Polynomial {
        let mean = self.mean();
        let mut sum = Polynomial::zero();
        let mut power = Polynomial::constant(Rational::ONE);
        for coefficient in powers {
            sum.add_product(coefficient, &power, &Rational::ONE);
            power = power.mul(&mean);
        }
        if self.means.writing == Writing::Deviators {
            sum = strains.through_deviator(self.arena, &sum);
        }
        self.reduced_offset(&sum)
    }

    fn reduced_offset(&mut self, sum: &Polynomial) -> Polynomial {
        let offset = self.means.counted(self.arena, &self.means.volume.reduced(sum));
        self.named(Quantity::Offset, &offset)
    }

    fn mean(&mut self) -> Polynomial {
        match self.means.writing {
            Writing::Deviators => Polynomial::atom(self.arena.symbol(Quantity::MeanSquareStretch)),
            _ => Polynomial::constant(Rational::ONE),
        }
    }

    /// `v + a G + b G^2 = c + k X + b X^2` with `X = G - m`, where the mean `m` is `tr(G)/n` or 1: `k = a + 2 b m`; `Ct` for `G`
    /// where the chart reads that. About 1 with `d G^3` too: `k = a + 2 b + 3 d`, and `(b + 3 d) X^2 + d X^3`.
    fn about_the_mean(&mut self, slopes: Slopes, strains: &Strains) -> Square<Polynomial> {
        let [v, a, b, d] = [Base::MeanLogStretch, Base::Trace(1), Base::Trace(2), Base::Trace(3)]
            .map(|base| of(slopes, base));
        if self.means.writing == Writing::Inverses {
            return self.about_the_inverse([&v, &a, &b], strains);
        }
        let offset = self.offset(strains, &[&v, &a, &b, &d]);
        let about = match self.means.writing {
            Writing::Deviators => strains.deviator(self.arena).atoms(),
            _ => strains.strain(self.arena),
        };
        let three = Rational::from(3);
        let along = a.add(&b.mul(&self.mean()).scaled(&Rational::from(2))).add(&d.scaled(&three));
        let along = self.named(Quantity::Stress, &along);
        let second = self.named(Base::Trace(2).slope(), &b.add(&d.scaled(&three)));
        let third = self.named(Base::Trace(3).slope(), &d);
        let mut stress = self.empty();
        if !d.is_zero() {
            let cube = product(&strains.strain(self.arena), &strains.square(self.arena).atoms());
            add_multiple(&mut stress, &third, &cube);
        }
        add_multiple(&mut stress, &along, &about);
        add_multiple(&mut stress, &second, &product(&about, &about));
        add_scalar(&mut stress, &offset);
        stress
    }

    /// `v + a G + b G^2 = c + (a + b tr G) (G - 1) - b det^2 G^-1 (G - 1)`, a symmetric matrix, with
    /// `c = v + a + b tr G + b (det^2 - I2)`.
    fn about_the_inverse(&mut self, [v, a, b]: [&Polynomial; 3], strains: &Strains) -> Square<Polynomial> {
        let along = a.add(&b.mul(&Polynomial::atom(Base::Trace(1).symbol(self.arena))));
        let square = Polynomial::monomial([self.means.volume.det; 2]);
        let minors = square.sub(&Polynomial::atom(second_invariant(self.arena)));
        let offset = self.reduced_offset(&v.add(&along).add(&b.mul(&minors)));
        let along = self.named(Quantity::Stress, &along);
        let second = self.means.volume.reduced(&b.mul(&square));
        let second = self.named(Base::Trace(2).slope(), &second);
        let (products, definitions) = strains.times_inverse(self.arena);
        let mut stress = self.empty();
        add_multiple(&mut stress, &along, &strains.strain(self.arena));
        add_multiple(&mut stress, &second.neg(), &products);
        add_scalar(&mut stress, &offset);
        self.share(definitions);
        stress
    }
}
