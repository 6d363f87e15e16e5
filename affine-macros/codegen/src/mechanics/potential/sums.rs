//! Sums that stand in powers: multiplied out, `(tr G - 3)^8` is a difference of numbers that are larger by many orders.

use crate::algebra::arena::Node;
use crate::algebra::{Arena, Expr, Rational};

/// Sums with the symbols that stand for them.
#[derive(Default)]
pub(super) struct Sums {
    /// In the order in which they are computed.
    known: Vec<(Expr, Expr)>,
}

impl Sums {
    /// The expression with symbols for the sums that it raises to a power, wherever they stand in it.
    pub(super) fn named(&mut self, arena: &mut Arena, expr: Expr) -> Expr {
        let mut raised = Vec::new();
        find(arena, expr, &mut raised);
        if raised.is_empty() && self.known.is_empty() {
            return expr;
        }
        self.replaced(arena, expr, &raised)
    }

    /// The symbols, and the sums in terms of those before.
    pub(super) fn known(&self) -> &[(Expr, Expr)] {
        &self.known
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
                return arena.product(&factors).unwrap_or(expr);
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
        let symbol = arena.symbol(&format!("raised_{}", self.known.len() + 1));
        self.known.push((symbol, rebuilt));
        symbol
    }
}

/// Sums to the second power or a higher one.
fn find(arena: &Arena, expr: Expr, raised: &mut Vec<Expr>) {
    match arena.node(expr) {
        Node::Constant(_) | Node::Symbol(_) => {}
        Node::Function(_, argument) => find(arena, *argument, raised),
        Node::Sum(_, terms) => terms.iter().for_each(|(term, _)| find(arena, *term, raised)),
        Node::Product(factors) => {
            for (base, exponent) in factors {
                if *exponent > 1 && matches!(arena.node(*base), Node::Sum(..)) && !raised.contains(base) {
                    raised.push(*base);
                }
                find(arena, *base, raised);
            }
        }
    }
}
