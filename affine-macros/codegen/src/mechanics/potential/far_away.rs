//! The value of a potential far from the undeformed state, through `D` and the isochoric part of the placement.

use crate::algebra::arena::Node;
use crate::algebra::{Arena, Expr, Function, Polynomial};
use crate::mechanics::charts::Chart;
use crate::symbol::Quantity;

use super::Potential;
use super::base::Base;
use super::rewriting::{exponential_of_dilatation, multiple_of_logarithm};
use super::scaled::{collected, definitions, scaled_bases};
use super::sums::{Sizes, Sums};

/// Energies are multiplied out up to so many terms.
const MOST_TERMS: u32 = 256;

impl Potential {
    /// `U` for evaluation far from the undeformed state, with what it shares; `q`, `q_a` and `D` are inputs. `None` where
    /// [`energy_at_a_point`](Self::energy_at_a_point) is as good there: it is not with exponentials of logarithms, nor with
    /// logarithms that `q` is the opposite of.
    pub fn energy_far_away(
        &self,
        arena: &mut Arena,
        chart: &Chart,
    ) -> Option<(Polynomial, Vec<(Expr, Polynomial)>)> {
        let q = Base::MeanLogStretch.symbol(arena);
        let exponential =
            |function, of: Expr| function == Function::Exp && multiple_of_logarithm(arena, of).is_some();
        let logarithm = |function, _| function == Function::Ln;
        let differs = applies(arena, self.energy, &exponential)
            || applies(arena, self.energy, &logarithm)
                && arena.any_symbol(self.energy, &mut |symbol| symbol == q);
        if !differs {
            return None;
        }
        let d = arena.symbol(Quantity::Dilatation);
        let energy = exponential_of_dilatation(arena, self.energy);
        let scaled = scaled_bases(arena, self.dim, d);
        let energy = arena.substitute(energy, &|symbol| {
            scaled.iter().find(|(known, _)| *known == symbol).map(|(_, value)| *value)
        })?;
        let inverse = arena.pow(d, -1)?;
        let mut shared = definitions(arena, chart, inverse);
        let mut sums = Sums::default();
        let named = sums.named(arena, energy);
        // A power of `D` in a sum may have to cancel one beside it.
        let scaled = sums.known().iter().any(|(_, sum)| arena.any_symbol(*sum, &mut |symbol| symbol == d));
        if scaled && Sizes::default().of(arena, energy) <= MOST_TERMS {
            return Some((collected(arena, energy, d), shared));
        }
        let energy = named;
        shared.extend(sums.known().iter().map(|(symbol, sum)| (*symbol, collected(arena, *sum, d))));
        Some((collected(arena, energy, d), shared))
    }
}

/// Does it contain a function of an argument that is `wanted`?
fn applies(arena: &Arena, expr: Expr, wanted: &dyn Fn(Function, Expr) -> bool) -> bool {
    let own = matches!(*arena.node(expr), Node::Function(function, argument) if wanted(function, argument));
    own || arena.any_part(expr, &mut |part| applies(arena, part, wanted))
}
