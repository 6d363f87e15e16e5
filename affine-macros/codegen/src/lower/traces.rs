//! Traces of polynomials in matrices, whose powers and products stay matrices.
//!
//! A power is computed by squares, and the slope of `tr(S^k)` by `S` is `k S^(k-1)` transposed, where the slope by each factor of
//! each product would be a sum of `k` of them. What is told of matrices is told by their entries.

mod tape;

use std::collections::BTreeMap;

use super::{Lowered, NoValue};
use crate::algebra::ring::{Square, pairs, table, transpose};
use crate::algebra::{Arena, Expr, Rational};
use crate::mechanics::potential::Base;
use crate::spec::{Expression, ExpressionKind, MatrixName};

pub(super) use tape::entry;
use tape::{Made, Scalars, Tape, times};

/// The value of a trace.
pub(super) fn value(arena: &mut Arena, n: usize, trace: &Expression, scalars: Scalars) -> Lowered {
    Tape { arena, n, scalars, nodes: Vec::new() }.whole(trace).map(|(_, value)| value)
}

/// A trace with its slopes.
pub(super) struct Trace {
    pub(super) value: Expr,
    /// By the symbols of base functions.
    pub(super) slopes: Vec<(Expr, Expr)>,
    /// Is it a sum of traces of powers, whose slopes are powers too?
    pub(super) is_of_powers: bool,
}

/// A trace with its slopes; `None` where it is a base function itself.
pub(super) fn slopes(arena: &mut Arena, n: usize, trace: &Expression, scalars: Scalars) -> Option<Trace> {
    let mut tape = Tape { arena, n, scalars, nodes: Vec::new() };
    let (terms, value) = tape.whole(trace).ok()?;
    if tape.arena.as_symbol(value).is_some() {
        return None;
    }
    let mut slopes: BTreeMap<Expr, Vec<(Expr, Rational)>> = BTreeMap::new();
    for term in &terms {
        for (symbol, slope) in tape.slopes(term) {
            slopes.entry(symbol).or_default().push((slope, Rational::ONE));
        }
    }
    let slopes = slopes.into_iter().map(|(symbol, parts)| (symbol, arena.linear(&parts))).collect();
    let is_of_powers = terms.iter().all(|term| term.factors.len() < 2);
    Some(Trace { value, slopes, is_of_powers })
}

/// `scalar tr(A B ..)`.
struct Term {
    scalar: Expr,
    /// Next to each other no two powers of one matrix, as on a circle.
    factors: Vec<usize>,
}

