//! The flows of the lattice's pieces as programs.

use crate::algebra::{Arena, Expr};
use crate::ir::Program;
use crate::mechanics::two_polar::{Piece, Pieces, Stable};
use crate::optimise::Batch;
use crate::symbol::{Aspect, Quantity, Symbol};

/// The pieces of a lattice.
pub struct PiecePrograms {
    /// The drift first.
    pub list: Vec<PieceProgram>,
    /// See [`Pieces`].
    pub nystrom: bool,
}

/// A piece of a lattice, with its exact flow.
pub struct PieceProgram {
    /// What it is, as text.
    pub name: String,
    /// Components that move at constant rates.
    pub shifted: Vec<Symbol>,
    /// Planes that turn at constant angular velocities, by angular velocity.
    pub turned: Vec<Vec<(Symbol, Symbol)>>,
    /// State -> the rates, then the angular velocities.
    pub program: Program,
}

impl PiecePrograms {
    pub(super) fn of(
        arena: &mut Arena,
        pieces: &Pieces,
        stable: &Stable,
        program: &mut impl FnMut(&mut Arena, &Batch) -> Program,
    ) -> Self {
        let list = pieces.list.iter().map(|piece| written(arena, piece, stable, program)).collect();
        Self { list, nystrom: pieces.nystrom }
    }
}

fn written(
    arena: &mut Arena,
    piece: &Piece,
    stable: &Stable,
    program: &mut impl FnMut(&mut Arena, &Batch) -> Program,
) -> PieceProgram {
    let shifted: Vec<Symbol> = piece.shifts.iter().map(|(z, _)| arena.symbol_of(*z)).collect();
    let rates = shifted.iter().zip(&piece.shifts);
    let mut results: Vec<_> =
        rates.map(|(z, (_, rate))| (z.clone().seen(Aspect::Rate), stable.rewritten(rate))).collect();
    for (k, turn) in piece.turns.iter().enumerate() {
        results.push((Quantity::Angular.at([k + 1]), stable.rewritten(&turn.angular)));
    }
    let shared = stable.shared.iter().chain(&piece.shared).cloned().collect();
    let batch = Batch { shared, results, ..Batch::default() }.pruned(arena);
    let planes = |(z, y): &(Expr, Expr)| (arena.symbol_of(*z), arena.symbol_of(*y));
    let turned = piece.turns.iter().map(|turn| turn.planes.iter().map(planes).collect()).collect();
    PieceProgram { name: piece.name.clone(), shifted, turned, program: program(arena, &batch) }
}
