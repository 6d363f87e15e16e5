//! `I2 = ((tr G)^2 - tr G^2)/2`, the sum of the principal minors of two rows, `det G` for n = 2: the difference of the squares loses digits where one stretch is long.

use crate::algebra::ring::above_diagonal;
use crate::algebra::{Arena, Expr, Polynomial, Rational};
use crate::mechanics::charts::{Chart, Momentum};
use crate::symbol::Quantity;

use super::Base;

/// The symbol of `I2`.
pub(super) fn symbol(arena: &mut Arena) -> Expr {
    arena.symbol(Quantity::SecondInvariant)
}

/// The polynomial with `2 I2` for `(tr G)^2 - tr G^2`, wherever that stands in it with one factor; `None` where it does not.
pub(super) fn through_second_invariant(arena: &mut Arena, form: &Polynomial) -> Option<Polynomial> {
    let [trace, of_square] = [Base::Trace, Base::TraceOfSquare].map(|base| base.symbol(arena));
    let mut difference = Polynomial::term(vec![trace; 2], Rational::ONE);
    difference.add_term(vec![of_square], &Rational::MINUS_ONE);
    let twice = Polynomial::term(vec![symbol(arena)], Rational::from(2));
    let shorter = form.by_names(&[(twice, difference)]);
    (shorter != *form).then_some(shorter)
}

/// `I2`, the sum of the principal minors of the tensor that a chart has.
pub(super) fn definition(arena: &mut Arena, chart: &Chart) -> (Expr, Polynomial) {
    let spatial = matches!(chart.momentum, Momentum::Space | Momentum::Total);
    let base: fn(usize, usize) -> Base = if spatial { Base::Finger } else { Base::Green };
    let mut sum = Polynomial::zero();
    let n = chart.dim;
    for (a, b) in above_diagonal(n) {
        let [aa, bb, ab] = [base(a, a), base(b, b), base(a, b)].map(|base| base.symbol(arena));
        sum.add_term(vec![aa, bb], &Rational::ONE);
        sum.add_term(vec![ab, ab], &Rational::MINUS_ONE);
    }
    (symbol(arena), sum)
}
