//! Programs of the two-polar form.

mod pieces;
mod ratios;

pub use pieces::{PieceProgram, PiecePrograms};
pub use ratios::RatioProgram;

use crate::algebra::bind::Constants;
use crate::algebra::{Arena, Expr, Polynomial, Rational};
use crate::ir::Program;
use crate::mechanics::describe::{Formula, Notation};
use crate::mechanics::hamiltonian::Hamiltonian;
use crate::mechanics::metric::Definitions;
use crate::mechanics::potential::{OnAxes, Potential};
use crate::mechanics::two_polar::{self, Equations, Frames, Lattice, Pieces, Ratios, Stable, Variables};
use crate::optimise::Batch;
use crate::symbol::{Asked, Aspect, Capability, Quantity, Symbol};

/// The two-polar form of a doubly isotropic model.
pub struct TwoPolar {
    /// What the places are.
    pub places: Variables,
    /// Symbols of the state, group after group.
    pub state: Vec<(Quantity, Vec<Symbol>)>,
    /// Symbols of the frames, beside the state.
    pub frames: Vec<(Quantity, Vec<Symbol>)>,
    /// Symbols of `M` and `N` where they are constants.
    pub couplings: Vec<Symbol>,
    /// State -> its rate.
    pub rates: Program,
    /// State and frames -> their rates.
    pub framed: Program,
    /// State -> `H`.
    pub energy: Program,
    /// The same far from the undeformed state, where that differs.
    pub energy_far_away: Option<Program>,
    /// `H` and the equations.
    pub formulas: (Formula, Vec<Formula>),
    /// Does the potential depend on `q = ln(det phi)/n` alone?
    pub dilatation_only: bool,
    /// Exact flows of its pieces, if asked for.
    pub pieces: Option<PiecePrograms>,
    /// Its equations in ratios of stretches, if asked for.
    pub ratios: Option<RatioProgram>,
}

/// Derives the programs of the lattice form, of U(n) or of GL(n).
pub(super) fn two_polar(
    arena: &mut Arena,
    notation: &Notation,
    h: &Hamiltonian,
    potential: Option<&Potential>,
    (unitary, asked): (bool, Asked),
    coefficients: &mut Constants,
) -> TwoPolar {
    let lattice = Lattice::of(arena, h, unitary);
    let mut equations = lattice.equations(arena, h);
    let keeps_volume = h.constraint.is_some();
    let (hamiltonian, balance) = two_polar::formulas(arena, notation, &equations, potential, keeps_volume);
    let printed = |sentence| notation.printed(arena, sentence);
    let formulas = (printed(&hamiltonian), balance.iter().map(printed).collect());
    let mut on_axes = potential.map(|u| u.on_axes(arena, &lattice));
    if let Some(on_axes) = on_axes.as_mut().filter(|_| keeps_volume) {
        on_axes.keep_volume();
    }
    if let Some(on_axes) = &on_axes {
        equations.add(on_axes);
    }
    let stable = Stable::new(arena, &lattice);
    let (place, momentum) = match lattice.variables {
        Variables::LogStretches | Variables::Angles => (Quantity::LogStretches, Quantity::LogStretchMomenta),
        Variables::Stretches => (Quantity::Stretches, Quantity::StretchMomenta),
    };
    let [q, p, m, n] =
        [&lattice.q, &lattice.p, &lattice.m, &lattice.n].map(|symbols| arena.symbols_of(symbols));
    let mut state = vec![(place, q), (momentum, p)];
    let couplings = match lattice.dim {
        2 => [m, n].concat(),
        _ => {
            state.extend([(Quantity::SumCouplings, m), (Quantity::DifferenceCouplings, n)]);
            Vec::new()
        }
    };
    let frames = Frames::new(arena, lattice.dim);
    let inputs: Vec<Expr> = [&lattice.q[..], &lattice.p, &lattice.m, &lattice.n, &frames.symbols()].concat();
    let mut program =
        |arena: &mut Arena, batch: &Batch| super::batch::program(arena, batch, coefficients, &inputs);
    let rates = rates(arena, &lattice, &equations, &stable, on_axes.as_ref());
    let framed = framed(arena, &frames, &equations, &stable, rates.clone());
    let near = energy(&equations, &stable, on_axes.as_ref().map(|u| &u.energy));
    let far_away = on_axes.as_ref().and_then(|u| u.energy_far_away.as_ref());
    let far_away = far_away.map(|value| energy(&equations, &stable, Some(value)));
    let ratios = match asked.has(Capability::Ratios) {
        true => Ratios::of(arena, &lattice, h).map(|form| RatioProgram::of(arena, &form)),
        false => None,
    };
    let pieces = match asked.has(Capability::Splitting) {
        true => Pieces::of(arena, &lattice, &frames, h, on_axes.as_ref()),
        false => None,
    };
    let pieces = pieces.map(|pieces| PiecePrograms::of(arena, &pieces, &stable, &mut program));
    TwoPolar {
        places: lattice.variables,
        couplings,
        rates: program(arena, &rates),
        framed: program(arena, &framed),
        energy: program(arena, &near),
        energy_far_away: far_away.map(|batch| program(arena, &batch)),
        frames: groups(arena, &frames),
        state,
        formulas,
        dilatation_only: potential.is_some_and(Potential::is_dilatational),
        pieces,
        ratios,
    }
}

