//! Expressions to straight-line code, common subexpressions once.

use rustc_hash::FxHashMap;

use crate::algebra::arena::Node;
use crate::algebra::kernel::{Callee, Group};
use crate::algebra::{Arena, Expr, Rational};
use crate::symbol::Symbol;

use super::call::Call;
use super::steps::Steps;
use super::{Op, Program, Value};

/// Powers from this one on are made of squares: those below take as many products either way.
const SQUARED: u32 = 4;

/// Ways of computing that are shorter for some programs.
#[derive(Clone, Copy, Debug, Default)]
pub struct Ways {
    /// Every power is made from the one before, which pays where all of them are needed.
    pub steps_through_powers: bool,
    /// A divisor is inverted once and multiplied with, which pays where several things are divided by it.
    pub inverts_divisors: bool,
}

/// Builds a program expression by expression.
#[derive(Debug, Default)]
pub struct Builder {
    steps: Steps,
    /// What it has besides these.
    program: Program,
    lowered: FxHashMap<Expr, Value>,
    ways: Ways,
    /// There is a power for which that makes a difference.
    has_powers: bool,
}

impl Builder {
    /// An empty program.
    pub fn new() -> Self {
        Self::default()
    }

    /// An empty program that is computed in some of these ways.
    pub fn by(ways: Ways) -> Self {
        Self { ways, ..Self::default() }
    }

    /// Is there a power that is made of other powers than the one before?
    pub fn has_powers(&self) -> bool {
        self.has_powers
    }

    /// Computes `value` once and reads `symbol` from it from here on.
    pub fn define(&mut self, arena: &Arena, symbol: Expr, value: Expr) {
        let made = self.lower(arena, value);
        self.lowered.insert(symbol, made);
        if let Some(symbol) = arena.as_symbol(symbol)
            && !matches!(self.steps.list[made], Op::Input(_) | Op::Constant(_))
            && !self.program.names.iter().any(|(v, _)| *v == made)
        {
            self.program.names.push((made, symbol.clone()));
        }
    }

    /// Calls a runtime function here; its results are inputs from here on.
    pub fn call(
        &mut self,
        arena: &Arena,
        callee: Callee,
        arguments: &[Group<Expr>],
        results: &[Group<Expr>],
    ) {
        let arguments = arguments.iter().map(|group| group.map(|e| self.lower(arena, *e))).collect();
        for symbol in results.iter().flat_map(Group::entries) {
            self.lower(arena, *symbol);
        }
        let results = results.iter().map(|group| group.map(|symbol| arena.symbol_of(*symbol))).collect();
        self.program.calls.push(Call { callee, arguments, results });
    }

    /// Adds a result.
    pub fn output(&mut self, arena: &Arena, name: impl Into<Symbol>, value: Expr) {
        let made = self.lower(arena, value);
        self.program.outputs.push((name.into(), made));
    }

    /// The program: only what the results need.
    pub fn finish(self) -> Program {
        Program { steps: self.steps.list, ..self.program }.without_dead_steps()
    }

    fn commutative(&mut self, make: fn(Value, Value) -> Op, a: Value, b: Value) -> Value {
        self.steps.step(make(a.min(b), a.max(b)))
    }

    fn constant(&mut self, value: &Rational) -> Value {
        self.steps.step(Op::Constant(value.clone()))
    }

    fn lower(&mut self, arena: &Arena, expr: Expr) -> Value {
        if let Some(&known) = self.lowered.get(&expr) {
            return known;
        }
        let value = match arena.node(expr) {
            Node::Constant(number) => self.constant(number),
            Node::Symbol(symbol) => self.steps.step(Op::Input(symbol.clone())),
            Node::Sum(constant, terms) => self.sum(arena, constant, terms),
            Node::Product(factors) => self.product(arena, factors),
            Node::Function(function, argument) => {
                let argument = self.lower(arena, *argument);
                self.steps.step(Op::Call(*function, argument))
            }
        };
        self.lowered.insert(expr, value);
        value
    }

    /// Positive summands first, so that a leading minus is rare.
    fn sum(&mut self, arena: &Arena, constant: &Rational, terms: &[(Expr, Rational)]) -> Value {
        let mut summands: Vec<(bool, Value)> = Vec::with_capacity(terms.len() + 1);
        for (term, c) in terms {
            let body = self.lower(arena, *term);
            let size = c.abs();
            let value = if size.is_one() {
                body
            } else {
                let number = self.constant(&size);
                self.commutative(Op::Mul, number, body)
            };
            summands.push((c.is_negative(), value));
        }
        if !constant.is_zero() {
            let value = self.constant(&constant.abs());
            summands.push((constant.is_negative(), value));
        }
        summands.sort_by_key(|(negative, _)| *negative);
        let mut sum: Option<Value> = None;
        for (negative, value) in summands {
            sum = Some(match (sum, negative) {
                (None, false) => value,
                (None, true) => self.steps.step(Op::Neg(value)),
                (Some(sum), false) => self.commutative(Op::Add, sum, value),
                (Some(sum), true) => self.steps.step(Op::Sub(sum, value)),
            });
        }
        sum.unwrap_or_else(|| self.constant(&Rational::ZERO))
    }

    /// By few products: of a power by a power where the exponent has a small divisor, else of the power before by the base.
    fn power(&mut self, base: Value, exponent: u32) -> Value {
        if exponent < 2 {
            return base;
        }
        match [2, 3, 5].into_iter().find(|divisor| exponent.is_multiple_of(*divisor)) {
            Some(2) => {
                let half = self.power(base, exponent / 2);
                self.commutative(Op::Mul, half, half)
            }
            Some(divisor) if divisor < exponent => {
                let part = self.power(base, exponent / divisor);
                self.power(part, divisor)
            }
            _ => {
                let before = self.power(base, exponent - 1);
                self.commutative(Op::Mul, before, base)
            }
        }
    }

    fn product(&mut self, arena: &Arena, factors: &[(Expr, i32)]) -> Value {
        let mut above: Option<Value> = None;
        let mut below: Option<Value> = None;
        for &(base, exponent) in factors {
            let mut base = self.lower(arena, base);
            if exponent < 0 && self.ways.inverts_divisors {
                let one = self.constant(&Rational::ONE);
                base = self.steps.step(Op::Div(one, base));
            }
            let is_factor = exponent > 0 || self.ways.inverts_divisors;
            let side = if is_factor { &mut above } else { &mut below };
            let mut product = *side;
            let (factor, times) = match exponent.unsigned_abs() {
                power if power < SQUARED || self.ways.steps_through_powers => (base, power),
                power => {
                    self.has_powers = true;
                    (self.power(base, power), 1)
                }
            };
            for _ in 0..times {
                product = Some(match product {
                    None => factor,
                    Some(p) => self.commutative(Op::Mul, p, factor),
                });
            }
            *side = product;
        }
        match (above, below) {
            (Some(a), None) => a,
            (above, Some(b)) => {
                let a = above.unwrap_or_else(|| self.constant(&Rational::ONE));
                self.steps.step(Op::Div(a, b))
            }
            (None, None) => self.constant(&Rational::ONE),
        }
    }
}