impl Tape<'_> {
    /// A trace as a sum of those of products.
    fn terms(&mut self, trace: &Expression) -> Result<Vec<Term>, NoValue> {
        let one = self.arena.constant(Rational::ONE);
        let whole = match &trace.kind {
            ExpressionKind::Trace(factors) => {
                let mut product = self.scalar(one);
                for factor in factors {
                    let factor = self.named(*factor);
                    product = self.product(product, factor);
                }
                product
            }
            ExpressionKind::PolynomialTrace(trace) => self.read(&trace.written)?,
            _ => return Err(NoValue::Malformed),
        };
        let mut terms = Vec::new();
        self.split(whole, one, &mut terms);
        Ok(terms)
    }

    /// The same with the value of the sum.
    fn whole(&mut self, trace: &Expression) -> Result<(Vec<Term>, Expr), NoValue> {
        let terms = self.terms(trace)?;
        let value = |term: &Term| {
            let trace = self.trace(&term.factors);
            (self.arena.mul(term.scalar, trace), Rational::ONE)
        };
        let values: Vec<_> = terms.iter().map(value).collect();
        Ok((terms, self.arena.linear(&values)))
    }

    /// `scalar tr(whole)` as a sum of traces of products.
    fn split(&mut self, whole: usize, scalar: Expr, terms: &mut Vec<Term>) {
        if let (Made::Sum(summands), 1) = (self.nodes[whole].made.clone(), self.nodes[whole].power.1) {
            for (summand, c) in summands {
                let scalar = self.arena.scale(scalar, &c);
                self.split(summand, scalar, terms);
            }
            return;
        }
        let mut term = Term { scalar, factors: Vec::new() };
        self.factors(whole, &mut term);
        self.close(&mut term.factors);
        match term.factors.as_slice() {
            [only] if *only != whole && matches!(self.nodes[*only].made, Made::Sum(_)) => {
                self.split(*only, term.scalar, terms);
            }
            _ => terms.push(term),
        }
    }

    /// The factors of a product, neighbouring powers of one matrix as one.
    fn factors(&mut self, whole: usize, term: &mut Term) {
        match self.nodes[whole].made {
            Made::Scalar(value) => term.scalar = self.arena.mul(term.scalar, value),
            Made::Product(a, b) if self.nodes[whole].power.1 == 1 => {
                self.factors(a, term);
                self.factors(b, term);
            }
            _ => match term.factors.last() {
                Some(&last) if self.nodes[last].power.0 == self.nodes[whole].power.0 => {
                    term.factors.pop();
                    let joined = self.product(last, whole);
                    term.factors.push(joined);
                }
                _ => term.factors.push(whole),
            },
        }
    }

    /// A trace may begin at any factor; where it goes through the same ones several times, it is that of a power.
    fn close(&mut self, factors: &mut Vec<usize>) {
        if let [first, .., last] = factors[..]
            && self.nodes[first].power.0 == self.nodes[last].power.0
        {
            factors.pop();
            factors[0] = self.product(last, first);
        }
        let len = factors.len();
        let is_period = |period: &usize| {
            len.is_multiple_of(*period) && (0..len).all(|k| factors[k] == factors[k % period])
        };
        let Some(period) = (1..len).find(is_period) else { return };
        let once = factors[..period].to_vec();
        let product = once.iter().skip(1).fold(once[0], |left, right| self.product(left, *right));
        *factors = vec![(1..len / period).fold(product, |power, _| self.product(power, product))];
    }

    /// The two halves of the product of several factors.
    fn halves(&mut self, factors: &[usize]) -> Option<[usize; 2]> {
        let mut matrices = factors.to_vec();
        while matrices.len() > 2 {
            matrices = matrices
                .chunks(2)
                .map(|pair| pair.iter().skip(1).fold(pair[0], |left, right| self.product(left, *right)))
                .collect();
        }
        matrices.try_into().ok()
    }

    /// The base function that the trace of a power is.
    fn invariant(&self, factor: usize) -> Option<Base> {
        let (base, power) = self.nodes[factor].power;
        match (&self.nodes[base].made, power) {
            (Made::Named(MatrixName::Placement), _) => None,
            (Made::Named(_), 1..=3) => Some(Base::Trace(power as usize)),
            _ => None,
        }
    }

    fn trace(&mut self, factors: &[usize]) -> Expr {
        if let [factor] = factors {
            if let Some(base) = self.invariant(*factor) {
                return base.symbol(self.arena);
            }
            let (base, power) = self.nodes[*factor].power;
            if power == 1 {
                return diagonal_sum(self.arena, &self.nodes[*factor].value);
            }
            let halves = [power / 2, power - power / 2].map(|power| self.power(base, power));
            return self.contracted(halves);
        }
        match self.halves(factors) {
            Some(halves) => self.contracted(halves),
            None => self.arena.constant(Rational::whole(self.n)),
        }
    }

    /// `tr(A B)`
    fn contracted(&mut self, [a, b]: [usize; 2]) -> Expr {
        let n = self.n;
        let mut sum = Vec::new();
        for (i, j) in pairs(n) {
            let product = self.arena.mul(self.nodes[a].value[i][j], self.nodes[b].value[j][i]);
            sum.push((product, Rational::ONE));
        }
        self.arena.linear(&sum)
    }

    /// The slopes of a term.
    fn slopes(&mut self, term: &Term) -> Vec<(Expr, Expr)> {
        let trace = self.trace(&term.factors);
        let mut list: Vec<(Expr, Expr)> = Vec::new();
        for (symbol, slope) in self.arena.gradient(term.scalar, &|_| true) {
            list.push((symbol, self.arena.mul(slope, trace)));
        }
        let mut number = Rational::ONE;
        // Slopes by matrices.
        let mut open: BTreeMap<usize, Square<Expr>> = BTreeMap::new();
        match term.factors.as_slice() {
            [] => return list,
            [factor] => {
                if let Some(base) = self.invariant(*factor) {
                    list.push((base.symbol(self.arena), term.scalar));
                    return list;
                }
                let (base, power) = self.nodes[*factor].power;
                number = Rational::from(i64::from(power));
                let below = self.power(base, power.saturating_sub(1));
                open.insert(base, transpose(&self.nodes[below].value));
            }
            factors => {
                let Some([a, b]) = self.halves(factors) else { return list };
                open.insert(a, transpose(&self.nodes[b].value));
                let slope = transpose(&self.nodes[a].value);
                self.add(&mut open, b, slope, &Rational::ONE);
            }
        }
        let scale = self.arena.scale(term.scalar, &number);
        while let Some((place, slope)) = open.pop_last() {
            self.back(place, slope, scale, &mut open, &mut list);
        }
        list
    }

    /// From the slope by a matrix to those by what it is made of.
    fn back(
        &mut self,
        place: usize,
        slope: Square<Expr>,
        scale: Expr,
        open: &mut BTreeMap<usize, Square<Expr>>,
        list: &mut Vec<(Expr, Expr)>,
    ) {
        match self.nodes[place].made.clone() {
            Made::Named(matrix) => self.by_entries(matrix, &slope, scale, list),
            Made::Scalar(value) => {
                let sum = diagonal_sum(self.arena, &slope);
                let sum = self.arena.mul(scale, sum);
                for (symbol, inner) in self.arena.gradient(value, &|_| true) {
                    list.push((symbol, self.arena.mul(sum, inner)));
                }
            }
            Made::Sum(terms) => {
                for (term, c) in terms {
                    self.add(open, term, slope.clone(), &c);
                }
            }
            Made::Product(a, b) => {
                let by_left = times(self.arena, &slope, &transpose(&self.nodes[b].value));
                let by_right = times(self.arena, &transpose(&self.nodes[a].value), &slope);
                self.add(open, a, by_left, &Rational::ONE);
                self.add(open, b, by_right, &Rational::ONE);
            }
        }
    }

    fn add(
        &mut self,
        open: &mut BTreeMap<usize, Square<Expr>>,
        place: usize,
        slope: Square<Expr>,
        number: &Rational,
    ) {
        let n = self.n;
        let before = open.remove(&place);
        let entry = |a: usize, b: usize| {
            let mut sum = vec![(slope[a][b], number.clone())];
            sum.extend(before.iter().map(|before| (before[a][b], Rational::ONE)));
            self.arena.linear(&sum)
        };
        let sum = table(n, entry);
        open.insert(place, sum);
    }

    /// Entries beside the diagonal of a symmetric matrix stand there twice.
    fn by_entries(
        &mut self,
        matrix: MatrixName,
        slope: &Square<Expr>,
        scale: Expr,
        list: &mut Vec<(Expr, Expr)>,
    ) {
        let is_symmetric = matrix != MatrixName::Placement;
        for (a, b) in pairs(self.n).filter(|(a, b)| !is_symmetric || a <= b) {
            let is_twice = is_symmetric && a != b;
            let sum = if is_twice { self.arena.add(slope[a][b], slope[b][a]) } else { slope[a][b] };
            let symbol = entry(matrix, a, b).symbol(self.arena);
            list.push((symbol, self.arena.mul(scale, sum)));
        }
    }
}

fn diagonal_sum(arena: &mut Arena, matrix: &Square<Expr>) -> Expr {
    let diagonal: Vec<_> = (0..matrix.len()).map(|a| (matrix[a][a], Rational::ONE)).collect();
    arena.linear(&diagonal)
}
