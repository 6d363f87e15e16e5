//! Where a potential has a value, read off what the user wrote: arguments of logarithms and roots, and divisors; and angles
//! that the time turns.

use super::base_functions::{Reading, difference_of, is_positive, value};
use super::constant::constant;
use crate::algebra::fault::never_missing;
use crate::algebra::ring::above_diagonal;
use crate::algebra::{Arena, Expr, Function, Rational};
use crate::mechanics::potential::{Bound, Guard};
use crate::spec::{Expression, ExpressionKind, Operator};
use crate::symbol::Quantity;

/// The guards of an energy, in the order of its parts, angles last; those that hold everywhere are left out.
pub(super) fn guards(arena: &mut Arena, n: usize, energy: &Expression, given: bool) -> Vec<Guard> {
    let mut guards = Guards { arena, n, given, difference: None, found: Vec::new() };
    guards.read(energy);
    // Angles come last.
    guards.found.sort_by_key(|guard| guard.bound == Bound::Angle);
    guards.found
}

struct Guards<'a> {
    arena: &'a mut Arena,
    n: usize,
    /// Are components told from those in orthonormal bases?
    given: bool,
    /// What `d` stands for.
    difference: Option<Expr>,
    found: Vec<Guard>,
}

impl Guards<'_> {
    /// A part of the energy.
    fn read(&mut self, part: &Expression) {
        match &part.kind {
            ExpressionKind::Pairs(one) => {
                let outside = self.difference;
                for (a, b) in above_diagonal(self.n) {
                    self.difference = Some(difference_of(self.arena, a, b));
                    self.read(one);
                }
                self.difference = outside;
                return;
            }
            ExpressionKind::Call(Function::Ln, argument) => {
                self.keep(part, argument, Bound::Positive);
                // The logarithm of a square ends where that is zero.
                self.divide(part, argument);
            }
            ExpressionKind::Call(Function::Sqrt, argument) => self.keep(part, argument, Bound::NotNegative),
            // A tangent is a quotient by the cosine.
            ExpressionKind::Call(Function::Tan, argument) => {
                let value = self.value(argument);
                let cosine = self.arena.apply(Function::Cos, value);
                self.add(part, format!("cos({argument})"), Bound::NotZero, cosine);
            }
            ExpressionKind::Binary(Operator::Divide, _, divisor) => self.divide(part, divisor),
            ExpressionKind::Binary(Operator::Power, base, exponent)
                if constant(exponent, self.n).is_some_and(|exponent| exponent.is_negative()) =>
            {
                self.divide(part, base);
            }
            _ => {}
        }
        if let ExpressionKind::Call(Function::Sin | Function::Cos | Function::Tan, argument) = &part.kind {
            self.turn(part, argument);
        }
        part.operands().into_iter().for_each(|operand| self.read(operand));
    }

    /// The factors of what a part divides by.
    fn divide(&mut self, part: &Expression, divisor: &Expression) {
        match &divisor.kind {
            ExpressionKind::Binary(Operator::Multiply, a, b) => {
                self.divide(part, a);
                self.divide(part, b);
            }
            ExpressionKind::Negate(a)
            | ExpressionKind::Binary(Operator::Power, a, _)
            | ExpressionKind::Binary(Operator::Divide, a, _)
            | ExpressionKind::Call(Function::Abs, a) => self.divide(part, a),
            _ => self.keep(part, divisor, Bound::NotZero),
        }
    }

    /// The argument of a periodic function, where it contains the time.
    fn turn(&mut self, part: &Expression, argument: &Expression) {
        let value = self.value(argument);
        let time = self.arena.symbol(Quantity::Time);
        let is_known = self.found.iter().any(|guard| guard.value == value && guard.bound == Bound::Angle);
        if !is_known && self.arena.any_symbol(value, &mut |symbol| symbol == time) {
            let (part, argument) = (part.to_string(), argument.to_string());
            self.found.push(Guard { part, argument, bound: Bound::Angle, value });
        }
    }

    fn keep(&mut self, part: &Expression, argument: &Expression, bound: Bound) {
        let value = self.value(argument);
        self.add(part, argument.to_string(), bound, value);
    }

    fn value(&mut self, e: &Expression) -> Expr {
        let reading = Reading { difference: self.difference, given: self.given, ..Reading::default() };
        let value = value(self.arena, self.n, e, reading).ok();
        never_missing(value, "parts of what has a value have one", self.arena.constant(Rational::ZERO))
    }

    /// One more guard, unless it holds everywhere, is there already, or is one of numbers and fields, which are looked at
    /// when the model is prepared.
    fn add(&mut self, part: &Expression, argument: String, bound: Bound, value: Expr) {
        let sign = self.arena.sign(value, &is_positive);
        // What has one sign everywhere does not change it on the way, though it may vanish at a point.
        let holds = sign.is_some_and(|sign| !sign.negative || bound == Bound::NotZero);
        let says_as_much = |guard: &Guard| match guard.bound {
            Bound::Angle => false,
            known => bound == Bound::NotZero || known == bound,
        };
        let is_known = self.found.iter().any(|guard| guard.value == value && says_as_much(guard));
        if !holds && !is_known && super::moves(self.arena, value) {
            self.found.push(Guard { part: part.to_string(), argument, bound, value });
        }
    }
}
