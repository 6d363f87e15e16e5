//! Expressions in an arena, built only by constructors that canonicalise.
//!
//! Canonical form: a sum is a constant plus terms with rational coefficients, a product is a list of bases with
//! integer exponents and no number in it; both are flat, sorted by node, without repetition. Nothing is expanded:
//! `2*(a + b)` and `2*a + 2*b` are different nodes, and [`Polynomial`](super::Polynomial) decides equality.

mod products;

use rustc_hash::FxHashMap;

use super::fault::never_missing;
use super::function::Function;
use super::rational::Rational;
use crate::symbol::{Aspect, Quantity, Symbol};

/// Handle of an expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Expr(u32);

/// The root of an expression.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// An exact number.
    Constant(Rational),
    /// A symbol, which stands for any number.
    Symbol(Symbol),
    /// `constant + sum of coefficient * term`; at least two summands or one coefficient other than 1.
    Sum(Rational, Vec<(Expr, Rational)>),
    /// Product of `base^exponent`; at least two factors or one exponent other than 1.
    Product(Vec<(Expr, i32)>),
    /// An elementary function; no value that is rational.
    Function(Function, Expr),
}

/// Why products that are rewritten divide by nothing new.
const KEPT: &str = "bases that are rewritten keep their values, and were not the number zero";

/// Owner of expressions.
#[derive(Debug, Default)]
pub struct Arena {
    nodes: Vec<Node>,
    index: FxHashMap<Node, Expr>,
}

impl Arena {
    /// An empty arena.
    pub fn new() -> Self {
        Self::default()
    }

    /// The root node of an expression.
    pub fn node(&self, expr: Expr) -> &Node {
        &self.nodes[expr.0 as usize]
    }

    fn intern(&mut self, node: Node) -> Expr {
        if let Some(&known) = self.index.get(&node) {
            return known;
        }
        let fresh = u32::try_from(self.nodes.len()).ok();
        let fresh = Expr(never_missing(fresh, "an arena of 2^32 nodes does not fit in memory", 0));
        self.nodes.push(node.clone());
        self.index.insert(node, fresh);
        fresh
    }

    /// The expression of an exact number.
    pub fn constant(&mut self, value: Rational) -> Expr {
        self.intern(Node::Constant(value))
    }

    /// The expression of a symbol.
    pub fn symbol(&mut self, symbol: impl Into<Symbol>) -> Expr {
        self.intern(Node::Symbol(symbol.into()))
    }

    /// The symbol of what is said about one.
    #[track_caller]
    pub fn about(&mut self, aspect: Aspect, symbol: Expr) -> Expr {
        let of = self.symbol_of(symbol);
        self.symbol(of.seen(aspect))
    }

    /// The number an expression is, if it is one.
    pub fn as_constant(&self, expr: Expr) -> Option<&Rational> {
        match self.node(expr) {
            Node::Constant(value) => Some(value),
            _ => None,
        }
    }

    /// The expressions of several symbols, in their order.
    pub fn symbols<S: Into<Symbol>, const N: usize>(&mut self, symbols: [S; N]) -> [Expr; N] {
        symbols.map(|symbol| self.symbol(symbol))
    }

    /// The components 1 to `n` of a symbol.
    pub fn components(&mut self, of: impl Into<Symbol>, n: usize) -> Vec<Expr> {
        let of = of.into();
        (1..=n).map(|k| self.symbol(of.at([k]))).collect()
    }

    /// The symbol that an expression is, if it is one.
    pub fn as_symbol(&self, expr: Expr) -> Option<&Symbol> {
        match self.node(expr) {
            Node::Symbol(symbol) => Some(symbol),
            _ => None,
        }
    }

    /// The quantity that an expression is a component of, if it is a symbol of one.
    pub fn quantity(&self, expr: Expr) -> Option<Quantity> {
        self.as_symbol(expr).and_then(Symbol::quantity)
    }

    /// Is it a parameter of the model?
    pub fn is_parameter(&self, expr: Expr) -> bool {
        self.as_symbol(expr).is_some_and(Symbol::is_parameter)
    }

    /// The symbol that an expression is for sure.
    #[track_caller]
    pub fn symbol_of(&self, expr: Expr) -> Symbol {
        let symbol = self.as_symbol(expr).cloned();
        never_missing(symbol, "only symbols are asked for what they stand for", Quantity::Difference.into())
    }

    /// The symbols that some expressions are for sure.
    #[track_caller]
    pub fn symbols_of(&self, symbols: &[Expr]) -> Vec<Symbol> {
        symbols.iter().map(|symbol| self.symbol_of(*symbol)).collect()
    }

