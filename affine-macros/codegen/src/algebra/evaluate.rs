//! The reference evaluator: expressions by their definition, in any commutative field.
//!
//! It is the oracle of every pass: no reordering, no rounding when the field is [`Rational`].

use rustc_hash::FxHashMap;

use super::arena::{Arena, Expr, Node};
use super::function::Function;
use super::polynomial::Polynomial;
use super::rational::Rational;
use crate::symbol::Symbol;

/// A field to evaluate in.
pub trait Field: Clone {
    /// The image of an exact number.
    fn from_rational(value: &Rational) -> Self;
    /// Sum.
    fn add(&self, other: &Self) -> Self;
    /// Product.
    fn mul(&self, other: &Self) -> Self;
    /// Reciprocal; `None` where there is none.
    fn recip(&self) -> Option<Self>;
    /// An elementary function; `None` where the field has none.
    fn apply(&self, _function: Function) -> Option<Self> {
        None
    }
}

impl Field for Rational {
    fn from_rational(value: &Rational) -> Self {
        value.clone()
    }
    fn add(&self, other: &Self) -> Self {
        self + other
    }
    fn mul(&self, other: &Self) -> Self {
        self * other
    }
    fn recip(&self) -> Option<Self> {
        Rational::recip(self)
    }
}

impl Field for f64 {
    fn from_rational(value: &Rational) -> Self {
        value.to_doubles().0
    }
    fn add(&self, other: &Self) -> Self {
        self + other
    }
    fn mul(&self, other: &Self) -> Self {
        self * other
    }
    fn recip(&self) -> Option<Self> {
        Some(1.0 / self)
    }
    fn apply(&self, function: Function) -> Option<Self> {
        Some(match function {
            Function::Exp => self.exp(),
            Function::ExpM1 => self.exp_m1(),
            Function::Ln => self.ln(),
            Function::Sqrt => self.sqrt(),
            Function::Cbrt => self.cbrt(),
            Function::InverseCbrt => 1.0 / self.cbrt(),
            Function::Abs => self.abs(),
            Function::Sign => self.signum(),
            Function::Sin => self.sin(),
            Function::Cos => self.cos(),
            Function::Tan => self.tan(),
            Function::Sinh => self.sinh(),
            Function::Cosh => self.cosh(),
            Function::Tanh => self.tanh(),
            Function::Asinh => self.asinh(),
        })
    }
}

/// Value of an expression; `None` where a symbol has no value or a reciprocal does not exist.
pub fn evaluate<F: Field>(arena: &Arena, expr: Expr, value: &impl Fn(&Symbol) -> Option<F>) -> Option<F> {
    evaluated(arena, expr, value, &mut FxHashMap::default())
}

/// The same with the values of the parts that were met before.
fn evaluated<F: Field>(
    arena: &Arena,
    expr: Expr,
    value: &impl Fn(&Symbol) -> Option<F>,
    known: &mut FxHashMap<Expr, F>,
) -> Option<F> {
    if let Some(known) = known.get(&expr) {
        return Some(known.clone());
    }
    let found = match arena.node(expr) {
        Node::Constant(number) => return Some(F::from_rational(number)),
        Node::Symbol(symbol) => value(symbol)?,
        Node::Function(function, argument) => evaluated(arena, *argument, value, known)?.apply(*function)?,
        Node::Sum(constant, terms) => {
            let mut sum = F::from_rational(constant);
            for (term, c) in terms {
                sum = sum.add(&F::from_rational(c).mul(&evaluated(arena, *term, value, known)?));
            }
            sum
        }
        Node::Product(factors) => {
            let mut product = F::from_rational(&Rational::ONE);
            for &(base, exponent) in factors {
                let base = evaluated(arena, base, value, known)?;
                let base = if exponent < 0 { base.recip()? } else { base };
                for _ in 0..exponent.unsigned_abs() {
                    product = product.mul(&base);
                }
            }
            product
        }
    };
    known.insert(expr, found.clone());
    Some(found)
}

/// Value of a polynomial; as [`evaluate`].
pub fn evaluate_polynomial<F: Field>(
    arena: &Arena,
    polynomial: &Polynomial,
    value: &impl Fn(&Symbol) -> Option<F>,
) -> Option<F> {
    let mut sum = F::from_rational(&Rational::ZERO);
    for (monomial, c) in polynomial.terms() {
        let mut product = F::from_rational(c);
        for atom in monomial {
            product = product.mul(&evaluate(arena, *atom, value)?);
        }
        sum = sum.add(&product);
    }
    Some(sum)
}
