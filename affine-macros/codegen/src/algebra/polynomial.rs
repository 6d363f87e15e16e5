//! Polynomial normal form: the decision procedure behind every cancellation.
//!
//! Indeterminates are atoms of the arena: symbols and reciprocals of what is not a product. Two polynomials are
//! equal as functions of independent atoms exactly when they are equal as values.

use std::cmp::Ordering;
use std::iter::Sum;

use super::arena::{Arena, Expr, Node};
use super::fault::never_missing;
use super::function::Function;
use super::rational::Rational;
use super::work;

/// Products of so many terms are sorted once, instead of put one by one where they belong.
const COLLECTED: usize = 64;

/// A product of atoms, sorted, a power repeated.
pub type Monomial = Vec<Expr>;

/// A polynomial in atoms with rational coefficients; no zero coefficient is stored.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[must_use]
pub struct Polynomial {
    /// In canonical order. A list and no tree, since the macro runs unoptimised in its users' builds, where a tree of few
    /// terms costs several times as much.
    terms: Vec<(Monomial, Rational)>,
}

impl Polynomial {
    /// The polynomial without terms, 0.
    pub fn zero() -> Self {
        Self::default()
    }

    /// The constant polynomial of a number.
    pub fn constant(value: Rational) -> Self {
        Self::term(Vec::new(), value)
    }

    /// The polynomial of a single atom.
    pub fn atom(atom: Expr) -> Self {
        Self::term(vec![atom], Rational::ONE)
    }

    /// The polynomials of some atoms.
    pub fn vector(atoms: &[Expr]) -> Vec<Self> {
        atoms.iter().map(|atom| Self::atom(*atom)).collect()
    }

    /// `coefficient * monomial`; the monomial is sorted.
    pub fn term(monomial: Monomial, coefficient: Rational) -> Self {
        let mut result = Self::zero();
        result.add_term(monomial, &coefficient);
        result
    }

    /// The product of some atoms.
    pub fn monomial(atoms: impl Into<Monomial>) -> Self {
        Self::term(atoms.into(), Rational::ONE)
    }

    /// The normal form of `1/expr`; `None` of the number zero.
    pub fn reciprocal(arena: &mut Arena, expr: Expr) -> Option<Self> {
        let reciprocal = arena.pow(expr, -1)?;
        Some(Self::normal_form(arena, reciprocal))
    }

    /// The normal form of an expression.
    pub fn normal_form(arena: &mut Arena, expr: Expr) -> Self {
        match arena.node(expr).clone() {
            Node::Constant(value) => Self::constant(value),
            Node::Symbol(_) => Self::atom(expr),
            Node::Function(function, argument) => {
                let argument = Self::normal_form(arena, argument).expression(arena);
                Self::of_value(arena, function, argument)
            }
            Node::Sum(constant, terms) => {
                let mut sum = Self::constant(constant);
                for (term, c) in terms {
                    sum.add_scaled(&Self::normal_form(arena, term), &c);
                }
                sum
            }
            Node::Product(factors) => {
                let mut product = Self::constant(Rational::ONE);
                for (base, exponent) in factors {
                    let factor = match exponent {
                        1.. => Self::normal_form(arena, base),
                        // A canonical base is never the number zero, so its reciprocal exists.
                        _ => Self::atom(arena.reciprocal(base)),
                    };
                    for _ in 0..exponent.unsigned_abs() {
                        product = product.mul(&factor);
                    }
                }
                product
            }
        }
    }

    /// The polynomial that a function of an expression is: an atom, its opposite, or a number.
    fn of_value(arena: &mut Arena, function: Function, argument: Expr) -> Self {
        let value = arena.apply(function, argument);
        match arena.node(value).clone() {
            Node::Function(..) | Node::Symbol(_) => Self::atom(value),
            // A function of the opposite argument, or what an inverse function left.
            _ => Self::normal_form(arena, value),
        }
    }

    /// The polynomial as an expression.
    pub fn expression(&self, arena: &mut Arena) -> Expr {
        let summands: Vec<_> = self
            .terms
            .iter()
            .map(|(monomial, c)| {
                let factors: Vec<_> = monomial.iter().map(|atom| (*atom, 1)).collect();
                // Only first powers of atoms: no division.
                (arena.certain_product(&factors), c.clone())
            })
            .collect();
        arena.linear(&summands)
    }

    /// Monomials with their coefficients, in canonical order.
    pub fn terms(&self) -> impl ExactSizeIterator<Item = (&Monomial, &Rational)> + Clone {
        self.terms.iter().map(|(monomial, c)| (monomial, c))
    }

