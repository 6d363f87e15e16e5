//! The energy of one matrix that is known when the model is prepared: `1/2 tr(X^T J^-1 X)`.

use super::{Notation, Sentence, momentum, velocity};
use crate::algebra::ring::{self, pairs};
use crate::algebra::{Arena, Expr, Polynomial, Rational};
use crate::mechanics::charts::Momentum;
use crate::mechanics::hamiltonian::Hamiltonian;
use crate::mechanics::kinetic::Kinetic;
use crate::mechanics::notation::{MatrixName, half, product, trace};
use crate::mechanics::term::Coefficient;

/// Energy and velocity through the inverse of a matrix.
pub(super) struct Inertial {
    /// `1/2 tr(X^T J^-1 X)`.
    pub(super) energy: Sentence,
    /// `O = X^T J^-1`, both sides.
    pub(super) velocity: [Sentence; 2],
    /// Entry by entry, since the matrix is one of pairs of indices?
    on_pairs: bool,
}

impl Inertial {
    /// Is the velocity a product of matrices?
    pub(super) fn is_on_rows(&self) -> bool {
        !self.on_pairs
    }
}

/// The energy through the inverse of the matrix of its one term, where that has no more than entries of which the inverse
/// needs numbers and numbers; compared entry by entry with the velocity that was derived.
pub(super) fn inertial(
    arena: &mut Arena,
    notation: &Notation,
    h: &Hamiltonian,
    kinetic: &Kinetic,
) -> Option<Inertial> {
    if h.numeric_blocks.is_empty() || h.constraint.is_some() || h.weight.is_some() {
        return None;
    }
    let mut terms = kinetic.terms.iter().filter(|term| term.kind.translation_frame().is_none());
    let (Some(term), None) = (terms.next(), terms.next()) else { return None };
    let Coefficient::Matrix(matrix) = &term.value else { return None };
    let name = notation.matrix_name(arena, &matrix.0);
    let tensor = term.kind.is_tensor();
    let inverse = if tensor { h.slopes() } else { inverse_on_rows(h)? };
    is_inverse(arena, notation, (&name, &matrix.0), &inverse).then(|| {
        let momentum = Momentum::of(h.frame);
        if tensor { on_pairs(arena, &name, momentum) } else { on_rows(arena, &name, momentum) }
    })
}

/// `c` of an energy `c/2 tr(X^T X)` over momenta that nothing confines.
pub(super) fn scalar_inverse(h: &Hamiltonian) -> Option<Polynomial> {
    if h.constraint.is_some() || h.weight.is_some() {
        return None;
    }
    let inverse = inverse_on_rows(h)?;
    (inverse == ring::scalar(h.dim, &inverse[0][0])).then(|| inverse[0][0].clone())
}

/// `J^-1` of `O = X^T J^-1`, where every row of `O` has the same.
fn inverse_on_rows(h: &Hamiltonian) -> Option<Vec<Vec<Polynomial>>> {
    let n = h.dim;
    let whole = h.slopes();
    let inverse: Vec<Vec<Polynomial>> = whole[..n].iter().map(|row| row[..n].to_vec()).collect();
    let fits = |k: usize, l: usize| match k / n == l / n {
        true => whole[k][l] == inverse[k % n][l % n],
        false => whole[k][l].is_zero(),
    };
    pairs(n * n).all(|(k, l)| fits(k, l)).then_some(inverse)
}

/// Is it the inverse of the matrix: its entries by name, or numbers and reciprocals whose product with the matrix is 1?
fn is_inverse(
    arena: &mut Arena,
    notation: &Notation,
    (name, matrix): (&MatrixName, &[Vec<Expr>]),
    inverse: &[Vec<Polynomial>],
) -> bool {
    let places = || pairs(matrix.len());
    let named = |i: usize, j: usize| {
        let atom = inverse[i][j].as_atom();
        atom.is_some_and(|atom| notation.is_inverse_entry(atom, name, (i + 1, j + 1)))
    };
    let by_name: Vec<bool> = (0..matrix.len()).map(|i| (0..matrix.len()).any(|j| named(i, j))).collect();
    places().all(|(i, j)| match (by_name[i], by_name[j]) {
        (true, true) => named(i, j) || inverse[i][j].is_zero(),
        (true, false) | (false, true) => inverse[i][j].is_zero(),
        (false, false) => {
            let zero = arena.constant(Rational::ZERO);
            let product = (0..matrix.len()).fold(zero, |sum, k| {
                let factor = inverse[k][j].expression(arena);
                let term = arena.mul(matrix[i][k], factor);
                arena.add(sum, term)
            });
            let expected = if i == j { Rational::ONE } else { Rational::ZERO };
            Polynomial::normal_form(arena, product) == Polynomial::constant(expected)
        }
    })
}

/// `1/2 tr(X^T J^-1 X)` and `O = X^T J^-1`.
fn on_rows(arena: &mut Arena, j: &MatrixName, of: Momentum) -> Inertial {
    let inverse = || Sentence::Matrix(j.inverse());
    let energy = trace(product([momentum(of).transposed(), inverse(), momentum(of)]));
    Inertial {
        energy: half(arena, energy),
        velocity: [velocity(of).into(), product([momentum(of).transposed(), inverse()])],
        on_pairs: false,
    }
}

/// `1/2 K^-1[(A,B),(C,D)] X[B,A] X[D,C]` and `O[A,B] = K^-1[(A,B),(C,D)] X[D,C]`.
fn on_pairs(arena: &mut Arena, k: &MatrixName, of: Momentum) -> Inertial {
    let inverse = || Sentence::Matrix(k.inverse()).entry(&[['A', 'B'], ['C', 'D']]);
    let energy = product([inverse(), momentum(of).entry(&[['B', 'A']]), momentum(of).entry(&[['D', 'C']])]);
    Inertial {
        energy: half(arena, energy),
        velocity: [
            Sentence::from(velocity(of)).entry(&[['A', 'B']]),
            product([inverse(), momentum(of).entry(&[['D', 'C']])]),
        ],
        on_pairs: true,
    }
}
