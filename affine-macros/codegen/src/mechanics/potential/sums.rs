//! Sums that stand in powers and functions: multiplied out, `(tr G - 3)^8` is a difference of numbers that are larger by many
//! orders. Products of several sums keep them where they would have many terms.

use crate::algebra::arena::Node;
use crate::algebra::{Arena, Expr, Polynomial, Rational};
use crate::symbol::Quantity;

/// Sums with the symbols that stand for them.
#[derive(Default)]
pub(super) struct Sums {
    /// In the order in which they are computed.
    known: Vec<(Expr, Expr)>,
    /// Does a factor that is a sum of functions stay one? `1 - tanh^2` is small where both are not.
    functions: bool,
}

impl Sums {
    /// Of slopes, in which the slopes of functions are factors.
    pub(super) fn of_slopes() -> Self {
        Self { functions: true, ..Self::default() }
    }

    /// The expression with symbols for the sums that it raises to a power, wherever they stand in it.
    pub(super) fn named(&mut self, arena: &mut Arena, expr: Expr) -> Expr {
        let mut raised = Vec::new();
        self.find(arena, expr, &mut raised);
        if raised.is_empty() && self.known.is_empty() {
            return expr;
        }
        self.replaced(arena, expr, &raised)
    }

    /// The symbols with their sums multiplied out.
    pub(super) fn forms(&self, arena: &mut Arena) -> Vec<(Expr, Polynomial)> {
        self.known.iter().map(|(symbol, sum)| (*symbol, Polynomial::normal_form(arena, *sum))).collect()
    }

    /// The symbols, and the sums in terms of those before.
    pub(super) fn known(&self) -> &[(Expr, Expr)] {
        &self.known
    }

    /// Sums to any power but the first, those in functions, and factors that stay.
    fn find(&self, arena: &Arena, expr: Expr, raised: &mut Vec<Expr>) {
        let mut keep = |of: Expr| {
            if terms(arena, of) > 1 && !raised.contains(&of) {
                raised.push(of);
            }
        };
        match arena.node(expr) {
            Node::Constant(_) | Node::Symbol(_) => {}
            Node::Function(_, argument) => {
                keep(*argument);
                self.find(arena, *argument, raised);
            }
            Node::Sum(_, terms) => terms.iter().for_each(|(term, _)| self.find(arena, *term, raised)),
            Node::Product(factors) => {
                let sizes = factors.iter().map(|(base, _)| terms(arena, *base));
                let many = sizes.fold(1, |product: usize, size| product.saturating_mul(size)) > FEW_TERMS;
                for (base, exponent) in factors {
                    if many || *exponent != 1 || self.functions && is_of_functions(arena, *base) {
                        keep(*base);
                    }
                }
                factors.iter().for_each(|(base, _)| self.find(arena, *base, raised));
            }
        }
    }

    fn replaced(&mut self, arena: &mut Arena, expr: Expr, raised: &[Expr]) -> Expr {
        let rebuilt = match arena.node(expr).clone() {
            Node::Constant(_) | Node::Symbol(_) => return expr,
            Node::Function(function, argument) => {
                let argument = self.replaced(arena, argument, raised);
                return arena.apply(function, argument);
            }
            Node::Product(factors) => {
                let factors: Vec<_> = factors
                    .into_iter()
                    .map(|(base, exponent)| (self.replaced(arena, base, raised), exponent))
                    .collect();
                // The bases keep their values, and were not the number zero.
                return arena.certain_product(&factors);
            }
            Node::Sum(constant, terms) => {
                let mut summands = vec![(arena.constant(constant), Rational::ONE)];
                for (term, c) in terms {
                    summands.push((self.replaced(arena, term, raised), c));
                }
                arena.linear(&summands)
            }
        };
        let known = self.known.iter().find(|(_, sum)| *sum == rebuilt).map(|(symbol, _)| *symbol);
        if let Some(symbol) = known {
            return symbol;
        }
        if !raised.contains(&expr) || !matches!(arena.node(rebuilt), Node::Sum(..)) {
            return rebuilt;
        }
        let symbol = arena.symbol(Quantity::Raised.at([self.known.len() + 1]));
        self.known.push((symbol, rebuilt));
        symbol
    }
}

/// Products of sums are multiplied out up to so many terms.
const FEW_TERMS: usize = 32;

/// Has the sum a term with a function in it?
fn is_of_functions(arena: &Arena, expr: Expr) -> bool {
    let is_function = |node: Expr| matches!(arena.node(node), Node::Function(..));
    let in_product = |term: Expr| match arena.node(term) {
        Node::Product(factors) => factors.iter().any(|(base, _)| is_function(*base)),
        _ => is_function(term),
    };
    matches!(arena.node(expr), Node::Sum(_, terms) if terms.iter().any(|(term, _)| in_product(*term)))
}

/// How many terms the expression has at most once it is multiplied out; functions and divisors are one.
pub(super) fn multiplied_out(arena: &Arena, expr: Expr) -> u32 {
    match arena.node(expr) {
        Node::Constant(_) | Node::Symbol(_) | Node::Function(..) => 1,
        Node::Sum(constant, terms) => terms
            .iter()
            .map(|(term, _)| multiplied_out(arena, *term))
            .fold(u32::from(!constant.is_zero()), u32::saturating_add),
        Node::Product(factors) => factors
            .iter()
            .map(|(base, exponent)| {
                multiplied_out(arena, *base).saturating_pow((*exponent).max(0).unsigned_abs())
            })
            .fold(1, u32::saturating_mul),
    }
}

/// How many terms a sum has; anything else is one.
fn terms(arena: &Arena, expr: Expr) -> usize {
    match arena.node(expr) {
        Node::Sum(constant, terms) => terms.len() + usize::from(!constant.is_zero()),
        _ => 1,
    }
}