    /// No terms?
    pub fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    /// The number it is, if it is one.
    pub fn as_constant(&self) -> Option<Rational> {
        match self.terms.as_slice() {
            [] => Some(Rational::ZERO),
            [(monomial, c)] if monomial.is_empty() => Some(c.clone()),
            _ => None,
        }
    }

    /// The atom that it is, with nothing beside it.
    pub fn as_atom(&self) -> Option<Expr> {
        match self.terms.as_slice() {
            [(monomial, c)] if c.is_one() && monomial.len() == 1 => monomial.first().copied(),
            _ => None,
        }
    }

    /// Adds `coefficient * monomial`.
    pub fn add_term(&mut self, mut monomial: Monomial, coefficient: &Rational) {
        if coefficient.is_zero() {
            return;
        }
        // Nearly every monomial arrives sorted, and the macro runs unoptimised.
        let mut k = 1;
        while k < monomial.len() {
            if monomial[k - 1] > monomial[k] {
                monomial.sort_unstable();
                break;
            }
            k += 1;
        }
        match self.place(&monomial) {
            Err(place) => self.terms.insert(place, (monomial, coefficient.clone())),
            Ok(place) => {
                let held = &mut self.terms[place].1;
                *held = &*held + coefficient;
                if held.is_zero() {
                    self.terms.remove(place);
                }
            }
        }
    }

    /// Where a monomial stands, or where it is to be put. Most arrive in order, behind all others.
    fn place(&self, monomial: &[Expr]) -> Result<usize, usize> {
        let (mut low, mut high) = (0, self.terms.len());
        let mut middle = high.saturating_sub(1);
        while low < high {
            match compared(&self.terms[middle].0, monomial) {
                Ordering::Less => low = middle + 1,
                Ordering::Equal => return Ok(middle),
                Ordering::Greater => high = middle,
            }
            middle = usize::midpoint(low, high);
        }
        Err(low)
    }

    /// Adds `weight * other`.
    pub fn add_scaled(&mut self, other: &Self, weight: &Rational) {
        for (monomial, c) in &other.terms {
            self.add_term(monomial.clone(), &(c * weight));
        }
    }

    /// Adds `left * right`.
    pub fn add_product(&mut self, left: &Self, right: &Self, weight: &Rational) {
        let count = left.terms.len() * right.terms.len();
        work::add(count);
        let mut products = Vec::with_capacity(if count < COLLECTED { 0 } else { count });
        for (m1, c1) in &left.terms {
            let c1 = c1 * weight;
            for (m2, c2) in &right.terms {
                match count < COLLECTED {
                    true => self.add_term(merged(m1, m2), &(&c1 * c2)),
                    false => products.push((merged(m1, m2), &c1 * c2)),
                }
            }
        }
        self.collect(products);
    }

    /// Adds many terms at once.
    fn collect(&mut self, mut terms: Vec<(Monomial, Rational)>) {
        if terms.is_empty() {
            return;
        }
        terms.append(&mut self.terms);
        terms.sort_by(|(a, _), (b, _)| compared(a, b));
        for (monomial, c) in terms {
            match self.terms.last_mut() {
                Some((last, sum)) if *last == monomial => *sum = &*sum + &c,
                last => {
                    let cancelled = last.is_some_and(|(_, sum)| sum.is_zero());
                    if cancelled {
                        self.terms.pop();
                    }
                    self.terms.push((monomial, c));
                }
            }
        }
        if self.terms.last().is_some_and(|(_, sum)| sum.is_zero()) {
            self.terms.pop();
        }
    }

    /// `self * other`.
    pub fn mul(&self, other: &Self) -> Self {
        let mut result = Self::zero();
        result.add_product(self, other, &Rational::ONE);
        result
    }

    /// `self + other`.
    pub fn add(&self, other: &Self) -> Self {
        let mut result = self.clone();
        result.add_scaled(other, &Rational::ONE);
        result
    }

    /// `self - other`.
    pub fn sub(&self, other: &Self) -> Self {
        let mut result = self.clone();
        result.add_scaled(other, &Rational::MINUS_ONE);
        result
    }

    /// `-self`.
    pub fn neg(&self) -> Self {
        self.scaled(&Rational::MINUS_ONE)
    }

    /// `weight * self`.
    pub fn scaled(&self, weight: &Rational) -> Self {
        let mut result = Self::zero();
        result.add_scaled(self, weight);
        result
    }

