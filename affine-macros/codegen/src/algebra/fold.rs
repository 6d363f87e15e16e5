//! Sums that are known by a name, found again in a polynomial.

use super::arena::Expr;
use super::polynomial::Polynomial;
use super::rational::Rational;

impl Polynomial {
    /// The polynomial with `value` for `sum`, wherever all terms of the sum stand in it with one factor; `None` where they do
    /// not.
    #[must_use]
    pub fn folded(&self, sum: &Self, value: &Self) -> Option<Self> {
        let (lead, of_lead) = sum.terms().next()?;
        let mut folded: Option<Self> = None;
        for (monomial, c) in self.terms() {
            let Some(rest) = without(monomial, lead) else { continue };
            let Some(weight) = of_lead.recip().map(|reciprocal| c * &reciprocal) else { continue };
            let factor = Self::term(rest, weight);
            let known = folded.as_ref().unwrap_or(self);
            if known.has_all_of(&factor.mul(sum)) {
                let mut shorter = known.clone();
                shorter.add_product(&factor, sum, &Rational::MINUS_ONE);
                shorter.add_product(&factor, value, &Rational::ONE);
                folded = Some(shorter);
            }
        }
        folded
    }

    /// What is left of it without a product of atoms; `None` where a term has not all of them.
    #[must_use]
    pub fn over(&self, monomial: &[Expr]) -> Option<Self> {
        let mut quotient = Self::zero();
        for (of_term, c) in self.terms() {
            quotient.add_term(without(of_term, monomial)?, c);
        }
        Some(quotient)
    }

    /// Are these terms among its terms?
    fn has_all_of(&self, part: &Self) -> bool {
        part.terms().all(|term| self.terms().any(|own| own == term))
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
