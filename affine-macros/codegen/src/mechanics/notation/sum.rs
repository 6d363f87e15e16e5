//! Sums under construction.

use super::names::Notation;
use super::sentence::{Sentence, Summand};
use crate::algebra::arena::Node;
use crate::algebra::{Arena, Expr, Polynomial, Rational};

/// A sum under construction.
#[derive(Default)]
pub(in crate::mechanics) struct Sum(Vec<Summand>);

impl Sum {
    /// The sum of these.
    pub(in crate::mechanics) fn new(summands: impl IntoIterator<Item = Summand>) -> Self {
        let mut sum = Self::default();
        sum.extend(summands);
        sum
    }

    /// Adds `coefficient * body`, with the sign in front.
    pub(in crate::mechanics) fn add(
        &mut self,
        arena: &mut Arena,
        notation: &Notation,
        coefficient: &Polynomial,
        body: impl Into<Sentence>,
    ) {
        if let Some((negative, size)) = signed(arena, notation, coefficient) {
            let one = arena.as_constant(size).is_some_and(Rational::is_one);
            let body = body.into();
            let value = if one { body } else { Sentence::Multiple(size, Box::new(body)) };
            self.push(Summand { negative, value });
        }
    }

    /// Adds a number, or a multiple of the identity.
    pub(in crate::mechanics) fn add_number(
        &mut self,
        arena: &mut Arena,
        notation: &Notation,
        number: &Polynomial,
    ) {
        if let Some((negative, size)) = signed(arena, notation, number) {
            self.push(Summand { negative, value: Sentence::Scalar(size) });
        }
    }

    /// Adds an expression, term by term: what is negative is subtracted.
    pub(in crate::mechanics) fn add_expression(
        &mut self,
        arena: &mut Arena,
        notation: &Notation,
        expr: Expr,
    ) {
        let shown = notation.through_powers(arena, expr);
        let Node::Sum(constant, terms) = arena.node(shown).clone() else {
            return self.push(Summand::plus(Sentence::Scalar(shown)));
        };
        let constant = (!constant.is_zero()).then(|| (arena.constant(Rational::ONE), constant));
        for (term, c) in terms.into_iter().chain(constant) {
            let value = arena.scale(term, &c.abs());
            // A sum by itself keeps its brackets.
            let is_sum = c.abs().is_one() && matches!(arena.node(term), Node::Sum(..));
            let value = if is_sum {
                Sentence::Sum(vec![Summand::plus(Sentence::Scalar(value))])
            } else {
                Sentence::Scalar(value)
            };
            self.0.push(Summand { negative: c.is_negative(), value });
        }
    }

    /// Adds a summand; one that is a sum itself summand by summand.
    pub(in crate::mechanics) fn push(&mut self, summand: Summand) {
        match summand {
            Summand { negative: false, value: Sentence::Sum(summands) } => self.0.extend(summands),
            one => self.0.push(one),
        }
    }

    /// Adds summands.
    pub(in crate::mechanics) fn extend(&mut self, summands: impl IntoIterator<Item = Summand>) {
        summands.into_iter().for_each(|summand| self.push(summand));
    }

    /// The finished sum.
    pub(in crate::mechanics) fn value(mut self) -> Sentence {
        match self.0.pop() {
            Some(Summand { negative: false, value }) if self.0.is_empty() => value,
            last => {
                self.0.extend(last);
                Sentence::Sum(self.0)
            }
        }
    }

    /// As what something is.
    pub(in crate::mechanics) fn of(self, left: impl Into<Sentence>) -> Sentence {
        self.value().of(left)
    }
}

/// Is a coefficient negative, and its size; nothing where it is zero.
fn signed(arena: &mut Arena, notation: &Notation, coefficient: &Polynomial) -> Option<(bool, Expr)> {
    if coefficient.is_zero() {
        return None;
    }
    let negative = coefficient.terms().all(|(_, c)| c.is_negative());
    let size = if negative { coefficient.neg() } else { coefficient.clone() };
    let size = size.expression(arena);
    Some((negative, notation.through_powers(arena, size)))
}
