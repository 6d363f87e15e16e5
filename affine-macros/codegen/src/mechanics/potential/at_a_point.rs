//! The value of a potential at a point, without cancellation near the undeformed state.

use crate::algebra::fault::never_missing;
use crate::algebra::ring::pairs;
use crate::algebra::{Arena, Expr, Polynomial, Rational};
use crate::mechanics::charts::Chart;
use crate::mechanics::metric::Definitions;
use crate::symbol::Quantity;

use super::Potential;
use super::base::Base;
use super::rewriting::about_undeformed;
use super::sums::Sums;
use super::tensors::{definitions, green};

impl Potential {
    /// `U` for evaluation at a point, with what it shares; `q` is an input. Near the undeformed state nothing
    /// cancels to first order: `exp(c q) = 1 + 2 sinh(c q/2)^2 + sinh(c q)`, `cosh` likewise, and the traces are
    /// counted from `n`, so that the constants go away exactly.
    pub fn energy_at_a_point(&self, arena: &mut Arena, chart: &Chart) -> (Polynomial, Definitions) {
        let (mut values, shared) = self.at_a_point(arena, chart, &[self.energy]);
        (never_missing(values.pop(), "one function has one value", Polynomial::zero()), shared)
    }

    /// The values of the functions that keep the state within the domain, with what they share; `q` and `q_a` are inputs.
    pub fn domain_at_a_point(
        &self,
        arena: &mut Arena,
        chart: &Chart,
    ) -> Option<(Vec<Polynomial>, Definitions)> {
        let values: Vec<Expr> = self.domain.iter().map(|guard| guard.value).collect();
        (!values.is_empty()).then(|| self.at_a_point(arena, chart, &values))
    }

    /// The same of any functions of the placement, of `x` and of the time.
    fn at_a_point(
        &self,
        arena: &mut Arena,
        chart: &Chart,
        values: &[Expr],
    ) -> (Vec<Polynomial>, Definitions) {
        let mut sums = Sums::default();
        let named: Vec<Expr> = values
            .iter()
            .map(|value| {
                let shifted = about_undeformed(arena, *value);
                sums.named(arena, shifted)
            })
            .collect();
        let n = Rational::whole(self.dim);
        let mut shared = definitions(arena, self.dim, chart);
        let (excesses, strains) = strain_traces(arena, chart);
        shared.extend(excesses);
        let mut moved = Vec::new();
        for (base, power, strain) in [(Base::Trace, 1, &strains[0]), (Base::TraceOfSquare, 2, &strains[1])] {
            let excess = arena.symbol(Quantity::Strain.at([power]));
            shared.push((excess, strain.clone()));
            let mut value = Polynomial::atom(excess);
            value.add_term(Vec::new(), &n);
            moved.push((base.symbol(arena), value));
        }
        let value = |atom: Expr| moved.iter().find(|(s, _)| *s == atom).map(|(_, v)| v.clone());
        let forms = sums.forms(arena).into_iter();
        shared.extend(forms.map(|(symbol, form)| (symbol, form.substitute(&value))));
        let values = named.into_iter().map(|value| Polynomial::normal_form(arena, value));
        (values.map(|form| form.substitute(&value)).collect(), shared)
    }
}

/// `tr G - n` and `tr G^2 - n` without cancellation near `phi = 1`: with `H = phi - 1`, a difference without rounding
/// there, `F = G - 1 = H + H^T + H^T H`, and they are `tr F` and `tr F^2 + 2 tr F`.
fn strain_traces(arena: &mut Arena, chart: &Chart) -> (Vec<(Expr, Polynomial)>, [Polynomial; 2]) {
    let n = chart.dim;
    let mut shared = Vec::new();
    let mut excess = vec![vec![Polynomial::zero(); n]; n];
    for (i, a) in pairs(n) {
        excess[i][a] = Polynomial::atom(chart.phi.0[i][a]);
        if i == a {
            let symbol = arena.symbol(Quantity::Excess.at([i + 1]));
            let mut difference = excess[i][a].clone();
            difference.add_term(Vec::new(), &Rational::MINUS_ONE);
            shared.push((symbol, difference));
            excess[i][a] = Polynomial::atom(symbol);
        }
    }
    let (mut trace, mut of_square) = (Polynomial::zero(), Polynomial::zero());
    for (a, b) in pairs(n) {
        let symbol = arena.symbol(Quantity::Strain.at([a.min(b) + 1, a.max(b) + 1]));
        if a <= b {
            let mut strain = green(&excess, a, b);
            strain.add_scaled(&excess[a][b], &Rational::ONE);
            strain.add_scaled(&excess[b][a], &Rational::ONE);
            shared.push((symbol, strain));
        }
        of_square.add_term(vec![symbol, symbol], &Rational::ONE);
        if a == b {
            trace.add_term(vec![symbol], &Rational::ONE);
        }
    }
    of_square.add_scaled(&trace, &Rational::from(2));
    (shared, [trace, of_square])
}