    /// Name of an expression that is a symbol.
    #[track_caller]
    pub fn symbol_name(&self, symbol: Expr) -> String {
        self.symbol_of(symbol).to_string()
    }

    /// Sum of expressions with rational coefficients.
    pub fn linear(&mut self, summands: &[(Expr, Rational)]) -> Expr {
        let mut constant = Rational::ZERO;
        let mut terms: Vec<(Expr, Rational)> = Vec::with_capacity(summands.len());
        for (expr, weight) in summands {
            match self.node(*expr) {
                Node::Constant(value) => constant = &constant + &(value * weight),
                // A number before a sum of several terms stays there: factored forms are not expanded.
                Node::Sum(inner, list) if weight.abs().is_one() || (inner.is_zero() && list.len() == 1) => {
                    constant = &constant + &(inner * weight);
                    terms.extend(list.iter().map(|(term, c)| (*term, c * weight)));
                }
                _ => terms.push((*expr, weight.clone())),
            }
        }
        terms.sort_by_key(|(term, _)| *term);
        terms.dedup_by(|later, earlier| {
            let same = later.0 == earlier.0;
            if same {
                earlier.1 = &earlier.1 + &later.1;
            }
            same
        });
        terms.retain(|(_, c)| !c.is_zero());
        match terms.as_slice() {
            [] => self.constant(constant),
            [(only, c)] if constant.is_zero() && c.is_one() => *only,
            _ => self.intern(Node::Sum(constant, terms)),
        }
    }

    /// `a + b`.
    pub fn add(&mut self, a: Expr, b: Expr) -> Expr {
        self.linear(&[(a, Rational::ONE), (b, Rational::ONE)])
    }

    /// `a - b`.
    pub fn sub(&mut self, a: Expr, b: Expr) -> Expr {
        self.linear(&[(a, Rational::ONE), (b, Rational::MINUS_ONE)])
    }

    /// `-a`.
    pub fn neg(&mut self, a: Expr) -> Expr {
        self.linear(&[(a, Rational::MINUS_ONE)])
    }

    /// `weight * a`.
    pub fn scale(&mut self, a: Expr, weight: &Rational) -> Expr {
        self.linear(&[(a, weight.clone())])
    }

    /// `a * b`.
    pub fn mul(&mut self, a: Expr, b: Expr) -> Expr {
        never_missing(self.product(&[(a, 1), (b, 1)]), "a product divides by nothing", a)
    }

    /// `a ^ exponent`; `None` for a negative power of zero.
    pub fn pow(&mut self, a: Expr, exponent: i32) -> Option<Expr> {
        self.product(&[(a, exponent)])
    }

    /// `1/a` of what is not the number zero: of a symbol, of a function of symbols, of what was divided by before.
    #[track_caller]
    pub fn reciprocal(&mut self, a: Expr) -> Expr {
        never_missing(self.pow(a, -1), "what is divided by is not the number zero", a)
    }

    /// `a ^ exponent` of what is not the number zero, or with an exponent that is not negative.
    #[track_caller]
    pub fn power(&mut self, a: Expr, exponent: i32) -> Expr {
        never_missing(self.pow(a, exponent), "no negative power is of the number zero", a)
    }

    /// The expression with symbols replaced by what makes no divisor zero.
    #[track_caller]
    pub fn replaced(&mut self, expr: Expr, value: &dyn Fn(Expr) -> Option<Expr>) -> Expr {
        never_missing(self.substitute(expr, value), "no divisor becomes the number zero", expr)
    }

    /// A product of powers of which no negative one is of the number zero.
    #[track_caller]
    pub fn certain_product(&mut self, factors: &[(Expr, i32)]) -> Expr {
        let product = self.product(factors);
        never_missing(product, KEPT, Expr(0))
    }

    /// `a / b`; `None` where `b` is zero.
    pub fn div(&mut self, a: Expr, b: Expr) -> Option<Expr> {
        self.product(&[(a, 1), (b, -1)])
    }

