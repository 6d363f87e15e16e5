//! Products in canonical form: numbers pulled out, products flat, factors that cancel gone.

use super::{Arena, Expr, Node};
use crate::algebra::function::Function;
use crate::algebra::rational::Rational;

impl Arena {
    /// Product of integer powers; `None` for a negative power of zero.
    pub fn product(&mut self, factors: &[(Expr, i32)]) -> Option<Expr> {
        let mut number = Rational::ONE;
        let mut bases: Vec<(Expr, i32)> = Vec::with_capacity(factors.len());
        for &(base, exponent) in factors {
            self.split_factor(base, exponent, &mut number, &mut bases)?;
        }
        self.match_reciprocals(&mut number, &mut bases)?;
        bases.sort_by_key(|(base, _)| *base);
        bases.dedup_by(|later, earlier| {
            let same = later.0 == earlier.0;
            if same {
                earlier.1 += later.1;
            }
            same
        });
        self.cancel_roots(&mut bases);
        bases.retain(|(_, exponent)| *exponent != 0);
        let body = match bases.as_slice() {
            [] => return Some(self.constant(number)),
            [(only, 1)] => *only,
            _ => self.intern(Node::Product(bases)),
        };
        Some(self.linear(&[(body, number)]))
    }

    /// Pulls the number out of a factor and flattens products.
    fn split_factor(
        &mut self,
        base: Expr,
        exponent: i32,
        number: &mut Rational,
        bases: &mut Vec<(Expr, i32)>,
    ) -> Option<()> {
        match &self.node(base).clone() {
            Node::Constant(value) => *number = &*number * &value.pow(exponent)?,
            Node::Product(list) => bases.extend(list.iter().map(|(b, e)| (*b, e * exponent))),
            Node::Sum(constant, terms) if constant.is_zero() && terms.len() == 1 => {
                *number = &*number * &terms[0].1.pow(exponent)?;
                self.split_factor(terms[0].0, exponent, number, bases)?;
            }
            // Reciprocals of multiples are multiples of reciprocals: 1/(2a + 2b) and 1/(a + b) share a node.
            Node::Sum(..) if exponent < 0 => {
                let (lead, monic) = self.monic(base)?;
                *number = &*number * &lead.pow(exponent)?;
                bases.push((monic, exponent));
            }
            // sqrt(u)^2 = u wherever the root exists.
            Node::Function(Function::Sqrt, argument) if exponent >= 2 => {
                self.split_factor(*argument, exponent / 2, number, bases)?;
                if exponent % 2 == 1 {
                    bases.push((base, 1));
                }
            }
            // |u|^2 = u^2.
            Node::Function(Function::Abs, argument) if exponent.abs() >= 2 => {
                self.split_factor(*argument, exponent - exponent % 2, number, bases)?;
                if exponent % 2 != 0 {
                    bases.push((base, exponent % 2));
                }
            }
            _ => bases.push((base, exponent)),
        }
        Some(())
    }

    /// A sum as a number times the sum with leading coefficient 1.
    fn monic(&mut self, base: Expr) -> Option<(Rational, Expr)> {
        let Node::Sum(constant, terms) = self.node(base).clone() else { return Some((Rational::ONE, base)) };
        let lead = terms[0].1.clone();
        if lead.is_one() {
            return Some((lead, base));
        }
        let scale = lead.recip()?;
        let mut summands: Vec<(Expr, Rational)> = terms.iter().map(|(term, c)| (*term, c * &scale)).collect();
        summands.push((self.constant(&constant * &scale), Rational::ONE));
        Some((lead, self.linear(&summands)))
    }

    /// `u/sqrt(u) = sqrt(u)` wherever the root exists, also where it has no reciprocal.
    fn cancel_roots(&self, bases: &mut [(Expr, i32)]) {
        for root in 0..bases.len() {
            let Node::Function(Function::Sqrt, argument) = *self.node(bases[root].0) else { continue };
            let argument = bases.iter().position(|(base, exponent)| *base == argument && *exponent > 0);
            if let Some(argument) = argument.filter(|_| bases[root].1 < 0) {
                let cancelled = bases[argument].1.min((1 - bases[root].1) / 2);
                bases[argument].1 -= cancelled;
                bases[root].1 += 2 * cancelled;
            }
        }
    }

    /// Writes sums that a reciprocal cancels up to a number as that number times the reciprocal's base.
    fn match_reciprocals(&mut self, number: &mut Rational, bases: &mut [(Expr, i32)]) -> Option<()> {
        let below: Vec<Expr> = bases.iter().filter(|(_, e)| *e < 0).map(|(base, _)| *base).collect();
        if below.is_empty() {
            return Some(());
        }
        for (base, exponent) in bases.iter_mut().filter(|(_, e)| *e > 0) {
            let (lead, monic) = self.monic(*base)?;
            if below.contains(&monic) {
                *number = &*number * &lead.pow(*exponent)?;
                *base = monic;
            }
        }
        Some(())
    }
}
