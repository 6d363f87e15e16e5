//! Quantities with their definitions, and those of `phi^-1`.

use crate::algebra::ring::{Square, adjugate, determinant, table};
use crate::algebra::{Arena, Expr, Matrix, Polynomial};
use crate::symbol::Quantity;

/// Quantities with their definitions, each in earlier ones.
pub type Definitions = Vec<(Expr, Polynomial)>;

/// Adds definitions of what has none yet. Two may define a quantity that they share; either definition has its value.
pub fn share(known: &mut Definitions, definitions: impl IntoIterator<Item = (Expr, Polynomial)>) {
    for (symbol, definition) in definitions {
        if known.iter().all(|(other, _)| *other != symbol) {
            known.push((symbol, definition));
        }
    }
}

/// `phi^-1 = adj(phi)/det phi`, entry `[A][i]`, as quantities with their definitions.
pub fn inverse_placement(arena: &mut Arena, dim: usize) -> (Matrix, Definitions) {
    let phi = Matrix::symbols(arena, Quantity::Placement, dim);
    let phi: Square<Polynomial> = table(dim, |i, a| Polynomial::atom(phi.0[i][a]));
    let (det, inverse_det) =
        (arena.symbol(Quantity::Determinant), arena.symbol(Quantity::InverseDeterminant));
    let cofactors = adjugate(&phi);

    // A symbol is not the number zero.
    let reciprocal = Polynomial::atom(arena.reciprocal(det));
    let mut shared = vec![(det, determinant(&phi)), (inverse_det, reciprocal)];
    let inverse = Matrix::symbols(arena, Quantity::InversePlacement, dim);
    for (symbol, cofactor) in inverse.0.iter().flatten().zip(cofactors.iter().flatten()) {
        shared.push((*symbol, cofactor.mul(&Polynomial::atom(inverse_det))));
    }
    (inverse, shared)
}
