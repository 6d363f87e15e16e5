//! Forms that neither overflow nor cancel: functions of the differences of places through decaying exponentials.
//!
//! With `t = exp(-(q_a - q_b))`, `d = 1 - t` and `e = 1 + t`, and one division `r = 1/(d e)` for each pair:
//!
//! ```text
//! 1/sh^2 x = 4 t/d^2     ch x/sh x = e/d     1/d = e r
//! 1/ch^2 x = 4 t/e^2     sh x/ch x = d/e     1/e = d r
//! ```
//!
//! They hold for both signs of `x`, and nothing overflows for `q_1 >= .. >= q_n`: the order in which decompositions come
//! and which motions keep that never pass a coincidence. `d` is `-expm1(q_b - q_a)` for neighbours, `t` is `1 - d`, exact
//! to the rounding of 1: what it couples are sums with terms of order 1.

use crate::algebra::{Arena, Expr, Function, Polynomial, Rational};
use crate::symbol::Quantity;

use super::{Lattice, Variables};

/// The rewriting, and what it shares.
#[derive(Clone, Debug)]
pub struct Stable {
    /// Definitions, each through coordinates and others of the list.
    pub shared: Vec<(Expr, Polynomial)>,
    pairs: Vec<Pair>,
}

/// What stands in monomials for one pair, and what replaces it.
#[derive(Clone, Debug)]
struct Pair {
    /// The odd and the even function, and their reciprocals.
    odd: Expr,
    even: Expr,
    recip_odd: Expr,
    recip_even: Expr,
    replacement: Replacement,
}

#[derive(Clone, Copy, Debug)]
enum Replacement {
    /// `1/sh^2 = 4 odd`, `1/ch^2 = 4 even`, and the quotients.
    Decaying { odd: Expr, even: Expr, coth: Expr, tanh: Expr },
    /// `1/(Q_a - Q_b)`, `1/(Q_a + Q_b)`, or `1/sin x`, `1/cos x`.
    Reciprocals { odd: Expr, even: Expr },
}

impl Stable {
    /// The forms for a lattice.
    pub fn new(arena: &mut Arena, lattice: &Lattice) -> Self {
        let mut stable = Self { shared: Vec::new(), pairs: Vec::new() };
        for (a, b) in lattice.pairs() {
            let [odd, even] = lattice.couplings(arena, a, b);
            let [recip_odd, recip_even] = [odd, even].map(|e| arena.reciprocal(e));
            let replacement = match lattice.variables {
                Variables::LogStretches => stable.decaying(arena, lattice, a, b),
                Variables::Stretches | Variables::Angles => stable.reciprocals(arena, [odd, even], a, b),
            };
            stable.pairs.push(Pair { odd, even, recip_odd, recip_even, replacement });
        }
        stable
    }

    fn define(&mut self, arena: &mut Arena, of: Quantity, (a, b): (usize, usize), value: Polynomial) -> Expr {
        let symbol = named(arena, of, a, b);
        self.shared.push((symbol, value));
        symbol
    }

    fn decaying(&mut self, arena: &mut Arena, lattice: &Lattice, a: usize, b: usize) -> Replacement {
        let (gap, decay) = if b == a + 1 {
            let apart = arena.sub(lattice.q[b], lattice.q[a]);
            let decayed = arena.apply(Function::ExpM1, apart);
            let gap = Polynomial::normal_form(arena, decayed).neg();
            (gap, one_and(named(arena, Quantity::Gap, a, b), &Rational::MINUS_ONE))
        } else {
            // t_ac = t_ab t_bc and d_ac = d_ab + t_ab d_bc: no further exponential, nothing cancels.
            let mut gap = Polynomial::atom(named(arena, Quantity::Gap, a, a + 1));
            let (t, d) = (named(arena, Quantity::Decay, a, a + 1), named(arena, Quantity::Gap, a + 1, b));
            gap.add_term(vec![t, d], &Rational::ONE);
            (gap, Polynomial::monomial([t, named(arena, Quantity::Decay, a + 1, b)]))
        };
        let pair = (a, b);
        let d = self.define(arena, Quantity::Gap, pair, gap);
        let t = self.define(arena, Quantity::Decay, pair, decay);
        let e = self.define(arena, Quantity::Even, pair, one_and(t, &Rational::ONE));
        let [over_d, over_e] = self.shared_reciprocals(arena, [d, e], pair);
        let term = |factors: Vec<Expr>| Polynomial::monomial(factors);
        Replacement::Decaying {
            odd: self.define(arena, Quantity::Repulsion, pair, term(vec![t, over_d, over_d])),
            even: self.define(arena, Quantity::Attraction, pair, term(vec![t, over_e, over_e])),
            coth: self.define(arena, Quantity::Coth, pair, term(vec![e, over_d])),
            tanh: self.define(arena, Quantity::Tanh, pair, term(vec![d, over_e])),
        }
    }

