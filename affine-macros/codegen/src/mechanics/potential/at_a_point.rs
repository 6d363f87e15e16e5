//! The value of a potential at a point, without cancellation near the undeformed state; and far from it, through `D` and the
//! isochoric part of the placement, or as it is written.

use std::iter::once;

use crate::algebra::arena::Node;
use crate::algebra::fault::never_missing;
use crate::algebra::ring::{dot, trace, upper};
use crate::algebra::substitute::listed;
use crate::algebra::{Arena, Expr, Function, Matrix, Polynomial, Rational};
use crate::mechanics::charts::Chart;
use crate::mechanics::metric::Definitions;
use crate::symbol::Quantity;

use super::Potential;
use super::base::Base;
use super::counting::{Counting, Forms};
use super::rewriting::{exponential_of_dilatation, multiple_of_logarithm};
use super::scaled::{self, collected, scaled_bases};
use super::sums::{Sizes, Sums};
use super::tensors::{definitions, green, own};

/// Energies, and what stands in their functions and divisors, are multiplied out up to so many terms.
const MOST_TERMS: u32 = 256;

impl Potential {
    /// `U` for evaluation at a point, with what it shares; `q` is an input. Near the undeformed state nothing
    /// cancels to first order: `exp(c q) = 1 + 2 sinh(c q/2)^2 + sinh(c q)`, `cosh` likewise, and where numbers cancel the
    /// traces are counted from `n`, so that they go away exactly.
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

    /// `U` for evaluation far from the undeformed state, with what it shares; `q`, `q_a` and `D` are inputs. `None` where
    /// [`energy_at_a_point`](Self::energy_at_a_point) is as good there.
    pub fn energy_far_away(&self, arena: &mut Arena, chart: &Chart) -> Option<(Polynomial, Definitions)> {
        if let Some((value, sums)) = self.far_away(arena, self.energy) {
            return Some((value, with_unit_part(arena, chart, sums)));
        }
        let (mut values, shared) = self.in_small_bodies(arena, chart, &[self.energy])?;
        Some((values.pop()?, shared))
    }

    /// The same for the functions of the domain: of each the sign matters, as that of a divisor.
    pub fn domain_far_away(
        &self,
        arena: &mut Arena,
        chart: &Chart,
    ) -> Option<(Vec<Polynomial>, Definitions)> {
        let differs = self.domain.iter().any(|guard| {
            // No constant keeps its sign alone.
            let divided = arena.reciprocal(guard.value);
            differs_far_away(arena, divided)
        });
        let values: Vec<Expr> = self.domain.iter().map(|guard| guard.value).collect();
        if !differs {
            return self.in_small_bodies(arena, chart, &values);
        }
        let (values, sums) = self.through_unit_part(arena, values.into_iter())?;
        Some((values, with_unit_part(arena, chart, sums)))
    }

    /// A form of the energy through `D` and functions of `Psi`, `phi = D Psi`, and the sums that it shares; `None` where what is
    /// counted from the undeformed state is as good far from it.
    pub(super) fn far_away(&self, arena: &mut Arena, energy: Expr) -> Option<(Polynomial, Definitions)> {
        if !differs_far_away(arena, energy) {
            return None;
        }
        let (mut values, sums) = self.through_unit_part(arena, once(energy))?;
        Some((values.pop()?, sums))
    }

    /// Functions of the placement, of `x` and of the time through `D` and functions of `Psi`, and the sums that they share.
    fn through_unit_part(
        &self,
        arena: &mut Arena,
        values: impl Iterator<Item = Expr>,
    ) -> Option<(Vec<Polynomial>, Definitions)> {
        let d = arena.symbol(Quantity::Dilatation);
        let scaled = scaled_bases(arena, self.dim, d);
        let mut sums = Sums::default();
        let (mut whole, mut named) = (Vec::new(), Vec::new());
        for value in values {
            let value = exponential_of_dilatation(arena, value);
            let value = arena.substitute(value, &listed(&scaled))?;
            whole.push(value);
            named.push(sums.named(arena, value));
        }
        let mut sizes = Sizes::default();
        let is_short = whole.iter().all(|value| sizes.of_largest_part(arena, *value) <= MOST_TERMS);
        let collected = |arena: &mut Arena, value: &Expr| collected(arena, *value, d);
        // A power of `D` in a sum may have to cancel one beside it.
        let scaled = sums.known().iter().any(|(_, sum)| arena.any_symbol(*sum, &mut |symbol| symbol == d));
        if scaled && is_short {
            return Some((whole.iter().map(|value| collected(arena, value)).collect(), Definitions::new()));
        }
        let shared = sums.known().iter().map(|(symbol, sum)| (*symbol, collected(arena, sum))).collect();
        Some((named.iter().map(|value| collected(arena, value)).collect(), shared))
    }

