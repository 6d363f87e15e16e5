//! How large an expression is: as written, or once its products and powers are multiplied out, where that is done.

use super::potential::parts;
use crate::algebra::Function;
use crate::algebra::ring::above_diagonal;
use crate::diagnostics::{Diagnostics, ExpressionMistake, Reported};
use crate::lower::integer;
use crate::spec::{Expression, ExpressionKind, MatrixName, Operator, more_factors, numbered};

/// Polynomials are derived, factored and scheduled in a time that grows faster than their number of summands; energies have
/// tens of them. A power of a sum has `(m + k - 1) over k`, and one of degree 16 in seven variables 74613.
const MOST_SUMMANDS: u64 = 512;

/// Traces are computed by products of matrices, each once, so that their size is the number of their factors, powers counted as
/// [they are computed](more_factors).
const MOST_FACTORS: usize = 16;

/// Upper bounds of numbers of summands.
#[derive(Clone, Copy)]
struct Summands {
    /// Of the value.
    above: u64,
    /// Of what it is the inverse of.
    below: u64,
    /// Of what it has a square root of as a factor.
    root: u64,
    /// Of what it is a function of.
    inside: u64,
}

const ONE: Summands = Summands { above: 1, below: 1, root: 1, inside: 1 };

/// A potential has no more terms, and no more factors in traces, than a build has time for. It is computed as it is written; but
/// whether a function of single stretches is symmetric shows when it is multiplied out.
///
/// # Errors
/// Reported on the first smallest part that has more.
pub(super) fn of_potential(energy: &Expression, n: usize, found: &mut Diagnostics) -> Result<(), Reported> {
    if parts(energy).iter().any(|part| is_of_stretches(part)) {
        return summands(energy, n, found);
    }
    let mut known: Vec<&[MatrixName]> = Vec::new();
    let mut factors = 0;
    for part in parts(energy) {
        match &part.kind {
            ExpressionKind::Trace(product) if product.len() > 1 && !known.contains(&product.as_slice()) => {
                known.push(product);
                factors += of_product(product);
            }
            ExpressionKind::PolynomialTrace(trace) => factors += trace.factors(),
            _ => continue,
        }
        if factors > MOST_FACTORS {
            let limit = "16 factors in its traces";
            return Err(found.report(part.span, ExpressionMistake::ExpressionSize { limit }));
        }
    }
    Ok(())
}

/// The size of the trace of a product, which may be that of a power.
fn of_product(product: &[MatrixName]) -> usize {
    let len = product.len();
    let is_period = |period: &usize| product.iter().zip(product.iter().skip(*period)).all(|(a, b)| a == b);
    let period = (1..len).filter(|period| len.is_multiple_of(*period)).find(is_period).unwrap_or(len);
    period + more_factors(len / period)
}

/// Does it name a stretch, or a function of pairs of them?
fn is_of_stretches(part: &Expression) -> bool {
    match &part.kind {
        ExpressionKind::Pairs(_) => true,
        ExpressionKind::Symbol(name) => matches!(numbered(&name.to_string()), Some(('q' | 'Q', _))),
        _ => false,
    }
}

/// The expression, and everything inside its functions, has no more summands than a build has time for.
///
/// # Errors
/// Reported on the first smallest part that has more.
pub(super) fn summands(expression: &Expression, n: usize, found: &mut Diagnostics) -> Result<(), Reported> {
    counted(expression, n, found).map(|_| ())
}

