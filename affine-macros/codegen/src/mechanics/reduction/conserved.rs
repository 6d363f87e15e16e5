//! Momenta that are conserved: they are constants of a trajectory.

use crate::algebra::passage::{Constant, Extent, Tensor, Word};
use crate::algebra::{Arena, Expr, Polynomial};
use crate::mechanics::charts::{Chart, Coordinate};
use crate::mechanics::equations::System;
use crate::symbol::Symbol;

use super::left_out::{LeftOut, Scope};

/// Momenta of a chart that are conserved.
#[derive(Clone, Debug, Default)]
pub struct Conserved {
    /// `p`.
    pub linear: bool,
    /// All of the affine momentum.
    pub affine: bool,
    /// Components of the affine momentum, in turned space, while others are state.
    pub components: Vec<Expr>,
}

impl Conserved {
    /// Takes `p` out of a system, and the affine momentum if it `may_rest`, each where all of it is conserved.
    pub(super) fn of(chart: &Chart, system: &mut System, may_rest: bool) -> Self {
        let rests = |momentum: fn(Coordinate) -> bool| {
            system.rates.iter().all(|(z, _, rate)| !momentum(*z) || rate.is_zero())
        };
        let linear = rests(|z| matches!(z, Coordinate::P(_)));
        let affine = may_rest && rests(|z| matches!(z, Coordinate::M(..)));
        system.rates.retain(|(z, ..)| match z {
            Coordinate::P(_) => !linear,
            Coordinate::M(..) => !affine,
            Coordinate::X(_) | Coordinate::Phi(..) | Coordinate::Carried(_) => true,
        });
        Self { linear: chart.linear.is_some() && linear, affine, components: Vec::new() }
    }

    /// Takes components of the affine momentum that are conserved out of a system.
    pub(super) fn with_components(mut self, system: &mut System) -> Self {
        system.rates.retain(|(z, symbol, rate): &(_, _, Polynomial)| {
            let still = matches!(z, Coordinate::M(..)) && rate.is_zero();
            self.components.extend(still.then_some(*symbol));
            !still
        });
        self
    }

    /// Components that are constants, while others are state.
    pub(super) fn fixed(&self, arena: &Arena) -> Vec<Symbol> {
        arena.symbols_of(&self.components)
    }

    /// What is kept of the affine momentum.
    pub(super) fn constants(&self, arena: &Arena) -> Vec<Constant> {
        let fixed = self.fixed(arena);
        let names: Vec<String> = fixed.iter().map(Symbol::to_string).collect();
        let meaning = format!("Conserved components of the affine momentum: {}.", names.join(", "));
        let whole = Constant::new(Word::Momentum, Extent::Matrix, "Conserved affine momentum.");
        let components = Constant::new(Word::Fixed, Extent::List(fixed.len()), meaning);
        let some = !fixed.is_empty();
        let components = some.then(|| components.starting(Tensor::List(fixed)));
        self.affine.then_some(whole).into_iter().chain(components).collect()
    }

    /// `turns` where a flow that is applied exactly turns the affine momentum of the chart.
    pub(super) fn left_out(&self, chart: &Chart, turns: bool) -> Option<LeftOut> {
        let by_what = if turns { "conserved by the rest of H" } else { "conserved" };
        let name = chart.momentum.symbol();
        self.affine.then(|| Scope::Reduction.without(format!("{name}: {by_what}")))
    }
}
