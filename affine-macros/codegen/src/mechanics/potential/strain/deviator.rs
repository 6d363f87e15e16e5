//! The deviator of the strain, in which dilatations cancel exactly.

use crate::algebra::ring::{Square, pairs, table};
use crate::algebra::{Arena, Expr, Polynomial, Rational};
use crate::mechanics::potential::Base;
use crate::symbol::Quantity;

use super::{Strains, beside_diagonal, difference};

impl Strains {
    /// The deviator of `G`, or of `Ct` where the chart reads that.
    pub(in crate::mechanics::potential) fn deviator(&self, arena: &mut Arena) -> Square<Polynomial> {
        let mut entry =
            |a: usize, b: usize| arena.symbol(Quantity::Deviator.at([a.min(b) + 1, a.max(b) + 1]));
        table(self.n, |a, b| Polynomial::atom(entry(a, b)))
    }

    /// `cof (G - tr(G)/3)` through `det phi = cof G`, without the entries of `G`: `det phi_ia - cof_ia tr(G)/3` beside the diagonal,
    /// `cof_aa (3 phi_aa^2 - tr G)/3 + phi_aa o_a` on it, where `det = phi_aa cof_aa + o_a` in row `a`. The factors `phi_ia` and
    /// `cof_ia` with what they stand beside: `det`, and on the diagonal the other two.
    pub(in crate::mechanics::potential) fn on_axis(&self, arena: &mut Arena, a: usize) -> [Polynomial; 2] {
        let others: Polynomial = (0..self.n)
            .filter(|b| *b != a)
            .map(|b| self.phi[a][b].mul(&Polynomial::atom(self.cofactors[a][b])))
            .sum();
        [Polynomial::atom(axial_deviator(arena, a)), others]
    }

    /// What that and `tr G` are in space: `3 phi_22^2 - tr G` through differences of squares, the others by differences from it.
    fn axial_deviators(&self, arena: &mut Arena, list: &mut Vec<(Expr, Polynomial)>) {
        if self.n != 3 {
            return;
        }
        let own = axial_deviator(arena, 1);
        let mut value = Polynomial::zero();
        for (a, sign) in [(0, Rational::ONE), (1, Rational::MINUS_ONE)] {
            let of = [Quantity::PlacementDifference, Quantity::PlacementSum];
            let squares = of.map(|of| arena.symbol(of.at([a + 1, a + 2]))).to_vec();
            value.add_term(squares.clone(), &-&sign);
            let mut other = Polynomial::term(squares, &sign * &Rational::from(3));
            other.add_term(vec![own], &Rational::ONE);
            list.push((axial_deviator(arena, 2 * a), other));
        }
        for (i, a) in pairs(3).filter(|(i, a)| i != a) {
            value.add_product(&self.phi[i][a], &self.phi[i][a], &Rational::MINUS_ONE);
        }
        list.push((own, value));
    }

    /// `tr G` through that.
    pub(in crate::mechanics::potential) fn trace_through_axes(&self, arena: &mut Arena) -> Polynomial {
        let own = &self.phi[1][1];
        let mut trace = own.mul(own).scaled(&Rational::from(3));
        trace.add_term(vec![axial_deviator(arena, 1)], &Rational::MINUS_ONE);
        trace
    }

    /// Its entries, on the diagonal through differences of squares, and the trace of its square.
    pub(super) fn deviators(&self, arena: &mut Arena, list: &mut Vec<(Expr, Polynomial)>) {
        let n = self.n;
        let base: fn(usize, usize) -> Base = if self.spatial { Base::Finger } else { Base::Green };
        let part = |number: usize| &Rational::whole(number) * &Rational::one_over(n);
        let mut diagonal = vec![Polynomial::zero(); n];
        for a in 0..n - 1 {
            let b = a + 1;
            let [sum, of_squares] = [Quantity::PlacementSum, Quantity::SquareDifference]
                .map(|of| arena.symbol(of.at([a + 1, b + 1])));
            let (difference, _) = difference(arena, a, b);
            let combined = |sign: Rational| {
                let mut value = self.phi[a][a].clone();
                value.add_scaled(&self.phi[b][b], &sign);
                value
            };
            let mut squares = Polynomial::monomial([difference, sum]);
            for (index, sign) in [(a, Rational::ONE), (b, Rational::MINUS_ONE)] {
                let beside = arena.symbol(beside_diagonal(base(index, index)));
                squares.add_term(vec![beside], &sign);
            }
            list.extend([
                (difference, combined(Rational::MINUS_ONE)),
                (sum, combined(Rational::ONE)),
                (of_squares, squares),
            ]);
            // G_kk - tr(G)/n = sum_a w_ka (G_aa - G_bb), w_ka = (n - a)/n for k <= a and -a/n for k > a, counted from 1
            for (k, entry) in diagonal.iter_mut().enumerate() {
                let weight = if k <= a { part(n - b) } else { -&part(b) };
                entry.add_term(vec![of_squares], &weight);
            }
        }
        self.axial_deviators(arena, list);
        let symbols = self.deviator(arena);
        let mut square = Polynomial::zero();
        for (a, b) in pairs(n) {
            square.add_product(&symbols[a][b], &symbols[a][b], &Rational::ONE);
            let entry = if a == b { diagonal[a].clone() } else { Polynomial::atom(base(a, b).symbol(arena)) };
            let symbol = symbols[a][b].terms().next().and_then(|(monomial, _)| monomial.first().copied());
            list.extend(symbol.filter(|_| a <= b).map(|symbol| (symbol, entry)));
        }
        list.push((arena.symbol(Quantity::DeviatorSquared), square));
        let mean = Polynomial::term(vec![Base::Trace.symbol(arena)], part(1));
        list.push((arena.symbol(Quantity::MeanSquareStretch), mean));
    }

    /// The polynomial with invariants through the mean and the deviator: those of dilatations cancel exactly.
    pub(in crate::mechanics::potential) fn through_deviator(
        &self,
        arena: &mut Arena,
        form: &Polynomial,
    ) -> Polynomial {
        let n = Rational::whole(self.n);
        let minors = Rational::whole(self.n * (self.n - 1) / 2);
        let [mean, square, second] = arena.symbols([
            Quantity::MeanSquareStretch,
            Quantity::DeviatorSquared,
            Quantity::SecondInvariant,
        ]);
        let sum = |of_mean: Rational, of_square: Rational| {
            let mut sum = Polynomial::term(vec![mean, mean], of_mean);
            sum.add_term(vec![square], &of_square);
            sum
        };
        let values = [
            (Base::Trace.symbol(arena), Polynomial::term(vec![mean], n.clone())),
            (Base::TraceOfSquare.symbol(arena), sum(n, Rational::ONE)),
            (second, sum(minors, -&Rational::HALF)),
        ];
        form.substitute(&|atom| {
            values.iter().find(|(known, _)| *known == atom).map(|(_, value)| value.clone())
        })
    }
}

/// The symbol of `3 phi_aa^2 - tr G`.
fn axial_deviator(arena: &mut Arena, a: usize) -> Expr {
    arena.symbol(Quantity::AxialDeviator.at([a + 1]))
}
