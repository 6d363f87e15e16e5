//! The deviator of the strain, in which dilatations cancel exactly.

use crate::algebra::ring::{pairs, upper};
use crate::algebra::substitute::listed;
use crate::algebra::{Arena, Expr, Matrix, Polynomial, Rational};
use crate::mechanics::metric::Definitions;
use crate::mechanics::potential::base::Base;
use crate::mechanics::potential::tensors::TENSORS;
use crate::symbol::Quantity;

use super::{Strains, beside_diagonal, difference};

impl Strains {
    /// The deviator of `G`, or of `Ct` where the chart reads that.
    pub(in crate::mechanics::potential) fn deviator(&self, arena: &mut Arena) -> Matrix {
        Matrix::symmetric(arena, Quantity::Deviator, self.n)
    }

    /// `cof (G - tr(G)/3)` through `det phi = cof G`, without the entries of `G`: `det phi_ia - cof_ia tr(G)/3` beside the diagonal,
    /// `cof_aa (3 phi_aa^2 - tr G)/3 + phi_aa o_a` on it, where `det = phi_aa cof_aa + o_a` in row `a`. The factors `phi_ia` and
    /// `cof_ia` with what they stand beside: `det`, and on the diagonal the other two.
    pub(in crate::mechanics::potential) fn on_axis(&self, arena: &mut Arena, a: usize) -> [Polynomial; 2] {
        let others = (0..self.n).filter(|b| *b != a);
        let others = others.map(|b| self.phi[a][b].mul(&Polynomial::atom(self.cofactors[a][b])));
        [Polynomial::atom(axial_deviator(arena, a)), others.sum()]
    }

    /// What that and `tr G` are in space: `3 phi_22^2 - tr G` through differences of squares, the others by differences from it.
    fn axial_deviators(&self, arena: &mut Arena, list: &mut Definitions) {
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
        own.mul(own).scaled(&Rational::from(3)).sub(&Polynomial::atom(axial_deviator(arena, 1)))
    }

    /// Its entries, on the diagonal through differences of squares, and the trace of its square.
    pub(super) fn deviators(&self, arena: &mut Arena, list: &mut Definitions) {
        let n = self.n;
        let base = TENSORS[self.own];
        let part = |number: usize| &Rational::whole(number) * &Rational::one_over(n);
        let mut diagonal = vec![Polynomial::zero(); n];
        for a in 0..n - 1 {
            let b = a + 1;
            let [sum, of_squares] = [Quantity::PlacementSum, Quantity::SquareDifference]
                .map(|of| arena.symbol(of.at([a + 1, b + 1])));
            let (difference, _) = difference(arena, a, b);
            let (own, next) = (&self.phi[a][a], &self.phi[b][b]);
            let mut squares = Polynomial::monomial([difference, sum]);
            for (index, sign) in [(a, Rational::ONE), (b, Rational::MINUS_ONE)] {
                let beside = arena.symbol(beside_diagonal(base(index, index)));
                squares.add_term(vec![beside], &sign);
            }
            list.extend([(difference, own.sub(next)), (sum, own.add(next)), (of_squares, squares)]);
            // G_kk - tr(G)/n = sum_a w_ka (G_aa - G_bb), w_ka = (n - a)/n for k <= a and -a/n for k > a, counted from 1
            for (k, entry) in diagonal.iter_mut().enumerate() {
                let weight = if k <= a { part(n - b) } else { -&part(b) };
                entry.add_term(vec![of_squares], &weight);
            }
        }
        self.axial_deviators(arena, list);
        let symbols = self.deviator(arena);
        for (a, b) in upper(n) {
            let entry = if a == b { diagonal[a].clone() } else { Polynomial::atom(base(a, b).symbol(arena)) };
            list.push((symbols.0[a][b], entry));
        }
        let square = symbols.0.iter().flatten().map(|entry| Polynomial::monomial([*entry; 2])).sum();
        list.push((arena.symbol(Quantity::DeviatorSquared), square));
        let mean = Polynomial::term(vec![Base::Trace(1).symbol(arena)], part(1));
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
            Polynomial::term(vec![mean, mean], of_mean).add(&Polynomial::term(vec![square], of_square))
        };
        let values = [
            (Base::Trace(1).symbol(arena), Polynomial::term(vec![mean], n.clone())),
            (Base::Trace(2).symbol(arena), sum(n, Rational::ONE)),
            (second, sum(minors, -&Rational::HALF)),
        ];
        form.substitute(&listed(&values))
    }
}

/// The symbol of `3 phi_aa^2 - tr G`.
fn axial_deviator(arena: &mut Arena, a: usize) -> Expr {
    arena.symbol(Quantity::AxialDeviator.at([a + 1]))
}