    /// `function(argument)`, with what is even or odd, inverse or known at 0 and 1 resolved.
    pub fn apply(&mut self, function: Function, argument: Expr) -> Expr {
        match (function, self.node(argument)) {
            (Function::Exp | Function::Cos | Function::Cosh, Node::Constant(zero)) if zero.is_zero() => {
                return self.constant(Rational::ONE);
            }
            (Function::Ln, Node::Constant(one)) if one.is_one() => return self.constant(Rational::ZERO),
            (Function::Sqrt | Function::Cbrt | Function::InverseCbrt, Node::Constant(one))
                if one.is_one() =>
            {
                return argument;
            }
            (Function::Ln | Function::InverseCbrt, _) => {}
            (_, Node::Constant(zero)) if zero.is_zero() => return argument,
            _ => {}
        }
        match (function, self.node(argument)) {
            (Function::Exp, Node::Function(Function::Ln, inner))
            | (Function::Ln, Node::Function(Function::Exp, inner)) => return *inner,
            (Function::Cos | Function::Cosh | Function::Abs, Node::Function(Function::Abs, inner)) => {
                let inner = *inner;
                return self.apply(function, inner);
            }
            // sqrt(u^2) = |u|, which has a slope where u vanishes in passing.
            (Function::Sqrt, Node::Product(factors)) if factors.iter().all(|(_, k)| *k > 0 && k % 2 == 0) => {
                let halves: Vec<_> = factors.iter().map(|(base, k)| (*base, k / 2)).collect();
                if let Some(root) = self.product(&halves) {
                    return self.apply(Function::Abs, root);
                }
            }
            _ => {}
        }
        let negative = match self.node(argument) {
            Node::Sum(constant, terms) => {
                terms.iter().all(|(_, c)| c.is_negative()) && (constant.is_zero() || constant.is_negative())
            }
            Node::Constant(value) => value.is_negative(),
            _ => false,
        };
        if negative && (function.is_even() || function.is_odd()) {
            let opposite = self.neg(argument);
            let value = self.apply(function, opposite);
            return if function.is_even() { value } else { self.neg(value) };
        }
        self.intern(Node::Function(function, argument))
    }

    /// Does `wanted` hold for any symbol below `expr`?
    pub fn any_symbol(&self, expr: Expr, wanted: &mut impl FnMut(Expr) -> bool) -> bool {
        match self.node(expr) {
            Node::Symbol(_) => wanted(expr),
            _ => self.any_part(expr, &mut |part| self.any_symbol(part, wanted)),
        }
    }

    /// Does `wanted` hold for anything right below the root of `expr`?
    pub fn any_part(&self, expr: Expr, wanted: &mut dyn FnMut(Expr) -> bool) -> bool {
        match self.node(expr) {
            Node::Constant(_) | Node::Symbol(_) => false,
            Node::Sum(_, terms) => terms.iter().any(|(term, _)| wanted(*term)),
            Node::Product(factors) => factors.iter().any(|(base, _)| wanted(*base)),
            Node::Function(_, argument) => wanted(*argument),
        }
    }

    /// What stands right below the root of `expr`.
    pub fn parts(&self, expr: Expr) -> Vec<Expr> {
        let mut parts = Vec::new();
        self.any_part(expr, &mut |part| {
            parts.push(part);
            false
        });
        parts
    }

    /// The expression with what stands right below its root replaced; `None` where a part has no value, or where a divisor
    /// or what a logarithm is taken of becomes zero.
    pub fn with_parts(
        &mut self,
        expr: Expr,
        value: &mut dyn FnMut(&mut Self, Expr) -> Option<Expr>,
    ) -> Option<Expr> {
        match self.node(expr).clone() {
            Node::Constant(_) | Node::Symbol(_) => Some(expr),
            Node::Sum(constant, terms) => {
                let mut summands = vec![(self.constant(constant), Rational::ONE)];
                for (term, c) in terms {
                    summands.push((value(self, term)?, c));
                }
                Some(self.linear(&summands))
            }
            Node::Product(factors) => {
                let mut product = Vec::with_capacity(factors.len());
                for (base, exponent) in factors {
                    product.push((value(self, base)?, exponent));
                }
                self.product(&product)
            }
            Node::Function(function, argument) => {
                let argument = value(self, argument)?;
                let zero =
                    function == Function::Ln && self.as_constant(argument).is_some_and(Rational::is_zero);
                (!zero).then(|| self.apply(function, argument))
            }
        }
    }

    /// The same where all parts keep their values, so that no divisor becomes zero.
    #[track_caller]
    pub fn rebuilt(&mut self, expr: Expr, part: &mut dyn FnMut(&mut Self, Expr) -> Expr) -> Expr {
        let rebuilt = self.with_parts(expr, &mut |arena, of| Some(part(arena, of)));
        never_missing(rebuilt, KEPT, expr)
    }

    /// Calls `visit` once for every symbol below `expr`.
    pub fn for_each_symbol(&self, expr: Expr, visit: &mut impl FnMut(&Symbol)) {
        self.any_symbol(expr, &mut |symbol| {
            self.as_symbol(symbol).into_iter().for_each(&mut *visit);
            false
        });
    }
}
