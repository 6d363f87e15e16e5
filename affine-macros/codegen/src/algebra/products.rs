//! Products that several polynomials share.

use crate::symbol::Quantity;
use std::collections::BTreeMap;

use super::arena::{Arena, Expr};
use super::polynomial::Polynomial;
use super::rational::Rational;

/// Polynomials with more pairs of atoms in their terms are not looked through: high powers have very many, and what is shared in
/// long sums, factoring finds.
const MOST_PAIRS: usize = 8000;

/// Names products of two atoms that stand in terms of several polynomials, the most frequent first, as long as there are any:
/// `a b x + c` and `a b y` form `a b` once. Returns the products with their definitions.
pub fn share_products(arena: &mut Arena, polynomials: &mut [Polynomial]) -> Vec<(Expr, Polynomial)> {
    let mut shared = Vec::new();
    let pairs = |atoms: usize| atoms * atoms.saturating_sub(1) / 2;
    let terms = polynomials.iter().flat_map(Polynomial::terms);
    if terms.map(|(monomial, _)| pairs(monomial.len())).sum::<usize>() > MOST_PAIRS {
        return shared;
    }
    while let Some((left, right)) = most_shared(polynomials) {
        let symbol = arena.symbol(Quantity::SharedProduct.at([shared.len() + 1]));
        let product = Polynomial::monomial([left, right]);
        for polynomial in polynomials.iter_mut() {
            let mut replaced = Polynomial::zero();
            for (monomial, c) in polynomial.terms() {
                let term = Polynomial::term(monomial.clone(), c.clone());
                let over = (monomial.len() > 2).then(|| term.over(&[left, right])).flatten();
                let term = over.map_or(term, |over| over.mul(&Polynomial::atom(symbol)));
                replaced.add_scaled(&term, &Rational::ONE);
            }
            *polynomial = replaced;
        }
        shared.push((symbol, product));
    }
    shared
}

/// The pair of atoms that most polynomials have in a term with a further atom, if more than one has.
fn most_shared(polynomials: &[Polynomial]) -> Option<(Expr, Expr)> {
    let mut counts: BTreeMap<(Expr, Expr), usize> = BTreeMap::new();
    for polynomial in polynomials {
        let mut pairs = Vec::new();
        for (monomial, _) in polynomial.terms().filter(|(monomial, _)| monomial.len() > 2) {
            for (k, left) in monomial.iter().enumerate() {
                pairs.extend(monomial[k + 1..].iter().map(|right| (*left, *right)));
            }
        }
        pairs.sort_unstable();
        pairs.dedup();
        pairs.into_iter().for_each(|pair| *counts.entry(pair).or_default() += 1);
    }
    let most = counts.into_iter().max_by_key(|(pair, count)| (*count, std::cmp::Reverse(*pair)))?;
    (most.1 > 1).then_some(most.0)
}