/// The rates of the state; for `n = 2`, `M` and `N` do not move.
fn rates(
    arena: &Arena,
    lattice: &Lattice,
    equations: &Equations,
    stable: &Stable,
    potential: Option<&OnAxes>,
) -> Batch {
    let mut shared = stable.shared.clone();
    shared.extend(potential.map(|u| u.shared.clone()).unwrap_or_default());
    let moving = if lattice.dim == 2 { 4 } else { equations.rates.len() };
    let rate = |(_, symbol, rate): &(_, Expr, Polynomial)| {
        (arena.symbol_of(*symbol).seen(Aspect::Rate), stable.rewritten(rate))
    };
    Batch { shared, results: equations.rates.iter().take(moving).map(rate).collect(), ..Batch::default() }
}

/// `H` from the value of the potential and what that shares.
fn energy(equations: &Equations, stable: &Stable, potential: Option<&(Polynomial, Definitions)>) -> Batch {
    let mut shared = stable.shared.clone();
    let mut energy = stable.rewritten(&equations.kinetic);
    if let Some((value, its_shared)) = potential {
        shared.extend(its_shared.iter().cloned());
        energy.add_scaled(value, &Rational::ONE);
    }
    Batch { shared, results: vec![(Quantity::Energy.into(), energy)], ..Batch::default() }
}

/// Names of the frames' components.
fn groups(arena: &Arena, frames: &Frames) -> Vec<(Quantity, Vec<Symbol>)> {
    let [left, right] = [&frames.left, &frames.right].map(|symbols| arena.symbols_of(symbols));
    vec![(Quantity::LeftRotation, left), (Quantity::RightRotation, right)]
}

/// The rates of the frames beside those of the state.
fn framed(arena: &mut Arena, frames: &Frames, equations: &Equations, stable: &Stable, rates: Batch) -> Batch {
    let Batch { mut shared, mut results, .. } = rates;
    for (of, frame, angular) in [
        (Quantity::LeftAngular, &frames.left, &equations.chi),
        (Quantity::RightAngular, &frames.right, &equations.theta),
    ] {
        let symbols = arena.components(of, angular.len());
        shared.extend(symbols.iter().copied().zip(angular.iter().map(|p| stable.rewritten(p))));
        let symbols: Vec<Polynomial> = symbols.into_iter().map(Polynomial::atom).collect();
        for (k, entry) in frame.iter().enumerate() {
            let name = arena.symbol_of(*entry).seen(Aspect::Rate);
            results.push((name, frames.rate(frame, &symbols, k)));
        }
    }
    Batch { shared, results, ..Batch::default() }
}
