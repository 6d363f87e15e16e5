//! The flow of friction alone: positions stay, and the momenta `z` of the chart fade linearly.
//!
//! ```text
//! z' = -A z, A a function of the positions      z -> exp(-h A) z      W -> W + T(exp(-h A) z) - T(z)
//! ```
//!
//! A momentum that fades apart from the others has a row of its own: `A` is taken in blocks.

use crate::algebra::kernel::{Callee, Group};
use crate::algebra::{Arena, Expr, Kernel, Polynomial, Rational};
use crate::mechanics::charts::Coordinate;
use crate::mechanics::equations::System;
use crate::mechanics::hamiltonian::Hamiltonian;
use crate::mechanics::reduction::Reduction;
use crate::symbol::Quantity;

use super::flows::{Flow, in_momenta};

type Rates = Vec<(Coordinate, Expr, Polynomial)>;

/// The flow of the system of the friction; `None` where it is not linear in the momenta.
pub(super) fn flow(
    arena: &mut Arena,
    h: &Hamiltonian,
    reduction: &Reduction,
    system: &System,
) -> Option<Flow> {
    let work = system.work.as_ref().map(|(symbol, _)| *symbol);
    let rates = in_momenta(arena, system);
    let energy = energy(h, reduction)?;
    let (mut kernels, mut rises): (Vec<Kernel>, Rates) = (Vec::new(), Vec::new());
    for (b, block) in blocks(&rates).into_iter().enumerate() {
        let momenta: Vec<Expr> = block.iter().map(|(_, symbol, _)| *symbol).collect();
        let matrix: Vec<Vec<Polynomial>> = block
            .iter()
            .map(|(.., rate)| momenta.iter().map(|z| rate.derivative(*z).neg()).collect())
            .collect();
        is_linear(&block, &momenta, &matrix).then_some(())?;
        let results = arena.components(Quantity::Faded.at([b + 1]), momenta.len());
        let time = Polynomial::atom(arena.symbol(Quantity::TimeOfFlow));
        let values = Polynomial::vector(&momenta);
        let arguments = vec![Group::Scalar(time), Group::Matrix(matrix), Group::Vector(values)];
        let rise = |((z, symbol, _), rise): (&(Coordinate, Expr, Polynomial), &Expr)| {
            (*z, *symbol, Polynomial::atom(*rise))
        };
        rises.extend(block.iter().zip(&results).map(rise));
        kernels.push(Kernel { callee: Callee::Fading, arguments, results: vec![Group::Vector(results)] });
    }
    if let Some(work) = work {
        rises.push((Coordinate::Carried(work), work, gain(&energy, &rises)));
    }
    let system = System { shared: system.shared.clone(), kernels, rates: rises, work: None };
    Some(Flow::Rise(system.tidied(arena)))
}

/// What the momenta of the state bring into `H`: what was split off does not fade.
fn energy(h: &Hamiltonian, reduction: &Reduction) -> Option<Polynomial> {
    let (chart, rotation) = (&reduction.chart, &reduction.commuting.rotation);
    let mut energy = h.internal_in(chart, rotation.is_some())?;
    energy.add_scaled(&h.translation_in(chart), &Rational::ONE);
    Some(chart.reduced(&energy).substitute(&reduction.gauge()))
}

/// `T(z + r) - T(z)` of a quadratic form.
fn gain(energy: &Polynomial, rises: &Rates) -> Polynomial {
    let mut sum = Polynomial::zero();
    for (_, z, rise) in rises {
        let slope = energy.derivative(*z);
        let mut mean = slope.clone();
        for (_, other, rise) in rises {
            mean.add_product(&slope.derivative(*other), rise, &Rational::HALF);
        }
        sum.add_product(&mean, rise, &Rational::ONE);
    }
    sum
}

/// Momenta that fade together, block by block.
fn blocks(rates: &Rates) -> Vec<Rates> {
    let mut blocks: Vec<Rates> = Vec::new();
    for one in rates {
        let reads = |rate: &Polynomial, symbol: Expr| !rate.derivative(symbol).is_zero();
        let coupled =
            |(_, symbol, rate): &(Coordinate, Expr, Polynomial)| reads(rate, one.1) || reads(&one.2, *symbol);
        let (together, apart): (Vec<Rates>, Vec<Rates>) =
            blocks.into_iter().partition(|block| block.iter().any(coupled));
        let mut joined: Rates = together.concat();
        joined.push(one.clone());
        blocks = apart;
        blocks.push(joined);
    }
    blocks
}

/// Are the rates `-A z`, with `A` free of momenta, and do nothing but momenta have one?
fn is_linear(block: &Rates, momenta: &[Expr], matrix: &[Vec<Polynomial>]) -> bool {
    block.iter().zip(matrix).all(|((z, _, rate), row)| {
        let mut rest = rate.clone();
        for (entry, momentum) in row.iter().zip(momenta) {
            rest.add_product(entry, &Polynomial::atom(*momentum), &Rational::ONE);
        }
        z.is_momentum()
            && rest.is_zero()
            && row.iter().all(|entry| !entry.mentions(|atom| momenta.contains(&atom)))
    })
}
