//! Sums of terms in log-stretches, exponentials and other factors, and their arithmetic.

use std::collections::BTreeMap;

use crate::algebra::rational::exponent;
use crate::algebra::{Arena, Expr, Function, Rational};
use crate::mechanics::potential::base::{Base, log_stretches};

/// A sum of terms; no zero coefficient is stored.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Form {
    pub(super) terms: BTreeMap<Key, Rational>,
}

/// What a coefficient stands before.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Key {
    /// Exponents of `q_1, ..., q_n`.
    pub(super) powers: Vec<u32>,
    /// `c_a` of `exp(c_1 q_1) ... exp(c_n q_n) exp(c q)`.
    pub(super) exponents: Vec<Rational>,
    /// Other factors with their exponents, sorted.
    pub(super) others: Vec<(Expr, i32)>,
}

impl Key {
    /// The key of a number.
    pub(super) fn one(n: usize) -> Self {
        Self { powers: vec![0; n], exponents: vec![Rational::ZERO; n + 1], others: Vec::new() }
    }

    pub(super) fn times(&self, other: &Self) -> Self {
        let powers = self.powers.iter().zip(&other.powers).map(|(a, b)| a + b).collect();
        let exponents = self.exponents.iter().zip(&other.exponents).map(|(a, b)| a + b).collect();
        let mut others = [self.others.clone(), other.others.clone()].concat();
        others.sort_unstable();
        others.dedup_by(|later, earlier| {
            let same = later.0 == earlier.0;
            if same {
                earlier.1 += later.1;
            }
            same
        });
        others.retain(|(_, exponent)| *exponent != 0);
        Self { powers, exponents, others }
    }

    /// Neither powers nor other factors: exponentials alone.
    pub(super) fn is_exponential(&self) -> bool {
        self.others.is_empty() && self.powers.iter().all(|power| *power == 0)
    }

    /// The place `a` of a bare `q_a`, `n` for the mean.
    pub(super) fn is_log_stretch(&self, mean: Expr) -> Option<usize> {
        if self.exponents.iter().any(|c| !c.is_zero()) {
            return None;
        }
        match (self.powers.iter().sum::<u32>(), self.others.as_slice()) {
            (1, []) => self.powers.iter().position(|power| *power == 1),
            (0, [(symbol, 1)]) if *symbol == mean => Some(self.powers.len()),
            _ => None,
        }
    }
}

impl Form {
    /// A single term.
    pub(super) fn term(key: Key, coefficient: Rational) -> Self {
        let mut form = Self::default();
        form.add(key, &coefficient);
        form
    }

    pub(super) fn add(&mut self, key: Key, coefficient: &Rational) {
        let held = self.terms.entry(key).or_insert(Rational::ZERO);
        *held = &*held + coefficient;
        if held.is_zero() {
            self.terms.retain(|_, c| !c.is_zero());
        }
    }

    pub(super) fn add_scaled(&mut self, other: &Self, weight: &Rational) {
        other.terms.iter().for_each(|(key, c)| self.add(key.clone(), &(c * weight)));
    }

    pub(super) fn scaled(&self, weight: &Rational) -> Self {
        let mut form = Self::default();
        form.add_scaled(self, weight);
        form
    }

    pub(super) fn mul(&self, other: &Self) -> Self {
        let mut product = Self::default();
        for (left, c) in &self.terms {
            other.terms.iter().for_each(|(right, d)| product.add(left.times(right), &(c * d)));
        }
        product
    }

    pub(super) fn power(&self, n: usize, exponent: u32) -> Self {
        (0..exponent).fold(Self::term(Key::one(n), Rational::ONE), |power, _| power.mul(self))
    }

    /// The form as an expression.
    pub(super) fn expression(&self, arena: &mut Arena, n: usize) -> Expr {
        let mut arguments = log_stretches(arena, n);
        let logs = arguments.clone();
        arguments.push(Base::MeanLogStretch.symbol(arena));
        let mut summands = Vec::new();
        for (key, c) in &self.terms {
            let mut factors: Vec<(Expr, i32)> = key.others.clone();
            for (q, power) in logs.iter().zip(&key.powers) {
                factors.push((*q, exponent(*power as usize)));
            }
            for (q, c) in arguments.iter().zip(&key.exponents) {
                let argument = arena.scale(*q, c);
                factors.push((arena.apply(Function::Exp, argument), 1));
            }
            // Divisors were divisors in what this is the form of.
            summands.push((arena.certain_product(&factors), c.clone()));
        }
        arena.linear(&summands)
    }
}
