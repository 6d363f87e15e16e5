//! Factored forms of polynomials: fewer operations for the same value.

use crate::symbol::Quantity;
use std::collections::BTreeMap;

use super::arena::{Arena, Expr};
use super::polynomial::{Monomial, Polynomial};
use super::rational::Rational;

/// Completes sums that several linear forms nearly share: in `c x + d y + d z` and `d x + c y + d z` the sum
/// `x + y + z` is formed once, as in `O = X/alpha + (tr X/beta) 1`. Returns the sums with their definitions.
pub fn complete_sums(
    arena: &mut Arena,
    polynomials: &mut [Polynomial],
    varies: &impl Fn(Expr) -> bool,
) -> Vec<(Expr, Polynomial)> {
    let nearly: Vec<Option<NearlySum>> = polynomials.iter().map(|p| NearlySum::of(p, varies)).collect();
    let mut sums: Vec<(Vec<Expr>, Expr)> = Vec::new();
    for form in nearly.iter().flatten() {
        let sharing = nearly.iter().flatten().filter(|other| other.atoms == form.atoms).count();
        if sharing > 1 && !sums.iter().any(|(atoms, _)| *atoms == form.atoms) {
            let symbol = arena.symbol(Quantity::SharedSum.at([sums.len() + 1]));
            sums.push((form.atoms.clone(), symbol));
        }
    }
    for (polynomial, form) in polynomials.iter_mut().zip(nearly) {
        let Some(form) = form else { continue };
        if let Some((_, symbol)) = sums.iter().find(|(atoms, _)| *atoms == form.atoms) {
            let mut completed = form.common.mul(&Polynomial::atom(*symbol));
            completed.add_product(&form.excess, &Polynomial::atom(form.odd), &Rational::ONE);
            *polynomial = completed;
        }
    }
    let total = |atoms: &Vec<Expr>| atoms.iter().map(|atom| Polynomial::monomial([*atom])).sum();
    sums.iter().map(|(atoms, symbol)| (*symbol, total(atoms))).collect()
}

/// A linear form in at least three atoms with one coefficient for all but one of them.
struct NearlySum {
    atoms: Vec<Expr>,
    odd: Expr,
    common: Polynomial,
    /// The odd coefficient less the common one.
    excess: Polynomial,
}

impl NearlySum {
    fn of(polynomial: &Polynomial, varies: &impl Fn(Expr) -> bool) -> Option<Self> {
        let mut coefficients: BTreeMap<Expr, Polynomial> = BTreeMap::new();
        for (monomial, c) in polynomial.terms() {
            let (moving, fixed): (Monomial, Monomial) = monomial.iter().partition(|atom| varies(**atom));
            let [atom] = moving.as_slice() else { return None };
            coefficients.entry(*atom).or_default().add_term(fixed, c);
        }
        let (odd, coefficient) = coefficients
            .iter()
            .find(|(_, c)| coefficients.values().filter(|other| other == c).count() == 1)?;
        let mut others = coefficients.iter().filter(|(atom, _)| *atom != odd).map(|(_, c)| c);
        let common = others.next()?.clone();
        if coefficients.len() < 3 || others.any(|c| *c != common) {
            return None;
        }
        let mut excess = coefficient.clone();
        excess.add_scaled(&common, &Rational::MINUS_ONE);
        Some(Self { odd: *odd, common, excess, atoms: coefficients.into_keys().collect() })
    }
}

/// A factor that does not vary: a positive number and constant atoms.
type Weight = (Rational, Monomial);

/// Scales varying atoms by constants once, where a constant multiplies many products of few of them:
/// `c a x + c b x + c d x` costs three multiplications by `c`, and one as `(c x) (a + b + d)` in any number of
/// polynomials. Returns the scaled atoms with their definitions.
pub fn scale_atoms(
    arena: &mut Arena,
    polynomials: &mut [Polynomial],
    varies: &impl Fn(Expr) -> bool,
) -> Vec<(Expr, Polynomial)> {
    let mut uses: BTreeMap<Weight, Vec<(usize, Monomial)>> = BTreeMap::new();
    for (k, polynomial) in polynomials.iter().enumerate() {
        for (monomial, c) in polynomial.terms() {
            let (weight, moving) = split(monomial, c, varies);
            if weight != (Rational::ONE, Vec::new()) && !moving.is_empty() {
                uses.entry(weight).or_default().push((k, moving));
            }
        }
    }
    let mut scaled = Vec::new();
    let mut symbols: BTreeMap<Weight, Vec<(Expr, Expr)>> = BTreeMap::new();
    for (weight, places) in uses {
        let mut hosts: Vec<usize> = places.iter().map(|(k, _)| *k).collect();
        hosts.dedup();
        let cover = cover(places.iter().map(|(_, m)| m));
        if cover.len() >= hosts.len() {
            continue;
        }
        for atom in &cover {
            let (number, constants) = &weight;
            let mut product = constants.clone();
            product.push(*atom);
            let symbol = arena.symbol(Quantity::Scaled.at([scaled.len() + 1]));
            scaled.push((symbol, Polynomial::term(product, number.clone())));
            symbols.entry(weight.clone()).or_default().push((*atom, symbol));
        }
    }
    if !symbols.is_empty() {
        for polynomial in polynomials.iter_mut() {
            *polynomial = replace_scaled(polynomial, &symbols, varies);
        }
    }
    scaled
}

/// Constant and varying part of a term.
fn split(monomial: &Monomial, c: &Rational, varies: &impl Fn(Expr) -> bool) -> (Weight, Monomial) {
    let (moving, fixed): (Monomial, Monomial) = monomial.iter().partition(|atom| varies(**atom));
    ((c.abs(), fixed), moving)
}

