//! Differences from the undeformed state `phi = 1`: what cancels there is taken apart before it is computed.
//!
//! Every quantity is its value at `phi = 1` and a change, of which the second is computed from the strains alone. The values are
//! exact, so that they go away where a sum of them is zero.

use std::collections::HashMap;

use crate::algebra::arena::Node;
use crate::algebra::polynomial::add_to;
use crate::algebra::{Arena, Expr, Function, Polynomial, Rational};

/// A quantity as its value at `phi = 1` and its difference from that.
#[derive(Clone, Debug)]
pub(super) struct Counted {
    /// Of what does not move with the placement: numbers, fields, the position, the time.
    pub(super) at_rest: Polynomial,
    /// Small where the strains are.
    pub(super) change: Polynomial,
}

impl Counted {
    /// A number and a change.
    pub(super) fn from(number: impl Into<Rational>, change: Polynomial) -> Self {
        Self { at_rest: Polynomial::constant(number.into()), change }
    }

    /// What the placement does not change.
    pub(super) fn constant(of: Polynomial) -> Self {
        Self { at_rest: of, change: Polynomial::zero() }
    }

    fn vanishes(&self) -> bool {
        self.at_rest.is_zero()
    }

    fn is_constant(&self) -> bool {
        self.change.is_zero()
    }
}

/// The quantities of a potential, counted from the undeformed state.
#[derive(Default)]
pub(super) struct Undeformed {
    known: HashMap<Expr, Counted>,
    /// In the order of telescoping: changes of the last are the last resort.
    rank: HashMap<Expr, usize>,
}

impl Undeformed {
    /// Symbols with what is known of them: those whose changes cost least come first, those whose cost most come last.
    pub(super) fn new(first: Vec<(Expr, Counted)>, last: Vec<(Expr, Counted)>) -> Self {
        let mut rank: HashMap<Expr, usize> = HashMap::new();
        rank.extend(first.iter().enumerate().map(|(k, (symbol, _))| (*symbol, k)));
        // Functions stand between them.
        rank.extend(last.iter().map(|(symbol, _)| (*symbol, usize::MAX)));
        Self { known: first.into_iter().chain(last).collect(), rank }
    }

    /// One more symbol.
    pub(super) fn know(&mut self, symbol: Expr, counted: Counted) {
        self.known.insert(symbol, counted);
    }

    /// The exponentials that were met.
    pub(super) fn exponentials(&self, arena: &Arena) -> Vec<(Expr, Counted)> {
        let is_exponential = |atom: Expr| matches!(arena.node(atom), Node::Function(Function::Exp, _));
        let met =
            self.known.iter().filter(|(atom, counted)| is_exponential(**atom) && !counted.is_constant());
        let mut met: Vec<_> = met.map(|(atom, counted)| (*atom, counted.clone())).collect();
        met.sort_unstable_by_key(|(atom, _)| *atom);
        met
    }

    /// The polynomial with its changes in place of sums that vanish at `phi = 1`, factor by factor of what vanishes by itself.
    pub(super) fn counted(&mut self, arena: &mut Arena, form: &Polynomial) -> Polynomial {
        let form = self.without_vanishing_functions(arena, form);
        let mut groups: Vec<(Vec<Expr>, Polynomial)> = Vec::new();
        for (monomial, c) in form.terms() {
            let (small, rest): (Vec<Expr>, Vec<Expr>) =
                monomial.iter().partition(|atom| self.atom(arena, **atom).vanishes());
            add_to(&mut groups, small, &Polynomial::term(rest, c.clone()));
        }
        let mut result = Polynomial::zero();
        for (small, sum) in groups {
            let sum = if self.at_rest(arena, &sum).is_zero() { self.of(arena, &sum).change } else { sum };
            result.add_product(&Polynomial::monomial(small), &sum, &Rational::ONE);
        }
        result
    }

    /// The value at `phi = 1` alone: changes of high powers are long.
    fn at_rest(&mut self, arena: &mut Arena, form: &Polynomial) -> Polynomial {
        let mut sum = Polynomial::zero();
        for (monomial, c) in form.terms() {
            let factors = self.telescoped(monomial).into_iter();
            let one = Polynomial::constant(Rational::ONE);
            sum.add_scaled(
                &factors.fold(one, |product, atom| product.mul(&self.atom(arena, atom).at_rest)),
                c,
            );
        }
        sum
    }

    /// A polynomial, term by term.
    pub(super) fn of(&mut self, arena: &mut Arena, form: &Polynomial) -> Counted {
        let mut result = Counted::constant(Polynomial::zero());
        for (monomial, c) in form.terms() {
            let part = self.product(arena, monomial);
            result.at_rest.add_scaled(&part.at_rest, c);
            result.change.add_scaled(&part.change, c);
        }
        result
    }

    /// `x y z - x0 y0 z0 = (x - x0) y z + x0 (y - y0) z + x0 y0 (z - z0)`
    fn product(&mut self, arena: &mut Arena, monomial: &[Expr]) -> Counted {
        let atoms = self.telescoped(monomial);
        let mut before = Polynomial::constant(Rational::ONE);
        let mut change = Polynomial::zero();
        for (k, atom) in atoms.iter().enumerate() {
            let part = self.atom(arena, *atom);
            let behind = Polynomial::term(atoms[k + 1..].to_vec(), Rational::ONE);
            change.add_product(&before.mul(&part.change), &behind, &Rational::ONE);
            before = before.mul(&part.at_rest);
        }
        Counted { at_rest: before, change }
    }