    /// Derivative with respect to an atom.
    pub fn derivative(&self, atom: Expr) -> Self {
        never_missing(self.gradient(&[atom]).pop(), "one atom has one derivative", Self::zero())
    }

    /// Derivatives with respect to several atoms, in one pass.
    pub fn gradient(&self, atoms: &[Expr]) -> Vec<Self> {
        let mut slopes = vec![Self::zero(); atoms.len()];
        for (monomial, c) in &self.terms {
            let mut at = 0;
            while at < monomial.len() {
                let power = monomial[at..].iter().take_while(|a| **a == monomial[at]).count();
                if let Some(k) = atoms.iter().position(|atom| *atom == monomial[at]) {
                    let mut rest = monomial.clone();
                    rest.remove(at);
                    // Degrees are tiny.
                    let weight = Rational::whole(power);
                    slopes[k].add_term(rest, &(c * &weight));
                }
                at += power;
            }
        }
        slopes
    }

    /// The second derivatives by some atoms.
    pub fn hessian(&self, atoms: &[Expr]) -> Vec<Vec<Self>> {
        self.gradient(atoms).iter().map(|slope| slope.gradient(atoms)).collect()
    }

    /// Replaces atoms by polynomials.
    pub fn substitute(&self, value: &impl Fn(Expr) -> Option<Polynomial>) -> Self {
        let mut result = Self::zero();
        for (monomial, c) in &self.terms {
            let mut kept = Vec::new();
            let mut product: Option<Polynomial> = None;
            for atom in monomial {
                match value(*atom) {
                    None => kept.push(*atom),
                    Some(p) => product = Some(product.map_or_else(|| p.clone(), |q| q.mul(&p))),
                }
            }
            match product {
                None => result.add_term(kept, c),
                Some(p) => result.add_product(&Self::term(kept, c.clone()), &p, &Rational::ONE),
            }
        }
        result
    }

    /// The atoms of all terms, as often as they stand there.
    pub fn atoms(&self) -> impl Iterator<Item = &Expr> {
        self.terms.iter().flat_map(|(monomial, _)| monomial)
    }

    /// Does any symbol in its atoms, inside functions and reciprocals too, satisfy `wanted`?
    pub fn any_symbol(&self, arena: &Arena, wanted: &mut impl FnMut(Expr) -> bool) -> bool {
        self.atoms().any(|atom| arena.any_symbol(*atom, wanted))
    }

    /// Does any term contain an atom for which `wanted` holds?
    pub fn mentions(&self, mut wanted: impl FnMut(Expr) -> bool) -> bool {
        self.atoms().any(|atom| wanted(*atom))
    }
}

/// Adds to what a list has for a key.
pub fn add_to<K: PartialEq>(list: &mut Vec<(K, Polynomial)>, key: K, summand: &Polynomial) {
    match list.iter_mut().find(|(known, _)| *known == key) {
        Some((_, sum)) => sum.add_scaled(summand, &Rational::ONE),
        None => list.push((key, summand.clone())),
    }
}

impl Sum for Polynomial {
    fn sum<I: Iterator<Item = Self>>(summands: I) -> Self {
        let mut sum = Self::zero();
        for summand in summands {
            if sum.is_zero() {
                sum = summand;
            } else if summand.terms.len() < COLLECTED {
                summand.terms.into_iter().for_each(|(monomial, c)| sum.add_term(monomial, &c));
            } else {
                sum.collect(summand.terms);
            }
        }
        sum
    }
}

impl<'a> Sum<&'a Polynomial> for Polynomial {
    fn sum<I: Iterator<Item = &'a Self>>(summands: I) -> Self {
        summands.cloned().sum()
    }
}

/// The order of slices, written out for builds without optimisation.
fn compared(a: &[Expr], b: &[Expr]) -> Ordering {
    let mut k = 0;
    while k < a.len() && k < b.len() {
        if a[k] != b[k] {
            return a[k].cmp(&b[k]);
        }
        k += 1;
    }
    a.len().cmp(&b.len())
}

/// The product of two monomials.
fn merged(a: &[Expr], b: &[Expr]) -> Monomial {
    let mut product = Vec::with_capacity(a.len() + b.len());
    let (mut i, mut j) = (0, 0);
    while i < a.len() || j < b.len() {
        if j == b.len() || (i < a.len() && a[i] <= b[j]) {
            product.push(a[i]);
            i += 1;
        } else {
            product.push(b[j]);
            j += 1;
        }
    }
    product
}
