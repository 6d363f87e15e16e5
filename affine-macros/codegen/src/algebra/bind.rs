//! Binding times: what does not change along a trajectory is computed once, before it starts.

use std::collections::BTreeMap;

use super::arena::{Arena, Expr, Node};
use super::polynomial::{Monomial, Polynomial};
use super::rational::Rational;
use crate::symbol::Quantity;

/// Named constants that stand for polynomials in slower quantities.
#[derive(Clone, Debug)]
pub struct Constants {
    of: Quantity,
    /// Symbols and their definitions, each once up to sign.
    pub entries: Vec<(Expr, Polynomial)>,
}

impl Constants {
    /// No constants yet; they will be the components 1, 2, ... of a quantity.
    pub fn new(of: Quantity) -> Self {
        Self { of, entries: Vec::new() }
    }

    /// Is the symbol one of these constants?
    pub fn contains(&self, symbol: Expr) -> bool {
        self.entries.iter().any(|(s, _)| *s == symbol)
    }

    /// Collects every polynomial in the atoms that vary; what multiplies them becomes a number or a constant.
    pub fn bind(
        &mut self,
        arena: &mut Arena,
        polynomial: &Polynomial,
        varies: &impl Fn(Expr) -> bool,
    ) -> Polynomial {
        let mut collected: BTreeMap<Monomial, Polynomial> = BTreeMap::new();
        for (monomial, c) in polynomial.terms() {
            let (moving, fixed): (Monomial, Monomial) = monomial.iter().partition(|atom| varies(**atom));
            collected.entry(moving).or_default().add_term(fixed, c);
        }
        let mut bound = Polynomial::zero();
        for (mut monomial, coefficient) in collected {
            let number = match coefficient.as_constant() {
                Some(number) => number,
                None => {
                    let (symbol, sign) = self.symbol(arena, coefficient);
                    monomial.push(symbol);
                    sign
                }
            };
            bound.add_term(monomial, &number);
        }
        bound
    }

    /// Collects inside functions and reciprocals of what varies: `exp(a b q)` becomes `exp(c q)`.
    pub fn bind_inside(
        &mut self,
        arena: &mut Arena,
        polynomial: &Polynomial,
        varies: &impl Fn(Expr) -> bool,
    ) -> Polynomial {
        if !polynomial.mentions(|atom| arena.as_symbol(atom).is_none()) {
            return polynomial.clone();
        }
        let mut bound = Polynomial::zero();
        for (monomial, c) in polynomial.terms() {
            let atoms: Vec<Expr> = monomial.iter().map(|atom| self.bind_atom(arena, *atom, varies)).collect();
            let mut product = Polynomial::constant(c.clone());
            for atom in atoms {
                product = product.mul(&Polynomial::normal_form(arena, atom));
            }
            bound.add_scaled(&product, &Rational::ONE);
        }
        bound
    }

    fn bind_atom(&mut self, arena: &mut Arena, atom: Expr, varies: &impl Fn(Expr) -> bool) -> Expr {
        let slow =
            |arena: &Arena, below: Expr| !varies(below) && !arena.any_symbol(below, &mut |s| varies(s));
        if arena.as_symbol(atom).is_some() || slow(arena, atom) {
            return atom;
        }
        let mut inner = |arena: &mut Arena, below: Expr| {
            let form = Polynomial::normal_form(arena, below);
            let form = self.bind_inside(arena, &form, varies);
            let varying = |a: Expr| !slow(arena, a);
            let fast: Vec<Expr> = form
                .terms()
                .flat_map(|(monomial, _)| monomial.iter().copied())
                .filter(|a| varying(*a))
                .collect();
            self.bind(arena, &form, &|a| fast.contains(&a)).expression(arena)
        };
        match arena.node(atom).clone() {
            Node::Function(function, argument) => {
                let argument = inner(arena, argument);
                arena.apply(function, argument)
            }
            Node::Product(factors) => {
                let factors: Vec<(Expr, i32)> = factors.iter().map(|(b, e)| (inner(arena, *b), *e)).collect();
                // A base that varies is not the number zero.
                arena.certain_product(&factors)
            }
            _ => atom,
        }
    }

    /// The constant of a polynomial, and the sign that restores it.
    fn symbol(&mut self, arena: &mut Arena, value: Polynomial) -> (Expr, Rational) {
        let negative = value.terms().next().is_some_and(|(_, c)| c.is_negative());
        let sign = if negative { Rational::MINUS_ONE } else { Rational::ONE };
        let value = value.scaled(&sign);
        if let Some((symbol, _)) = self.entries.iter().find(|(_, known)| *known == value) {
            return (*symbol, sign);
        }
        let symbol = arena.symbol(self.of.at([self.entries.len() + 1]));
        self.entries.push((symbol, value));
        (symbol, sign)
    }
}