/// Few atoms such that every monomial contains one, greedily by frequency.
fn cover<'a>(monomials: impl Iterator<Item = &'a Monomial>) -> Vec<Expr> {
    let mut open: Vec<&Monomial> = monomials.collect();
    let mut chosen = Vec::new();
    while !open.is_empty() {
        let Some(best) = most_frequent(open.iter().copied()).map(|(atom, _)| atom) else { break };
        open.retain(|m| !m.contains(&best));
        chosen.push(best);
    }
    chosen
}

/// The atom that occurs in most monomials, the first of several, with its count.
fn most_frequent<'a>(monomials: impl Iterator<Item = &'a Monomial>) -> Option<(Expr, usize)> {
    let mut counts: BTreeMap<Expr, usize> = BTreeMap::new();
    for monomial in monomials {
        let mut last = None;
        for atom in monomial {
            if last != Some(atom) {
                *counts.entry(*atom).or_default() += 1;
            }
            last = Some(atom);
        }
    }
    counts.into_iter().max_by_key(|(atom, count)| (*count, std::cmp::Reverse(*atom)))
}

/// Writes the scaled symbol for `weight * atom` in every term with such a weight, the first atom of its list that
/// the term contains.
fn replace_scaled(
    polynomial: &Polynomial,
    symbols: &BTreeMap<Weight, Vec<(Expr, Expr)>>,
    varies: &impl Fn(Expr) -> bool,
) -> Polynomial {
    let mut result = Polynomial::zero();
    for (monomial, c) in polynomial.terms() {
        let (weight, mut moving) = split(monomial, c, varies);
        let replaced = symbols.get(&weight).and_then(|list| {
            list.iter().find_map(|(atom, symbol)| {
                moving.iter().position(|a| a == atom).map(|place| (place, *symbol))
            })
        });
        match replaced {
            Some((place, symbol)) => {
                moving[place] = symbol;
                let sign = if c.is_negative() { Rational::MINUS_ONE } else { Rational::ONE };
                result.add_term(moving, &sign);
            }
            None => result.add_term(monomial.clone(), c),
        }
    }
    result
}

/// Which factor is taken out of a polynomial first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum First {
    /// The most frequent atom.
    Atom,
    /// A number that all terms have.
    Number,
}

/// A number other than one that all terms of a polynomial have, two or more.
pub fn number_of_all(polynomial: &Polynomial) -> Option<Rational> {
    let mut terms = polynomial.terms();
    let number = terms.next()?.1.abs();
    let is_shared = terms.len() > 0 && terms.all(|(_, c)| c.abs() == number);
    (is_shared && !number.is_one()).then_some(number)
}

/// A factored expression of a polynomial: nested by the most frequent atom, then by common numbers.
pub fn factored(arena: &mut Arena, polynomial: &Polynomial, first: First) -> Expr {
    if first == First::Number
        && let Some(number) = number_of_all(polynomial)
        && let Some(inverse) = number.recip()
    {
        let times = |arena: &mut Arena, inner| arena.scale(inner, &number);
        return distribute(arena, times, (&polynomial.scaled(&inverse), &Polynomial::zero()), first);
    }
    let frequent = most_frequent(polynomial.terms().map(|(m, _)| m)).filter(|(_, count)| *count > 1);
    if let Some((atom, _)) = frequent {
        let (mut quotient, mut rest) = (Polynomial::zero(), Polynomial::zero());
        for (monomial, c) in polynomial.terms() {
            match monomial.iter().position(|a| *a == atom) {
                Some(at) => {
                    let mut lower = monomial.clone();
                    lower.remove(at);
                    quotient.add_term(lower, c);
                }
                None => rest.add_term(monomial.clone(), c),
            }
        }
        return distribute(arena, |arena, inner| arena.mul(atom, inner), (&quotient, &rest), first);
    }
    if let Some(number) = common_number(polynomial) {
        let (mut quotient, mut rest) = (Polynomial::zero(), Polynomial::zero());
        for (monomial, c) in polynomial.terms() {
            if c.abs() == number {
                let sign = if c.is_negative() { Rational::MINUS_ONE } else { Rational::ONE };
                quotient.add_term(monomial.clone(), &sign);
            } else {
                rest.add_term(monomial.clone(), c);
            }
        }
        return distribute(arena, |arena, inner| arena.scale(inner, &number), (&quotient, &rest), first);
    }
    polynomial.expression(arena)
}

/// `times(quotient) + rest`, the quotient with a positive leading coefficient so that `a - b` and `b - a` share.
fn distribute(
    arena: &mut Arena,
    times: impl Fn(&mut Arena, Expr) -> Expr,
    (quotient, rest): (&Polynomial, &Polynomial),
    first: First,
) -> Expr {
    let negative = quotient.terms().next().is_some_and(|(_, c)| c.is_negative());
    let sign = if negative { Rational::MINUS_ONE } else { Rational::ONE };
    let inner = factored(arena, &quotient.scaled(&sign), first);
    let product = times(arena, inner);
    let rest = factored(arena, rest, first);
    arena.linear(&[(product, sign), (rest, Rational::ONE)])
}

/// A number other than one that multiplies at least two terms.
fn common_number(polynomial: &Polynomial) -> Option<Rational> {
    let mut seen: Vec<Rational> = Vec::new();
    for (_, c) in polynomial.terms() {
        let size = c.abs();
        if size.is_one() {
            continue;
        }
        if seen.contains(&size) {
            return Some(size);
        }
        seen.push(size);
    }
    None
}