fn counted(expression: &Expression, n: usize, found: &mut Diagnostics) -> Result<Summands, Reported> {
    // The first part that is too large ends it: those that a trace was expanded to have the same place.
    let counts: Vec<Summands> = expression
        .operands()
        .into_iter()
        .map(|operand| counted(operand, n, found))
        .collect::<Result<_, _>>()?;
    let count = match (&expression.kind, counts.as_slice()) {
        (ExpressionKind::Binary(Operator::Add | Operator::Subtract, ..), [left, right]) => {
            Summands { above: left.above.saturating_add(right.above), ..ONE }
        }
        (ExpressionKind::Binary(Operator::Multiply, ..), [left, right]) => left.times(*right),
        (ExpressionKind::Binary(Operator::Divide, ..), [left, right]) => left.times(right.inverse()),
        (ExpressionKind::Negate(_), [of]) => *of,
        (ExpressionKind::Binary(Operator::Power, _, exponent), [base, ..]) => {
            integer(exponent, n).map_or(ONE, |exponent| base.power(exponent))
        }
        (ExpressionKind::Call(function, argument), [of]) => of.applied(*function, argument),
        (ExpressionKind::Pairs(_), [of]) => {
            Summands { above: of.above.saturating_mul(above_diagonal(n).count() as u64), ..ONE }
        }
        (ExpressionKind::Trace(factors), _) => Summands { above: of_trace(factors.len(), n), ..ONE },
        (ExpressionKind::PolynomialTrace(trace), _) => match &trace.products {
            Some(products) => counted(products, n, found)?,
            None => Summands { above: u64::MAX, ..ONE },
        },
        _ => ONE,
    };
    if count.above <= MOST_SUMMANDS {
        return Ok(count);
    }
    let limit = "512 summands when its products and powers are multiplied out";
    Err(found.report(expression.span, ExpressionMistake::ExpressionSize { limit }))
}

impl Summands {
    fn times(self, other: Self) -> Self {
        // sqrt(a) sqrt(a) = a
        let shared = self.root.min(other.root);
        Self {
            above: self.above.saturating_mul(other.above).saturating_mul(shared),
            below: self.below.saturating_mul(other.below),
            root: self.root.max(other.root),
            inside: 1,
        }
    }

    /// The inverse of a sum is a symbol of its own, until it is inverted again.
    fn inverse(self) -> Self {
        Self { above: self.below, below: self.above, ..self }
    }

    fn power(self, exponent: i32) -> Self {
        let base = if exponent < 0 { self.inverse() } else { self };
        let exponent = u64::from(exponent.unsigned_abs());
        let roots = of_power(self.root, exponent / 2);
        Self {
            above: of_power(base.above, exponent).saturating_mul(roots),
            below: of_power(base.below, exponent),
            root: if exponent % 2 == 1 { self.root } else { 1 },
            inside: 1,
        }
    }

    /// A function is a symbol of its own, until something undoes it.
    fn applied(self, function: Function, argument: &Expression) -> Self {
        let of = Self { inside: self.above, ..ONE };
        let before = match argument.kind {
            ExpressionKind::Call(function, _) => Some(function),
            _ => None,
        };
        match (function, before) {
            // Of what keeps its sign, and in even powers.
            (Function::Abs, _) => self,
            (Function::Exp, Some(Function::Ln)) | (Function::Ln, Some(Function::Exp)) => {
                Self { above: self.inside, ..of }
            }
            (Function::Sqrt, _) => Self { root: self.above, ..of },
            _ => of,
        }
    }
}

/// A sum over the inner indices.
fn of_trace(factors: usize, n: usize) -> u64 {
    let inner = u32::try_from(factors.saturating_sub(2)).unwrap_or(u32::MAX);
    u64::try_from(n).unwrap_or(u64::MAX).saturating_pow(inner)
}

/// Monomials of degree `k` in `m` variables, `(m + k - 1) over k`.
fn of_power(m: u64, k: u64) -> u64 {
    // Every factor but the last is divided out exactly: binomial coefficients of growing order.
    (1..=k).fold(1, |count: u64, j| count.saturating_mul(m.saturating_add(j - 1)) / j)
}

#[cfg(test)]
mod tests {
    use super::of_power;

    #[test]
    fn powers_of_sums() {
        assert_eq!([of_power(2, 3), of_power(3, 2), of_power(1, 64), of_power(7, 16)], [4, 6, 1, 74613]);
        assert!(of_power(u64::from(u32::MAX), 16) > 1 << 32, "no overflow");
    }
}
