//! `tr(G/D^2) - n`, of second order in the strain, without the cancellation to second order.

use crate::algebra::ring::{Ring, Square, adjugate, pairs};
use crate::algebra::{Arena, Expr, Polynomial, Rational};
use crate::symbol::Quantity;

/// The symbol of `tr(G/D^2) - n`.
fn symbol(arena: &mut Arena) -> Expr {
    arena.symbol(Quantity::IsochoricExcess)
}

/// `G/D^2` as a way of writing has it.
pub(super) struct Isochoric {
    /// Its trace, a product of atoms.
    pub(super) trace: Vec<Expr>,
    /// Its deviator.
    pub(super) deviator: Square<Polynomial>,
}

impl Isochoric {
    /// A sum in which the trace is counted from `n`, through that difference as one quantity; `None` for any other sum.
    pub(super) fn through_excess(&self, arena: &mut Arena, form: &Polynomial) -> Option<Polynomial> {
        let coefficient = |wanted: &Polynomial| {
            let monomial = wanted.terms().next().map(|(monomial, _)| monomial.clone())?;
            form.terms().find(|(m, _)| **m == monomial).map(|(_, c)| c)
        };
        let (trace, one) =
            (Polynomial::term(self.trace.clone(), Rational::ONE), Polynomial::constant(Rational::ONE));
        let (slope, constant) = (coefficient(&trace)?, coefficient(&one)?);
        let size = Rational::from(i64::try_from(self.deviator.len()).ok()?);
        if *constant != -&(slope * &size) {
            return None;
        }
        let mut result = form.clone();
        result.add_scaled(&trace, &-slope);
        result.add_scaled(&one, &-constant);
        result.add_term(vec![symbol(arena)], slope);
        Some(result)
    }

    /// With `tau = tr(G/D^2)/n` and the deviator `B = G/D^2 - tau 1`, from `det(G/D^2) = 1`:
    ///
    /// ```text
    /// n = 2   tau^2 - 1 = tr(B^2)/2                     n (tau - 1) = tr(B^2)/(tau + 1)
    /// n = 3   tau^3 - 1 = tau tr(B^2)/2 - det B         n (tau - 1) = 3 (tau tr(B^2)/2 - det B)/(tau^2 + tau + 1)
    /// ```
    pub(super) fn definitions(&self, arena: &mut Arena) -> Vec<(Expr, Polynomial)> {
        let n = self.deviator.len();
        let nth = Rational::one_over(n);
        let (mean, mut list) = (mean_square(arena), Vec::new());
        list.push((mean, Polynomial::term(self.trace.clone(), nth)));
        let mut deviator: Square<Polynomial> = vec![vec![Polynomial::zero(); n]; n];
        let mut square = Polynomial::zero();
        for (a, b) in pairs(n) {
            let entry = arena.symbol(Quantity::IsochoricDeviator.at([a.min(b) + 1, a.max(b) + 1]));
            if a <= b {
                list.push((entry, self.deviator[a][b].clone()));
            }
            deviator[a][b] = Polynomial::atom(entry);
            square.add_term(vec![entry, entry], &Rational::ONE);
        }
        let of_square = arena.symbol(Quantity::IsochoricDeviatorSquared);
        list.push((of_square, square));
        let one = arena.constant(Rational::ONE);
        let mut powers = vec![(one, Rational::ONE), (mean, Rational::ONE)];
        let mut above = Polynomial::atom(of_square);
        if n == 3 {
            powers.push((arena.power(mean, 2), Rational::ONE));
            above = Polynomial::term(vec![mean, of_square], &Rational::from(3) * &Rational::HALF);
            for (entry, row) in deviator[0].iter().zip(adjugate(&deviator)) {
                above.plus_product(entry, &row[0], &Rational::from(-3));
            }
        }
        let below = arena.linear(&powers);
        // A sum of squares and one.
        let reciprocal = arena.reciprocal(below);
        list.push((symbol(arena), above.mul(&Polynomial::atom(reciprocal))));
        list
    }
}

/// The symbol of `tr(G/D^2)/n`.
pub(super) fn mean_square(arena: &mut Arena) -> Expr {
    arena.symbol(Quantity::MeanSquare)
}
