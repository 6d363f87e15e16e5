//! The canonical form of a function of the single stretches.

use crate::algebra::arena::Node;
use crate::algebra::fault::never_missing;
use crate::algebra::{Arena, Expr, Function, Rational};
use crate::mechanics::potential::base::{Base, log_stretches};

use super::form::{Form, Key};
use super::symmetric::through_traces;

impl Form {
    /// An expression in symbols `q_a`, with everything that is symmetric inside functions and divisors written through
    /// traces.
    pub(super) fn of(arena: &mut Arena, n: usize, expr: Expr) -> Self {
        match arena.node(expr).clone() {
            Node::Constant(value) => Self::term(Key::one(n), value),
            Node::Symbol(_) => {
                let mut key = Key::one(n);
                match log_stretches(arena, n).iter().position(|q| *q == expr) {
                    Some(a) => key.powers[a] = 1,
                    None => key.others.push((expr, 1)),
                }
                Self::term(key, Rational::ONE)
            }
            Node::Sum(constant, terms) => {
                let mut sum = Self::term(Key::one(n), constant);
                for (term, c) in terms {
                    sum.add_scaled(&Self::of(arena, n, term), &c);
                }
                sum
            }
            Node::Product(factors) => {
                let mut product = Self::term(Key::one(n), Rational::ONE);
                for (base, exponent) in factors {
                    let base = Self::of(arena, n, base);
                    let factor = match exponent {
                        1.. => base.power(n, exponent.unsigned_abs()),
                        _ => base.reciprocal(arena, n).power(n, exponent.unsigned_abs()),
                    };
                    product = product.mul(&factor);
                }
                product
            }
            Node::Function(function, argument) => Self::of(arena, n, argument).applied(arena, n, function),
        }
    }

    /// `1/form`; a sum is divided by as a whole, its first coefficient outside.
    fn reciprocal(&self, arena: &mut Arena, n: usize) -> Self {
        if let Some((key, c)) = self.terms.first_key_value().filter(|_| self.terms.len() == 1)
            && key.powers.iter().all(|power| *power == 0)
        {
            let mut inverse = key.clone();
            inverse.exponents.iter_mut().for_each(|c| *c = -&*c);
            inverse.others.iter_mut().for_each(|(_, exponent)| *exponent = -*exponent);
            return Self::term(inverse, never_missing(c.recip(), "no stored term is zero", Rational::ZERO));
        }
        let first = self.terms.values().next().and_then(Rational::recip);
        let first = never_missing(first, "a divisor is not zero, so its form has a term", Rational::ZERO);
        let base = through_traces(arena, n, self.scaled(&first)).expression(arena, n);
        Self::factor(n, base, -1, first)
    }

    fn factor(n: usize, base: Expr, exponent: i32, coefficient: Rational) -> Self {
        Self::term(Key { others: vec![(base, exponent)], ..Key::one(n) }, coefficient)
    }

    fn applied(self, arena: &mut Arena, n: usize, function: Function) -> Self {
        let mean = Base::MeanLogStretch.symbol(arena);
        let linear = self.terms.keys().all(|key| key.is_log_stretch(mean).is_some());
        match function {
            Function::Exp => return self.exponential(arena, n, mean),
            Function::Sinh | Function::Cosh if linear => {
                let half = Rational::HALF;
                let sign = if function == Function::Sinh { -&half } else { half.clone() };
                let mut sum = self.exponential(arena, n, mean).scaled(&half);
                let opposite = self.scaled(&Rational::MINUS_ONE);
                sum.add_scaled(&opposite.exponential(arena, n, mean), &sign);
                return sum;
            }
            Function::Ln | Function::Sqrt => {
                if let Some((key, _)) =
                    self.terms.first_key_value().filter(|(key, c)| c.is_one() && key.is_exponential())
                    && self.terms.len() == 1
                {
                    return Self::of_exponential(n, key, function, mean);
                }
            }
            _ => {}
        }
        let turns = function.is_even() || function.is_odd();
        let flipped = turns && self.terms.values().next().is_some_and(Rational::is_negative);
        let argument = if flipped { self.scaled(&Rational::MINUS_ONE) } else { self };
        let argument = through_traces(arena, n, argument).expression(arena, n);
        let value = arena.apply(function, argument);
        let sign = if flipped && function.is_odd() { Rational::MINUS_ONE } else { Rational::ONE };
        // The form of an expression may have another sign than the expression, which an odd function pulls out again.
        let (value, sign) = match arena.node(value) {
            Node::Sum(constant, terms) if constant.is_zero() && terms.len() == 1 => {
                (terms[0].0, &sign * &terms[0].1)
            }
            _ => (value, sign),
        };
        match arena.node(value) {
            Node::Function(..) => Self::factor(n, value, 1, sign),
            // A known value, or what an inverse function left.
            _ => Self::of(arena, n, value).scaled(&sign),
        }
    }

    /// Logarithm or root of `exp(c_1 q_1 + ...)`.
    fn of_exponential(n: usize, key: &Key, function: Function, mean: Expr) -> Self {
        if function == Function::Sqrt {
            let half = Rational::HALF;
            let exponents = key.exponents.iter().map(|c| c * &half).collect();
            return Self::term(Key { exponents, ..key.clone() }, Rational::ONE);
        }
        let mut result = Self::default();
        for (a, c) in key.exponents.iter().enumerate() {
            let mut one = Key::one(n);
            match one.powers.get_mut(a) {
                Some(power) => *power = 1,
                None => one.others.push((mean, 1)),
            }
            result.add(one, c);
        }
        result
    }

    /// `exp(form)`: a factor for each term.
    fn exponential(&self, arena: &mut Arena, n: usize, mean: Expr) -> Self {
        let mut product = Key::one(n);
        for (key, c) in &self.terms {
            if let Some(a) = key.is_log_stretch(mean) {
                product.exponents[a] = &product.exponents[a] + c;
                continue;
            }
            let whole = c.to_i64().and_then(|c| i32::try_from(c).ok()).filter(|_| c.is_integer());
            let unit = if whole.is_some() { Rational::ONE } else { c.clone() };
            let argument = Self::term(key.clone(), unit).expression(arena, n);
            let value = arena.apply(Function::Exp, argument);
            let others = vec![(value, whole.unwrap_or(1))];
            product = product.times(&Key { others, ..Key::one(n) });
        }
        Self::term(product, Rational::ONE)
    }
}