    fn reciprocals(&mut self, arena: &mut Arena, values: [Expr; 2], a: usize, b: usize) -> Replacement {
        let [odd, even] = values.map(|value| Polynomial::normal_form(arena, value));
        let odd = self.define(arena, Quantity::Gap, (a, b), odd);
        let even = self.define(arena, Quantity::Even, (a, b), even);
        let [odd, even] = self.shared_reciprocals(arena, [odd, even], (a, b));
        Replacement::Reciprocals { odd, even }
    }

    /// `1/d` and `1/e` by one division: `r = 1/(d e)`, `1/d = e r`, `1/e = d r`.
    fn shared_reciprocals(
        &mut self,
        arena: &mut Arena,
        [d, e]: [Expr; 2],
        pair: (usize, usize),
    ) -> [Expr; 2] {
        // Symbols are not the number zero.
        let below = [d, e].map(|value| arena.reciprocal(value));
        let r =
            self.define(arena, Quantity::Reciprocal, pair, Polynomial::term(below.to_vec(), Rational::ONE));
        [
            self.define(arena, Quantity::GapReciprocal, pair, Polynomial::monomial([e, r])),
            self.define(arena, Quantity::EvenReciprocal, pair, Polynomial::monomial([d, r])),
        ]
    }

    /// What stands for `1/(4 sh^2)`, `1/(4 ch^2)`, `ch/sh` and `sh/ch` of each pair of log-stretches.
    pub(super) fn quotients(&self) -> Vec<[Expr; 4]> {
        let of = |pair: &Pair| match pair.replacement {
            Replacement::Decaying { odd, even, coth, tanh } => Some([odd, even, coth, tanh]),
            Replacement::Reciprocals { .. } => None,
        };
        self.pairs.iter().filter_map(of).collect()
    }

    /// The polynomial with every function of a pair replaced.
    pub fn rewritten(&self, polynomial: &Polynomial) -> Polynomial {
        let mut result = Polynomial::zero();
        for (monomial, c) in polynomial.terms() {
            let (mut factors, mut weight) = (monomial.clone(), c.clone());
            self.pairs.iter().for_each(|pair| pair.replace(&mut factors, &mut weight));
            result.add_term(factors, &weight);
        }
        result
    }
}

impl Pair {
    fn replace(&self, factors: &mut Vec<Expr>, weight: &mut Rational) {
        let mut take = |atom: Expr| {
            let count = factors.iter().filter(|factor| **factor == atom).count();
            factors.retain(|factor| *factor != atom);
            count
        };
        let recips = [take(self.recip_odd), take(self.recip_even)];
        match self.replacement {
            Replacement::Reciprocals { odd, even } => {
                factors.extend([odd].repeat(recips[0]));
                factors.extend([even].repeat(recips[1]));
            }
            Replacement::Decaying { odd, even, coth, tanh } => {
                // Derivatives of squares of reciprocals: every quotient has its reciprocal, and squares are left.
                let quotients = [take(self.even), take(self.odd)];
                for (k, (square, quotient)) in [(odd, coth), (even, tanh)].into_iter().enumerate() {
                    let squares = (recips[k] - quotients[k]) / 2;
                    factors.extend([quotient].repeat(quotients[k]));
                    factors.extend([square].repeat(squares));
                    (0..squares).for_each(|_| *weight = &*weight * &Rational::from(4));
                }
            }
        }
    }
}

/// `1 + sign symbol`.
fn one_and(symbol: Expr, sign: &Rational) -> Polynomial {
    let mut sum = Polynomial::constant(Rational::ONE);
    sum.add_term(vec![symbol], sign);
    sum
}

fn named(arena: &mut Arena, of: Quantity, a: usize, b: usize) -> Expr {
    arena.symbol(of.at([a + 1, b + 1]))
}