    /// The atoms in the order of telescoping.
    fn telescoped(&self, monomial: &[Expr]) -> Vec<Expr> {
        let mut atoms = monomial.to_vec();
        let last = self.rank.len();
        atoms.sort_by_key(|atom| self.rank.get(atom).copied().unwrap_or(last));
        atoms
    }

    fn atom(&mut self, arena: &mut Arena, atom: Expr) -> Counted {
        if let Some(known) = self.known.get(&atom) {
            return known.clone();
        }
        let counted = match arena.node(atom).clone() {
            Node::Function(function, argument) => {
                let argument = Polynomial::normal_form(arena, argument);
                let argument = self.of(arena, &argument);
                self.function(arena, atom, function, argument)
            }
            Node::Product(factors) if factors.len() == 1 && factors[0].1 == -1 => {
                let below = Polynomial::normal_form(arena, factors[0].0);
                let below = self.of(arena, &below);
                reciprocal(arena, atom, &below)
            }
            _ => None,
        };
        let counted = counted.unwrap_or_else(|| Counted::constant(Polynomial::atom(atom)));
        self.known.insert(atom, counted.clone());
        counted
    }

    /// `f(u) - f(u0)` through `u - u0`; `None` where nothing moves.
    fn function(
        &mut self,
        arena: &mut Arena,
        value: Expr,
        function: Function,
        Counted { at_rest, change }: Counted,
    ) -> Option<Counted> {
        if change.is_zero() {
            return None;
        }
        let start = at_rest.expression(arena);
        let of_start = arena.apply(function, start);
        let step = change.expression(arena);
        let changed = match function {
            // exp(u) - exp(u0) = exp(u0) (exp(u - u0) - 1)
            Function::Exp => {
                let growth = arena.apply(Function::ExpM1, step);
                arena.mul(of_start, growth)
            }
            // ln(u/u0) = arsinh((u/u0 - u0/u)/2), which keeps its digits far away too.
            Function::Ln => {
                let argument = arena.node(value).clone();
                let Node::Function(_, whole) = argument else { return None };
                let sum = arena.add(whole, start);
                let above = arena.mul(step, sum);
                let below = arena.mul(whole, start);
                let ratio = arena.div(above, below)?;
                let half = arena.scale(ratio, &Rational::HALF);
                arena.apply(Function::Asinh, half)
            }
            // y - y0 = (u - u0)/(y + y0), and with cubes
            Function::Sqrt | Function::Cbrt => {
                let mut terms = vec![value, of_start];
                if function == Function::Cbrt {
                    terms.iter_mut().for_each(|y| *y = arena.mul(*y, *y));
                    terms.push(arena.mul(value, of_start));
                }
                let terms: Vec<_> = terms.into_iter().map(|term| (term, Rational::ONE)).collect();
                let sum = arena.linear(&terms);
                arena.div(step, sum)?
            }
            Function::Cosh | Function::Cos if at_rest.is_zero() => {
                let odd = if function == Function::Cosh { Function::Sinh } else { Function::Sin };
                let half = arena.scale(step, &Rational::HALF);
                let half = arena.apply(odd, half);
                let square = arena.mul(half, half);
                arena.scale(square, &Rational::from(if odd == Function::Sinh { 2 } else { -2 }))
            }
            _ if at_rest.is_zero() && arena.as_constant(of_start).is_some_and(Rational::is_zero) => {
                arena.apply(function, step)
            }
            _ => arena.sub(value, of_start),
        };
        Some(Counted {
            at_rest: Polynomial::normal_form(arena, of_start),
            change: Polynomial::normal_form(arena, changed),
        })
    }

    /// Functions that vanish at `phi = 1` through the change of their arguments: `ln u` as `arsinh((u - 1/u)/2)`.
    fn without_vanishing_functions(&mut self, arena: &mut Arena, form: &Polynomial) -> Polynomial {
        let mut atoms: Vec<Expr> = form.terms().flat_map(|(monomial, _)| monomial.iter().copied()).collect();
        atoms.sort_unstable();
        atoms.dedup();
        let mut values: HashMap<Expr, Polynomial> = HashMap::new();
        for atom in atoms {
            let counted = self.atom(arena, atom);
            if arena.as_symbol(atom).is_none() && counted.vanishes() && !counted.is_constant() {
                values.insert(atom, counted.change);
            }
        }
        form.substitute(&|atom| values.get(&atom).cloned())
    }
}

/// `1/u - 1/u0 = -(u - u0)/(u u0)`; `None` where nothing moves.
fn reciprocal(arena: &mut Arena, value: Expr, below: &Counted) -> Option<Counted> {
    if below.is_constant() || below.vanishes() {
        return None;
    }
    let start = below.at_rest.expression(arena);
    let inverse = arena.pow(start, -1)?;
    let at_rest = Polynomial::normal_form(arena, inverse);
    let change = below.change.mul(&Polynomial::atom(value)).mul(&at_rest).neg();
    Some(Counted { at_rest, change })
}
