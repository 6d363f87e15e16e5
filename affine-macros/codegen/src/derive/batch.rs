//! What is computed together: the rates of a system, and what a closed form reads.

use crate::algebra::ring::above_diagonal;
use crate::algebra::{Arena, Expr, Polynomial, Rational};
use crate::mechanics::charts::Chart;
use crate::mechanics::equations::System;
use crate::mechanics::separation::{Separation, Slope};
use crate::optimise::Batch;
use crate::symbol::{Aspect, Quantity};

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
        let combined = |x: Expr, y: Expr, weight: &Rational| {
            let mut sum = Polynomial::atom(x);
            sum.add_term(vec![y], weight);
            sum
        };
        replaced.push((upper, combined(symmetric, skew, &half)));
        replaced.push((lower, combined(symmetric, skew, &-&half)));
        shared.push((symmetric, combined(upper, lower, &Rational::ONE).scaled(&half)));
        shared.push((skew, combined(upper, lower, &Rational::MINUS_ONE)));
    }
    let value =
        |atom: Expr| replaced.iter().find(|(symbol, _)| *symbol == atom).map(|(_, value)| value.clone());
    let mut result = batch(arena, &system.substitute(&value));
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
