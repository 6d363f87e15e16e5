//! What is computed together: the rates of a system, and what a closed form reads.

use crate::algebra::bind::Constants;
use crate::algebra::fault::record;
use crate::algebra::ring::above_diagonal;
use crate::algebra::substitute::listed;
use crate::algebra::{Arena, Expr, Polynomial, Rational};
use crate::ir::Program;
use crate::ir::fuse::fuse;
use crate::mechanics::charts::Chart;
use crate::mechanics::equations::System;
use crate::mechanics::separation::{Separation, Slope};
use crate::optimise::{Batch, straight_line};
use crate::symbol::{Aspect, Quantity, Symbol};

/// The program of a batch over some inputs; what else it reads joins the coefficients.
pub(super) fn program(
    arena: &mut Arena,
    batch: &Batch,
    coefficients: &mut Constants,
    inputs: &[Expr],
) -> Program {
    fuse(&straight_line(arena, batch, coefficients, &|atom| inputs.contains(&atom)))
}

/// The program of results that have no coefficients, whatever they read.
pub(super) fn unbound(arena: &mut Arena, results: Vec<(Symbol, Polynomial)>) -> Program {
    let (batch, mut none) = (Batch { results, ..Batch::default() }, Constants::new(Quantity::Coefficient));
    let program = straight_line(arena, &batch, &mut none, &|_| true);
    if !none.entries.is_empty() {
        record("what reads everything has no coefficients");
    }
    fuse(&program)
}

/// The program of values over the fields alone.
pub(super) fn values(arena: &mut Arena, values: impl Iterator<Item = Polynomial>) -> Program {
    unbound(arena, numbered(Quantity::Value, values).collect())
}

/// Results by their numbers, from 1.
pub(super) fn numbered(
    of: Quantity,
    results: impl IntoIterator<Item = Polynomial>,
) -> impl Iterator<Item = (Symbol, Polynomial)> {
    (1..).map(move |k| of.at([k])).zip(results)
}

/// The rates, and the power where the work is part of the motion.
pub(super) fn batch(arena: &Arena, system: &System) -> Batch {
    let rates = system.rates.iter().map(|(_, symbol, rate)| (*symbol, rate));
    let work = system.work.iter().map(|(symbol, power)| (*symbol, power));
    Batch {
        shared: system.shared.clone(),
        kernels: system.kernels.clone(),
        results: rates
            .chain(work)
            .map(|(symbol, rate)| (arena.symbol_of(symbol).seen(Aspect::Rate), rate.clone()))
            .collect(),
    }
}

/// The system in symmetric and skew parts of the affine momentum, formed from its entries.
pub(super) fn split_batch(arena: &mut Arena, chart: &Chart, system: &System) -> Batch {
    let mut replaced: Vec<(Expr, Polynomial)> = Vec::new();
    let mut shared: Vec<(Expr, Polynomial)> = Vec::new();
    let half = Rational::HALF;
    for (a, b) in above_diagonal(chart.dim) {
        let (upper, lower) = (chart.m.0[a][b], chart.m.0[b][a]);
        let [symmetric, skew] = [Aspect::Symmetric, Aspect::Skew].map(|aspect| arena.about(aspect, upper));
        // s = (M_ab + M_ba)/2, w = M_ab - M_ba, so M_ab = s + w/2 and M_ba = s - w/2.
        let [entries, parts] = [[upper, lower], [symmetric, skew]].map(|pair| pair.map(Polynomial::atom));
        let half_skew = parts[1].scaled(&half);
        replaced.extend([(upper, parts[0].add(&half_skew)), (lower, parts[0].sub(&half_skew))]);
        let mean = entries[0].add(&entries[1]).scaled(&half);
        shared.extend([(symmetric, mean), (skew, entries[0].sub(&entries[1]))]);
    }
    let mut result = batch(arena, &system.substitute(&listed(&replaced)));
    result.shared.extend(shared);
    result
}

impl Separation {
    /// What the closed form of the dilatation reads: `1/m`, and the stiffness and scale of `U_dil'`.
    pub(super) fn batch(&self) -> Batch {
        let mut results = vec![(Quantity::InverseDilatationalMass.into(), self.inverse_mass.clone())];
        match &self.slope {
            Slope::Zero => {}
            Slope::Linear(stiffness) => results.push((Quantity::Stiffness.into(), stiffness.clone())),
            Slope::Hyperbolic { stiffness, scale } => {
                results.push((Quantity::Stiffness.into(), stiffness.clone()));
                results.push((Quantity::Scale.into(), Polynomial::constant(scale.clone())));
            }
        }
        Batch { results, ..Batch::default() }
    }
}
