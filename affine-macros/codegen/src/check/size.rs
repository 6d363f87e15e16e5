//! How many summands an expression has once its products and powers are multiplied out.

use super::constant::integer;
use crate::diagnostics::{Diagnostics, ExpressionMistake, Reported};
use crate::spec::{Expression, ExpressionKind};

/// Polynomials are derived, factored and scheduled in a time that grows faster than their number of summands; energies have
/// tens of them. A power of a sum has `(m + k - 1) over k`, and one of degree 16 in seven variables 74613.
const MOST_SUMMANDS: u64 = 512;

/// An upper bound of the number of summands, of the expression and of everything inside its functions.
///
/// # Errors
/// Reported on the first smallest part that has more than a build has time for.
pub(super) fn summands(expression: &Expression, n: usize, found: &mut Diagnostics) -> Result<u64, Reported> {
    // The first part that is too large ends it: those that a trace was expanded to have the same place.
    let counts: Vec<u64> = expression
        .operands()
        .into_iter()
        .map(|operand| summands(operand, n, found))
        .collect::<Result<_, _>>()?;
    let count = match (&expression.kind, counts.as_slice()) {
        (ExpressionKind::Add(..) | ExpressionKind::Subtract(..), [left, right]) => {
            left.saturating_add(*right)
        }
        (ExpressionKind::Multiply(..), [left, right]) => left.saturating_mul(*right),
        // The inverse of a sum is a symbol of its own.
        (ExpressionKind::Negate(_) | ExpressionKind::Divide(..), [first, ..]) => *first,
        (ExpressionKind::Power(_, exponent), [base, ..]) => match integer(exponent, n) {
            Some(power @ 1..) => of_power(*base, u64::from(power.unsigned_abs())),
            _ => 1,
        },
        // A sum over the inner indices.
        (ExpressionKind::Trace(factors), _) => {
            let inner = u32::try_from(factors.len().saturating_sub(2)).unwrap_or(u32::MAX);
            u64::try_from(n).unwrap_or(u64::MAX).saturating_pow(inner)
        }
        _ => 1,
    };
    if count <= MOST_SUMMANDS {
        return Ok(count);
    }
    let limit = "512 summands when its products and powers are multiplied out";
    Err(found.report(expression.span, ExpressionMistake::ExpressionSize { limit }))
}

/// Monomials of degree `k` in `m` variables, `(m + k - 1) over k`.
fn of_power(m: u64, k: u64) -> u64 {
    // Every factor but the last is divided out exactly: binomial coefficients of growing order.
    (1..=k).fold(1, |count: u64, j| count.saturating_mul(m + j - 1) / j)
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
