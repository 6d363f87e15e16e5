//! Exact division of polynomials, for common factors that no single atom is.

use std::cmp::Ordering;

use super::arena::Expr;
use super::fault::never_missing;
use super::polynomial::{Monomial, Polynomial};
use super::rational::Rational;

/// The product of powers of atoms that divides every term, and what is left.
pub fn content(polynomial: &Polynomial) -> (Monomial, Polynomial) {
    let mut common: Option<Monomial> = None;
    for (monomial, _) in polynomial.terms() {
        common = Some(match common {
            None => monomial.clone(),
            Some(known) => intersection(&known, monomial),
        });
    }
    let common = common.unwrap_or_default();
    let rest: Polynomial =
        polynomial.terms().map(|(monomial, c)| Polynomial::term(rest_of(monomial, &common), c.clone())).sum();
    (common, rest)
}

/// `dividend/divisor` where that is a polynomial.
pub fn quotient(dividend: &Polynomial, divisor: &Polynomial) -> Option<Polynomial> {
    let (lead, weight) = leading(divisor)?;
    let (mut rest, mut result) = (dividend.clone(), Polynomial::zero());
    while let Some((monomial, c)) = leading(&rest) {
        let term = Polynomial::term(divided(&monomial, &lead)?, c.checked_div(&weight)?);
        rest.add_product(&term, divisor, &Rational::MINUS_ONE);
        result.add_scaled(&term, &Rational::ONE);
    }
    Some(result)
}

/// The largest monomial by degree, then lexicographically by powers of the first atoms: an order that products keep.
fn leading(polynomial: &Polynomial) -> Option<(Monomial, Rational)> {
    let larger = |a: &Monomial, b: &Monomial| match a.len().cmp(&b.len()) {
        // Sorted: at the first difference the smaller atom has the higher power.
        Ordering::Equal => b.cmp(a),
        unequal => unequal,
    };
    polynomial.terms().max_by(|(a, _), (b, _)| larger(a, b)).map(|(m, c)| (m.clone(), c.clone()))
}

/// What is left of a monomial of a polynomial by what divides all of them.
fn rest_of(monomial: &[Expr], common: &[Expr]) -> Monomial {
    never_missing(divided(monomial, common), "a common factor divides every term", Monomial::new())
}

/// `monomial/divisor`; both are sorted.
fn divided(monomial: &[Expr], divisor: &[Expr]) -> Option<Monomial> {
    let mut rest = monomial.to_vec();
    for atom in divisor {
        rest.remove(rest.iter().position(|factor| factor == atom)?);
    }
    Some(rest)
}

fn intersection(a: &[Expr], b: &[Expr]) -> Monomial {
    let mut left = b.to_vec();
    let mut common = Vec::new();
    for atom in a {
        if let Some(at) = left.iter().position(|factor| factor == atom) {
            common.push(left.remove(at));
        }
    }
    common
}

#[cfg(test)]
mod tests {
    use super::{content, quotient};
    use crate::algebra::{Arena, Polynomial, Rational};
    use crate::symbol::Quantity;

    #[test]
    fn factors_are_found_and_others_are_not() {
        let mut arena = Arena::new();
        let [x, y, z] = [1, 2, 3].map(|k| Polynomial::atom(arena.symbol(Quantity::Position.at([k]))));
        let sum = |a: &Polynomial, b: &Polynomial, weight: i64| {
            let mut sum = a.clone();
            sum.add_scaled(b, &Rational::from(weight));
            sum
        };
        let (first, second) = (sum(&x.mul(&x), &y.mul(&z), 2), sum(&x.mul(&z), &y, -3));
        let product = first.mul(&second).scaled(&Rational::from(5));
        assert_eq!(quotient(&product, &first), Some(second.scaled(&Rational::from(5))));
        assert_eq!(quotient(&product, &second), Some(first.scaled(&Rational::from(5))));
        assert_eq!(quotient(&sum(&product, &x, 1), &first), None);
        assert_eq!(quotient(&product, &Polynomial::zero()), None);
        let (common, rest) = content(&x.mul(&y).mul(&sum(&y, &z, 1)));
        assert_eq!(Polynomial::monomial(common), x.mul(&y));
        assert_eq!(rest, sum(&y, &z, 1));
    }
}
