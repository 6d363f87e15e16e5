//! `I2 = ((tr G)^2 - tr G^2)/2 = tr cof G`, n = 3: the difference of the squares loses digits where one stretch is long.

use crate::algebra::{Arena, Expr, Polynomial, Rational};
use crate::mechanics::charts::{Chart, Momentum};

use super::Base;

/// Name of the symbol of `I2`.
pub(super) const NAME: &str = "second_invariant";

/// The polynomial with `2 I2` for `(tr G)^2 - tr G^2`, where it stands with one factor.
pub(super) fn through_second_invariant(arena: &mut Arena, form: &Polynomial) -> Polynomial {
    let [trace, of_square] = [Base::Trace, Base::TraceOfSquare].map(|base| base.symbol(arena));
    let mut result = form.clone();
    for (monomial, c) in form.terms() {
        let Some(rest) = without(monomial, &[trace, trace]) else { continue };
        let with = |atom: Expr| [rest.as_slice(), &[atom]].concat();
        let partner = Polynomial::term(with(of_square), Rational::ONE);
        let partner = partner.terms().next().map(|(monomial, _)| monomial.clone()).unwrap_or_default();
        let opposite = form.terms().any(|(other, k)| *other == partner && *k == -c);
        if opposite {
            let second = arena.symbol(NAME);
            result.add_term(monomial.clone(), &-c);
            result.add_term(partner, c);
            result.add_term(with(second), &(c + c));
        }
    }
    result
}

/// A sorted monomial without some of its atoms; `None` where it has not all of them.
fn without(monomial: &[Expr], atoms: &[Expr]) -> Option<Vec<Expr>> {
    let mut rest = monomial.to_vec();
    for atom in atoms {
        let place = rest.iter().position(|known| known == atom)?;
        rest.remove(place);
    }
    Some(rest)
}

/// `I2`, the sum of the principal minors of the tensor that a chart has.
pub(super) fn definition(arena: &mut Arena, chart: &Chart) -> (Expr, Polynomial) {
    let spatial = matches!(chart.momentum, Momentum::Space | Momentum::Total);
    let base: fn(usize, usize) -> Base = if spatial { Base::Finger } else { Base::Green };
    let mut sum = Polynomial::zero();
    for (a, b) in [(0, 1), (0, 2), (1, 2)] {
        let [aa, bb, ab] = [base(a, a), base(b, b), base(a, b)].map(|base| base.symbol(arena));
        sum.add_term(vec![aa, bb], &Rational::ONE);
        sum.add_term(vec![ab, ab], &Rational::MINUS_ONE);
    }
    (arena.symbol(NAME), sum)
}
