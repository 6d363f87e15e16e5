//! Sums that are known by a name, found again in a polynomial.

use rustc_hash::FxHashMap;

use super::arena::Expr;
use super::polynomial::{Monomial, Polynomial};
use super::rational::Rational;

impl Polynomial {
    /// The polynomial with the name of every sum that it contains a multiple of; as it was where that makes it no shorter.
    /// A name may be a number: `(1, psi_1k phi_k1)` uses that the sum is 1. Where two products have met, a term may have
    /// more than the multiple needs of it.
    pub fn by_names(&self, names: &[(Self, Self)]) -> Self {
        let mut open: FxHashMap<Monomial, Rational> = FxHashMap::default();
        open.extend(self.terms().map(|(monomial, c)| (monomial.clone(), c.clone())));
        let mut result = Self::zero();
        for (name, sum) in names {
            let Some((first, _)) = sum.terms().next() else { continue };
            for factor in self.terms().filter_map(|(monomial, _)| without(monomial, first)) {
                if let Some(weight) = common(&open, &factor, sum) {
                    for (monomial, c) in sum.terms() {
                        take(&mut open, &product(&factor, monomial), &(c * &weight));
                    }
                    result.add_product(&Self::term(factor, weight), name, &Rational::ONE);
                }
            }
        }
        open.iter().for_each(|(monomial, c)| result.add_term(monomial.clone(), c));
        if result.length() < self.length() { result } else { self.clone() }
    }

    /// Factors and terms together.
    fn length(&self) -> usize {
        self.terms().map(|(monomial, _)| 1 + monomial.len()).sum()
    }

    /// What is left of it without a product of atoms; `None` where a term has not all of them.
    pub fn over(&self, monomial: &[Expr]) -> Option<Self> {
        let mut quotient = Self::zero();
        for (of_term, c) in self.terms() {
            quotient.add_term(without(of_term, monomial)?, c);
        }
        Some(quotient)
    }
}

/// A sorted monomial without some of its atoms; `None` where it has not all of them.
fn without(monomial: &[Expr], atoms: &[Expr]) -> Option<Vec<Expr>> {
    let mut rest = monomial.to_vec();
    for atom in atoms {
        let place = rest.iter().position(|known| known == atom)?;
        rest.remove(place);
    }
    Some(rest)
}

fn product(a: &Monomial, b: &Monomial) -> Monomial {
    let mut product = [a.as_slice(), b.as_slice()].concat();
    product.sort_unstable();
    product
}

/// The weight of `weight factor sum` in the terms. Most have it; one where two products have met may have more.
fn common(open: &FxHashMap<Monomial, Rational>, factor: &Monomial, sum: &Polynomial) -> Option<Rational> {
    let weight = |(monomial, c): (&Monomial, &Rational)| open.get(&product(factor, monomial))?.checked_div(c);
    let weights: Vec<Rational> = sum.terms().map(weight).collect::<Option<_>>()?;
    let least = weights.iter().min_by_key(|weight| weight.abs())?;
    let have_it = weights.iter().filter(|weight| *weight == least).count();
    let agree = weights.iter().all(|weight| weight.is_negative() == least.is_negative());
    (agree && 2 * have_it > weights.len()).then(|| least.clone())
}

fn take(open: &mut FxHashMap<Monomial, Rational>, monomial: &Monomial, weight: &Rational) {
    if let Some(held) = open.get_mut(monomial) {
        *held = &*held - weight;
        if held.is_zero() {
            open.remove(monomial);
        }
    }
}
