//! `tr(G/D^2) - n`, of second order in the strain, without the cancellation to second order.

use crate::algebra::rational::exponent;
use crate::algebra::ring::{Square, determinant, dot, upper};
use crate::algebra::{Arena, Expr, Matrix, Polynomial, Rational};
use crate::mechanics::metric::Definitions;
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
        let (trace, one) = (Polynomial::monomial(self.trace.clone()), Polynomial::constant(Rational::ONE));
        let coefficient = |wanted: &Polynomial| {
            let (monomial, _) = wanted.terms().next()?;
            form.terms().find(|(m, _)| *m == monomial).map(|(_, c)| c)
        };
        let (slope, constant) = (coefficient(&trace)?, coefficient(&one)?);
        if *constant != -&(slope * &Rational::whole(self.deviator.len())) {
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
    pub(super) fn definitions(&self, arena: &mut Arena) -> Definitions {
        let n = self.deviator.len();
        let mean = mean_square(arena);
        let mut list = vec![(mean, Polynomial::term(self.trace.clone(), Rational::one_over(n)))];
        let symbols = Matrix::symmetric(arena, Quantity::IsochoricDeviator, n);
        list.extend(upper(n).map(|(a, b)| (symbols.0[a][b], self.deviator[a][b].clone())));
        let deviator = symbols.atoms();
        let of_square = arena.symbol(Quantity::IsochoricDeviatorSquared);
        list.push((of_square, dot(deviator.iter().flatten().map(|entry| (entry, entry)))));
        let mut above = Polynomial::atom(of_square);
        if n == 3 {
            above = Polynomial::term(vec![mean, of_square], &Rational::from(3) * &Rational::HALF);
            above.add_scaled(&determinant(&deviator), &Rational::from(-3));
        }
        let over = over_powers(arena, mean, n);
        list.push((symbol(arena), above.mul(&Polynomial::atom(over))));
        list
    }
}

/// `1/(1 + x + .. + x^(n - 1)) = (x - 1)/(x^n - 1)` of what is positive.
pub(super) fn over_powers(arena: &mut Arena, x: Expr, n: usize) -> Expr {
    let powers: Vec<_> = (0..n).map(|k| (arena.power(x, exponent(k)), Rational::ONE)).collect();
    let sum = arena.linear(&powers);
    // A sum of powers and one.
    arena.reciprocal(sum)
}

/// The symbol of `tr(G/D^2)/n`.
pub(super) fn mean_square(arena: &mut Arena) -> Expr {
    arena.symbol(Quantity::MeanSquare)
}
