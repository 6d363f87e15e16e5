//! Derivatives of expressions.

use std::collections::BTreeMap;

use super::arena::Node;
use super::{Arena, Expr, Function, Rational};

impl Arena {
    /// Derivative with respect to a symbol.
    pub fn derivative(&mut self, expr: Expr, symbol: Expr) -> Expr {
        if expr == symbol {
            return self.constant(Rational::ONE);
        }
        match self.node(expr).clone() {
            Node::Constant(_) | Node::Symbol(_) => self.constant(Rational::ZERO),
            Node::Sum(_, terms) => {
                let parts: Vec<_> =
                    terms.into_iter().map(|(term, c)| (self.derivative(term, symbol), c)).collect();
                self.linear(&parts)
            }
            Node::Product(factors) => {
                let mut parts = Vec::with_capacity(factors.len());
                for (k, &(base, exponent)) in factors.iter().enumerate() {
                    let inner = self.derivative(base, symbol);
                    let mut rest = factors.clone();
                    rest[k].1 -= 1;
                    rest.push((inner, 1));
                    parts.push((self.certain_product(&rest), Rational::from(i64::from(exponent))));
                }
                self.linear(&parts)
            }
            Node::Function(function, argument) => {
                let inner = self.derivative(argument, symbol);
                let outer = self.slope(function, argument);
                self.mul(outer, inner)
            }
        }
    }

    /// Derivatives with respect to the symbols that are `wanted` and stand in the expression, by the chain rule from the whole to
    /// its parts: a part that stands in many places, such as an entry of a product of matrices, is met once, and the slopes share
    /// what they have of it.
    pub fn gradient(&mut self, expr: Expr, wanted: &dyn Fn(Expr) -> bool) -> Vec<(Expr, Expr)> {
        let mut found = Vec::new();
        let mut open: BTreeMap<Expr, Vec<(Expr, Rational)>> = BTreeMap::new();
        open.insert(expr, vec![(self.constant(Rational::ONE), Rational::ONE)]);
        // Parts are older than what they stand in.
        while let Some((part, slopes)) = open.pop_last() {
            let slope = self.linear(&slopes);
            match self.node(part).clone() {
                Node::Constant(_) => {}
                Node::Symbol(_) if wanted(part) => found.push((part, slope)),
                Node::Symbol(_) => {}
                Node::Sum(_, terms) => {
                    for (term, c) in terms {
                        open.entry(term).or_default().push((slope, c));
                    }
                }
                Node::Product(factors) => {
                    for (k, &(base, exponent)) in factors.iter().enumerate() {
                        let mut rest = factors.clone();
                        rest[k].1 -= 1;
                        rest.push((slope, 1));
                        let slope = self.certain_product(&rest);
                        open.entry(base).or_default().push((slope, Rational::from(i64::from(exponent))));
                    }
                }
                Node::Function(function, argument) => {
                    let outer = self.slope(function, argument);
                    let slope = self.mul(outer, slope);
                    open.entry(argument).or_default().push((slope, Rational::ONE));
                }
            }
        }
        found
    }

    /// `function'` at an argument.
    fn slope(&mut self, function: Function, argument: Expr) -> Expr {
        let one = self.constant(Rational::ONE);
        let value = self.apply(function, argument);
        // The reciprocals below are of functions and arguments that are no constants.
        let reciprocal = |arena: &mut Self, of: Expr, exponent: i32, number: Rational| {
            let power = arena.power(of, exponent);
            arena.scale(power, &number)
        };
        match function {
            Function::Exp => value,
            Function::ExpM1 => self.apply(Function::Exp, argument),
            Function::Ln => reciprocal(self, argument, -1, Rational::ONE),
            Function::Asinh => {
                let square = self.mul(argument, argument);
                let sum = self.add(one, square);
                let root = self.apply(Function::Sqrt, sum);
                self.reciprocal(root)
            }
            Function::Sqrt => reciprocal(self, value, -1, Rational::HALF),
            Function::Cbrt => reciprocal(self, value, -2, Rational::THIRD),
            Function::InverseCbrt => reciprocal(self, value, 4, -&Rational::THIRD),
            Function::Abs => self.apply(Function::Sign, argument),
            Function::Sign => self.constant(Rational::ZERO),
            Function::Sin => self.apply(Function::Cos, argument),
            Function::Cos => {
                let sine = self.apply(Function::Sin, argument);
                self.neg(sine)
            }
            Function::Tan => {
                let square = self.mul(value, value);
                self.add(one, square)
            }
            Function::Sinh => self.apply(Function::Cosh, argument),
            Function::Cosh => self.apply(Function::Sinh, argument),
            Function::Tanh => {
                let square = self.mul(value, value);
                self.sub(one, square)
            }
        }
    }
}
