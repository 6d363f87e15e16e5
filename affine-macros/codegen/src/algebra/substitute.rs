//! Symbols replaced by expressions, and signs that hold whatever the symbols are.

use rustc_hash::FxHashMap;

use super::arena::{Arena, Expr, Node};
use super::function::Function;
use crate::symbol::Symbol;

impl Arena {
    /// The expression with symbols replaced; `None` where a divisor, or what a logarithm is taken of, becomes zero.
    pub fn substitute(&mut self, expr: Expr, value: &dyn Fn(Expr) -> Option<Expr>) -> Option<Expr> {
        self.substituted(expr, value, &mut FxHashMap::default())
    }

    /// The same with what became of the parts that were met before.
    fn substituted(
        &mut self,
        expr: Expr,
        value: &dyn Fn(Expr) -> Option<Expr>,
        known: &mut FxHashMap<Expr, Expr>,
    ) -> Option<Expr> {
        if let Some(known) = known.get(&expr) {
            return Some(*known);
        }
        if let Node::Symbol(_) = self.node(expr) {
            return Some(value(expr).unwrap_or(expr));
        }
        let found = self.with_parts(expr, &mut |arena, part| arena.substituted(part, value, known))?;
        known.insert(expr, found);
        Some(found)
    }

    /// Is the value `>= 0` for all symbols, those of `positive` being so; and is it never zero?
    pub fn sign(&self, expr: Expr, positive: &dyn Fn(&Symbol) -> bool) -> Option<Sign> {
        match self.node(expr) {
            Node::Constant(value) if value.is_zero() => None,
            Node::Constant(value) => Some(Sign { negative: value.is_negative(), strict: true }),
            Node::Symbol(symbol) => positive(symbol).then_some(Sign { negative: false, strict: true }),
            Node::Sum(constant, terms) => {
                let own = (!constant.is_zero()).then_some((constant.is_negative(), true));
                let mut signs: Vec<(bool, bool)> = own.into_iter().collect();
                for (term, c) in terms {
                    let sign = self.sign(*term, positive)?;
                    signs.push((sign.negative != c.is_negative(), sign.strict));
                }
                let negative = signs.first()?.0;
                let strict = signs.iter().any(|(_, strict)| *strict);
                signs.iter().all(|(other, _)| *other == negative).then_some(Sign { negative, strict })
            }
            Node::Product(factors) => {
                let mut product = Sign { negative: false, strict: true };
                for (base, exponent) in factors {
                    let known = self.sign(*base, positive);
                    let strict = known.is_some_and(|sign| sign.strict);
                    // What is divided by is not zero.
                    product.strict &= strict || *exponent < 0;
                    if exponent % 2 != 0 {
                        product.negative ^= known?.negative;
                    }
                }
                Some(product)
            }
            Node::Function(Function::Exp | Function::Cosh, _) => Some(Sign { negative: false, strict: true }),
            Node::Function(Function::Sqrt | Function::Abs, argument) => {
                let strict = self.sign(*argument, positive).is_some_and(|sign| sign.strict);
                Some(Sign { negative: false, strict })
            }
            Node::Function(..) => None,
        }
    }
}

/// The value that a list has for a key.
pub fn listed<K: PartialEq, T: Clone>(list: &[(K, T)]) -> impl Fn(K) -> Option<T> {
    |wanted| list.iter().find(|(known, _)| *known == wanted).map(|(_, value)| value.clone())
}

/// A sign that an expression has everywhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sign {
    /// `<= 0` rather than `>= 0`.
    pub negative: bool,
    /// Never zero.
    pub strict: bool,
}