    /// The same of any functions of the placement, of `x` and of the time.
    fn at_a_point(
        &self,
        arena: &mut Arena,
        chart: &Chart,
        values: &[Expr],
    ) -> (Vec<Polynomial>, Definitions) {
        let counting = traces_counted(arena, self.dim);
        let Forms { values, sums } = Forms::new(arena, values).counted(arena, &counting);
        let mut shared = definitions(arena, &chart.placement(), own(chart), false);
        let (excesses, strains) = strain_traces(arena, chart);
        shared.extend(excesses);
        let symbols = [1, 2].map(|power| arena.symbol(Quantity::Strain.at([power])));
        shared.extend(symbols.into_iter().zip(strains));
        shared.extend(sums);
        (values, shared)
    }

    /// The same with no trace counted from `n`; `None` where that has no more digits in small bodies.
    fn in_small_bodies(
        &self,
        arena: &mut Arena,
        chart: &Chart,
        values: &[Expr],
    ) -> Option<(Vec<Polynomial>, Definitions)> {
        let counting = traces_counted(arena, self.dim);
        let forms = Forms::new(arena, values);
        if !forms.lose_small(arena, &counting) {
            return None;
        }
        let tensors = definitions(arena, &chart.placement(), own(chart), false);
        Some((forms.values, [tensors, forms.sums].concat()))
    }
}

/// `tr G` and `tr G^2`, counted from `n`: `-n` is what their differences are where the body vanishes.
fn traces_counted(arena: &mut Arena, dim: usize) -> Counting {
    let n = Rational::whole(dim);
    let moved = [1, 2].map(|power| {
        let excess = arena.symbol(Quantity::Strain.at([power]));
        let value = Polynomial::atom(excess).add(&Polynomial::constant(n.clone()));
        (Base::Trace(power).symbol(arena), value)
    });
    Counting::new(arena, dim, moved.into(), &-&n)
}

/// `tr G - n` and `tr G^2 - n` without cancellation near `phi = 1`: with `H = phi - 1`, a difference without rounding
/// there, `F = G - 1 = H + H^T + H^T H`, and they are `tr F` and `tr F^2 + 2 tr F`.
fn strain_traces(arena: &mut Arena, chart: &Chart) -> (Definitions, [Polynomial; 2]) {
    let n = chart.dim;
    let mut shared = Vec::new();
    let mut excess = chart.placement();
    for (a, symbol) in arena.components(Quantity::Excess, n).into_iter().enumerate() {
        shared.push((symbol, excess[a][a].sub(&Polynomial::constant(Rational::ONE))));
        excess[a][a] = Polynomial::atom(symbol);
    }
    let strain = Matrix::symmetric(arena, Quantity::Strain, n);
    for (a, b) in upper(n) {
        let value = green(&excess, a, b).add(&excess[a][b]).add(&excess[b][a]);
        shared.push((strain.0[a][b], value));
    }
    let strain = strain.atoms();
    let trace = trace(&strain);
    let of_square = dot(strain.iter().flatten().map(|entry| (entry, entry)));
    let of_square = of_square.add(&trace.scaled(&Rational::from(2)));
    (shared, [trace, of_square])
}

/// What functions of `Psi` read, and the sums of these.
fn with_unit_part(arena: &mut Arena, chart: &Chart, sums: Definitions) -> Definitions {
    let d = arena.symbol(Quantity::Dilatation);
    // A symbol is not the number zero.
    let inverse = arena.reciprocal(d);
    [scaled::definitions(arena, chart, inverse), sums].concat()
}

/// Does a function lose its digits far from the undeformed state where it is counted from that? It does with exponentials of
/// logarithms, with logarithms that `q` is the opposite of, with traces over what vanishes with them, and with sums of traces
/// without a constant that are raised to a power.
fn differs_far_away(arena: &mut Arena, value: Expr) -> bool {
    let mut sums = Sums::default();
    sums.named(arena, value);
    let arena = &*arena;
    let has = |of: Expr, wanted: &[Quantity]| {
        arena.any_symbol(of, &mut |symbol| arena.quantity(symbol).is_some_and(|of| wanted.contains(&of)))
    };
    let scaled = [Quantity::Trace, Quantity::Green, Quantity::Finger, Quantity::Placement];
    let logarithm = contains(arena, value, &|node| matches!(node, Node::Function(Function::Ln, _)));
    let loses = |node: &Node| match node {
        Node::Function(Function::Exp, of) => multiple_of_logarithm(arena, *of).is_some(),
        Node::Product(factors) => {
            factors.iter().any(|(base, k)| *k > 0 && has(*base, &[Quantity::Trace]))
                && factors.iter().any(|(base, k)| *k < 0 && has(*base, &scaled))
        }
        _ => false,
    };
    let vanishes = |sum: Expr| matches!(arena.node(sum), Node::Sum(constant, _) if constant.is_zero());
    contains(arena, value, &loses)
        || logarithm && has(value, &[Quantity::MeanLogStretch])
        || sums.known().iter().any(|(_, sum)| vanishes(*sum) && has(*sum, &[Quantity::Trace]))
}

/// Is it or a part of it `wanted`?
fn contains(arena: &Arena, expr: Expr, wanted: &dyn Fn(&Node) -> bool) -> bool {
    wanted(arena.node(expr)) || arena.any_part(expr, &mut |part| contains(arena, part, wanted))
}
