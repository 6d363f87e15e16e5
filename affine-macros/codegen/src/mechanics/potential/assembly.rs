//! The forces on the affine momentum, put together from the slopes of a potential.

use crate::algebra::ring::{Square, pairs, table, transpose};
use crate::algebra::{Arena, Polynomial, Rational};
use crate::symbol::Quantity;

use super::base::Base;
use super::load::Draft;
use super::tensors::{Tensors, direction};
use super::writing::{Means, Writing};

/// Slopes with their weights.
type Slopes<'a> = &'a [(Base, Polynomial)];

fn of(slopes: Slopes, wanted: Base) -> Polynomial {
    slopes.iter().find(|(base, _)| *base == wanted).map_or_else(Polynomial::zero, |(_, slope)| slope.clone())
}

impl Draft<'_> {
    /// On `Pi`: `F = phi S + v cof + ..` with the second Piola-Kirchhoff tensor `S`, a symmetric matrix.
    pub(super) fn on_placement(&mut self, arena: &mut Arena, slopes: Slopes) -> Square<Polynomial> {
        let tensors = self.means.tensors(arena, self.chart);
        let mut force = match &self.means {
            Means::Strains(counting) if counting.writing == Writing::Differences => {
                self.stress_from_strains(arena, slopes, &tensors)
            }
            Means::Strains(_) => self.stress_pulled_back(arena, slopes, &tensors),
            _ => self.stress(arena, slopes, &tensors),
        };
        let n = self.chart.dim;
        for (base, slope) in slopes {
            if matches!(
                base,
                Base::Trace
                    | Base::TraceOfSquare
                    | Base::TraceOfCube
                    | Base::Green(..)
                    | Base::MeanLogStretch
            ) {
                continue;
            }
            for (i, a) in pairs(n) {
                let entry = direction(*base, self.along, &tensors, i, a);
                if !entry.is_zero() {
                    let slope = self.coefficient(arena, *base, slope);
                    force[i][a].add_product(&slope, &entry, &Rational::ONE);
                }
            }
        }
        transpose(&force)
    }

    /// `phi (a + b G + c G^2 + E) + v cof`, `E` from single entries of `G`.
    fn stress(
        &mut self,
        arena: &mut Arena,
        slopes: Slopes,
        tensors: &Tensors<Polynomial>,
    ) -> Square<Polynomial> {
        let first = self.named(arena, Base::Trace.slope(), &of(slopes, Base::Trace));
        let second = self.named(arena, Base::TraceOfSquare.slope(), &of(slopes, Base::TraceOfSquare));
        let third = self.named(arena, Base::TraceOfCube.slope(), &of(slopes, Base::TraceOfCube));
        let mut stress = self.of_entries(arena, slopes);
        for (a, row) in stress.iter_mut().enumerate() {
            row[a].add_scaled(&first, &Rational::ONE);
            for (b, entry) in row.iter_mut().enumerate() {
                entry.add_product(&second, &tensors.green[a][b], &Rational::ONE);
                entry.add_product(&third, &tensors.squares[0][a][b], &Rational::ONE);
            }
        }
        let mut force = self.times_stress(arena, &tensors.phi, &stress);
        let swelling = self.swelling(arena, &of(slopes, Base::MeanLogStretch));
        for (row, cofactors) in force.iter_mut().zip(&tensors.cofactors) {
            for (entry, cofactor) in row.iter_mut().zip(cofactors) {
                entry.add_product(&swelling, cofactor, &Rational::ONE);
            }
        }
        force
    }

    /// What stands before the cofactors: a function of the volume in lowest powers; what has tensors in it is formed first, for
    /// its powers of `D` keep these in the range of numbers, and then divided by `det`.
    fn swelling(&mut self, arena: &mut Arena, slope: &Polynomial) -> Polynomial {
        let over = self.means.over_det(slope);
        if self.means.is_of_volume(arena, slope) {
            return self.named(arena, Quantity::Swelling, &over);
        }
        let pressure = self.named(arena, Base::MeanLogStretch.slope(), slope);
        let inverse_det = Polynomial::atom(arena.symbol(Quantity::InverseDeterminant));
        self.named(arena, Quantity::Swelling, &pressure.mul(&inverse_det))
    }

    /// The same with `G = 1 + M` on the diagonal, and there `s phi + v cof = (s + v) phi + v (cof - phi)`: what cancels is one
    /// coefficient, and neither large nor small bodies lose by it.
    fn stress_from_strains(
        &mut self,
        arena: &mut Arena,
        slopes: Slopes,
        tensors: &Tensors<Polynomial>,
    ) -> Square<Polynomial> {
        let n = self.chart.dim;
        let [first, mut second, third] =
            [Base::Trace, Base::TraceOfSquare, Base::TraceOfCube].map(|base| of(slopes, base));
        // a + b G + c G^2 = a + b + c + (b + 2 c) M + c M^2
        let mut along = first;
        along.add_scaled(&second, &Rational::ONE);
        along.add_scaled(&third, &Rational::ONE);
        second.add_scaled(&third, &Rational::from(2));
        let swelling = self.means.over_det(&of(slopes, Base::MeanLogStretch));
        let mut joint = along.clone();
        joint.add_scaled(&swelling, &Rational::ONE);
        let splits = !swelling.is_zero() && !along.is_zero();
        let second = self.named(arena, Base::TraceOfSquare.slope(), &second);
        let third = self.named(arena, Base::TraceOfCube.slope(), &third);
        let mut stress = self.of_entries(arena, slopes);
        let counted = self.means.counted(arena, &along);
        let own = self.named(arena, Quantity::Stress, &counted);
        let Means::Strains(counting) = &self.means else { return stress };
        let strains = &counting.strains;
        for (a, row) in stress.iter_mut().enumerate() {
            for (b, entry) in row.iter_mut().enumerate() {
                entry.add_product(&second, &strains.strain(arena, a, b), &Rational::ONE);
                entry.add_product(&third, &strains.square(arena, a, b), &Rational::ONE);
            }
            if !splits {
                row[a].add_scaled(&own, &Rational::ONE);
            }
        }
        let mut force = self.times_stress(arena, &tensors.phi, &stress);
        let counted = self.means.counted(arena, &swelling);
        let volume = self.named(arena, Quantity::Swelling, &counted);
        let offset = self.means.counted(arena, &joint);
        let offset = if splits { self.named(arena, Quantity::Offset, &offset) } else { Polynomial::zero() };
        let Means::Strains(counting) = &self.means else { return force };
        let strains = &counting.strains;
        for (i, a) in pairs(n) {
            let entry = &mut force[i][a];
            if splits && i == a {
                entry.add_product(&offset, &tensors.phi[a][a], &Rational::ONE);
                entry.add_product(&volume, &strains.asymmetry(a), &Rational::ONE);
                continue;
            }
            if splits {
                entry.add_product(&own, &tensors.phi[i][a], &Rational::ONE);
            }
            entry.add_product(&volume, &tensors.cofactors[i][a], &Rational::ONE);
        }
        force
    }

    /// The symmetric matrix of the slopes by single entries of `G`.
    fn of_entries(&mut self, arena: &mut Arena, slopes: Slopes) -> Square<Polynomial> {
        let mut matrix = self.empty();
        for (base, slope) in slopes {
            let Base::Green(c, d) = *base else { continue };
            let slope = self.coefficient(arena, *base, slope);
            matrix[c][d].add_scaled(&slope, &Rational::ONE);
            matrix[d][c].add_scaled(&slope, &Rational::ONE);
        }
        matrix
    }

    /// `phi S`; entries of `S` that are more than a symbol are shared.
    fn times_stress(
        &mut self,
        arena: &mut Arena,
        phi: &Square<Polynomial>,
        stress: &Square<Polynomial>,
    ) -> Square<Polynomial> {
        let n = self.chart.dim;
        let mut force = self.empty();
        for (a, b) in pairs(n) {
            let (c, d) = (a.min(b), a.max(b));
            let form = &stress[c][d];
            let bare = form.terms().all(|(monomial, k)| monomial.len() == 1 && k.abs().is_one());
            let entry = match form.terms().len() {
                0 => continue,
                1 if bare => form.clone(),
                _ => self.named(arena, Quantity::Piola.at([c + 1, d + 1]), form),
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
        arena: &mut Arena,
        slopes: Slopes,
        tensors: &Tensors<Polynomial>,
    ) -> Square<Polynomial> {
        let over: Vec<(Base, Polynomial)> = slopes
            .iter()
            .filter(|(base, _)| matches!(base, Base::Trace | Base::TraceOfSquare | Base::MeanLogStretch))
            .map(|(base, slope)| (*base, self.means.over_det(slope)))
            .collect();
        let needs_tensor =
            slopes.iter().any(|(base, _)| matches!(base, Base::TraceOfSquare | Base::Green(..)))
                || self
                    .load
                    .shared
                    .iter()
                    .any(|(symbol, _)| arena.quantity(*symbol) == Some(Quantity::IsochoricExcess));
        let deviates =
            matches!(&self.means, Means::Strains(counting) if counting.writing == Writing::Deviators);
        // In the plane products of matrices are shorter.
        if deviates && !needs_tensor && self.chart.dim == 3 {
            return self.stress_of_trace(arena, tensors, &of(slopes, Base::Trace), &over);
        }
        let stress = self.about_the_mean(arena, &over);
        let mut force = self.times_stress(arena, &tensors.cofactors, &stress);
        let entries = self.of_entries(arena, slopes);
        for (row, of_phi) in force.iter_mut().zip(&tensors.phi) {
            for (b, entry) in row.iter_mut().enumerate() {
                for (phi, stress) in of_phi.iter().zip(&entries) {
                    entry.add_product(phi, &stress[b], &Rational::ONE);
                }
            }
        }
        force
    }

    /// `cof (c + k B)/det` with the deviator `B` of `G`: `k cof B = a phi - k m cof`, on the diagonal through differences.
    fn stress_of_trace(
        &mut self,
        arena: &mut Arena,
        tensors: &Tensors<Polynomial>,
        slope: &Polynomial,
        over: Slopes,
    ) -> Square<Polynomial> {
        let n = self.chart.dim;
        let [v, along] = [Base::MeanLogStretch, Base::Trace].map(|base| of(over, base));
        let trace = Base::Trace.symbol(arena);
        if let Means::Strains(counting) = &self.means {
            let value = counting.strains.trace_through_axes(arena);
            self.share(vec![(trace, value)]);
        }
        let offset = self.means.offset(arena, &[v, along.clone()]);
        let offset = self.named(arena, Quantity::Offset, &offset);
        let along = self.named(arena, Quantity::Stress, &along);
        let of_mean = self.named(arena, Quantity::MeanStress, &along.scaled(&Rational::one_over(n)));
        let slope = self.named(arena, Base::Trace.slope(), slope);
        let mut swelling = offset.clone();
        swelling.add_product(&of_mean, &Polynomial::atom(trace), &Rational::MINUS_ONE);
        let swelling = self.named(arena, Quantity::Swelling, &swelling);
        let mut force = self.empty();
        for (i, a) in pairs(n) {
            let (phi, cofactor, entry) = (&tensors.phi[i][a], &tensors.cofactors[i][a], &mut force[i][a]);
            if i != a {
                entry.add_product(&slope, phi, &Rational::ONE);
                entry.add_product(&swelling, cofactor, &Rational::ONE);
                continue;
            }
            let Means::Strains(counting) = &self.means else { continue };
            let [deviator, others] = counting.strains.on_axis(arena, a);
            let mut before = offset.clone();
            before.add_product(&of_mean, &deviator, &Rational::ONE);
            entry.add_product(&before, cofactor, &Rational::ONE);
            entry.add_product(&along.mul(&others), phi, &Rational::ONE);
        }
        force
    }

    /// `v + a G + b G^2 = c + k X + b X^2` with `X = G - m`, where the mean `m` is `tr(G)/n` or 1: `k = a + 2 b m`; `Ct` for `G`
    /// where the chart reads that. About 1 with `d G^3` too: `k = a + 2 b + 3 d`, and `(b + 3 d) X^2 + d X^3`.
    fn about_the_mean(&mut self, arena: &mut Arena, slopes: Slopes) -> Square<Polynomial> {
        let n = self.chart.dim;
        let [v, a, b, d] = [Base::MeanLogStretch, Base::Trace, Base::TraceOfSquare, Base::TraceOfCube]
            .map(|base| of(slopes, base));
        if let Means::Strains(counting) = &self.means
            && counting.writing == Writing::Inverses
        {
            return self.about_the_inverse(arena, [&v, &a, &b]);
        }
        let powers = [v, a, b, d];
        let offset = self.means.offset(arena, &powers);
        let offset = self.named(arena, Quantity::Offset, &offset);
        let [_, a, mut b, d] = powers;
        let Means::Strains(counting) = &self.means else { return self.empty() };
        let strains = &counting.strains;
        let mut mean = Polynomial::constant(Rational::ONE);
        let mut about = table(n, |_, _| Polynomial::zero());
        if counting.writing == Writing::Deviators {
            mean = Polynomial::atom(arena.symbol(Quantity::MeanSquareStretch));
            about = strains.deviator(arena);
        } else {
            for (i, j) in pairs(n) {
                about[i][j] = strains.strain(arena, i, j);
            }
        }
        let mut along = a;
        along.add_product(&b, &mean, &Rational::from(2));
        along.add_scaled(&d, &Rational::from(3));
        b.add_scaled(&d, &Rational::from(3));
        let along = self.named(arena, Quantity::Stress, &along);
        let second = self.named(arena, Base::TraceOfSquare.slope(), &b);
        let third = self.named(arena, Base::TraceOfCube.slope(), &d);
        let mut stress = self.empty();
        let Means::Strains(counting) = &self.means else { return stress };
        for (a, b) in pairs(n) {
            if !d.is_zero() {
                stress[a][b].add_product(&third, &counting.strains.cube(arena, a, b), &Rational::ONE);
            }
            stress[a][b].add_product(&along, &about[a][b], &Rational::ONE);
            let square: Polynomial = (0..n).map(|c| about[a][c].mul(&about[c][b])).sum();
            stress[a][b].add_product(&second, &square, &Rational::ONE);
            if a == b {
                stress[a][b].add_scaled(&offset, &Rational::ONE);
            }
        }
        stress
    }

    /// `v + a G + b G^2` through `G^-1 (G - 1)`, a symmetric matrix.
    fn about_the_inverse(&mut self, arena: &mut Arena, [v, a, b]: [&Polynomial; 3]) -> Square<Polynomial> {
        let n = self.chart.dim;
        let [offset, along, second] = self.means.about_the_inverse(arena, [v, a, b]);
        let offset = self.named(arena, Quantity::Offset, &offset);
        let along = self.named(arena, Quantity::Stress, &along);
        let second = self.named(arena, Base::TraceOfSquare.slope(), &second);
        let Means::Strains(counting) = &self.means else { return self.empty() };
        let (products, definitions) = counting.strains.times_inverse(arena);
        let mut stress = self.empty();
        for (a, b) in pairs(n) {
            stress[a][b].add_product(&along, &counting.strains.strain(arena, a, b), &Rational::ONE);
            stress[a][b].add_product(&second, &products[a][b], &Rational::MINUS_ONE);
            if a == b {
                stress[a][b].add_scaled(&offset, &Rational::ONE);
            }
        }
        self.share(definitions);
        stress
    }

    /// On affine spins: the slopes along the group.
    pub(super) fn on_spin(&mut self, arena: &mut Arena, slopes: Slopes) -> Square<Polynomial> {
        let n = self.chart.dim;
        let tensors = self.means.tensors(arena, self.chart);
        let counts = matches!(self.means, Means::Strains(_));
        let mut force = if counts { self.about_the_mean(arena, slopes) } else { self.empty() };
        for (base, slope) in slopes {
            let isotropic =
                matches!(base, Base::MeanLogStretch | Base::Trace | Base::TraceOfSquare | Base::TraceOfCube);
            if counts && isotropic {
                continue;
            }
            for (a, b) in pairs(n) {
                let entry = direction(*base, self.along, &tensors, a, b);
                if !entry.is_zero() {
                    let slope = self.coefficient(arena, *base, slope);
                    force[a][b].add_product(&slope, &entry, &Rational::ONE);
                }
            }
        }
        force
    }
}
