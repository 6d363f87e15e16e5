//! Components of momenta as formulas.

use crate::algebra::{Arena, Polynomial, Rational};
use crate::mechanics::conserved::{Candidate, Entry};
use crate::mechanics::notation::Notation;
use crate::symbol::{Quantity, Symbol};

/// A sum of multiples of entries of momenta: `Vort_12`.
pub fn component(arena: &mut Arena, notation: &Notation, entries: &[Entry]) -> String {
    let sum: Polynomial =
        entries.iter().map(|entry| written(arena, entry).scaled(&Rational::from(entry.factor))).sum();
    let sentence = notation.polynomial(arena, &sum);
    notation.text(arena, &sentence)
}

/// The entry as formulas write it: of angular momenta of which no entry has a symbol, by the products and entries that it is
/// made of.
fn written(arena: &mut Arena, Entry { of, row, column, .. }: &Entry) -> Polynomial {
    let (row, column) = (*row, *column);
    let mut atom = |symbol: Symbol| Polynomial::atom(arena.symbol(symbol));
    let one = match of {
        Candidate::OrbitalAngularMomentum => {
            let mut product =
                |i, j| atom(Quantity::Position.at([i])).mul(&atom(Quantity::LinearMomentum.at([j])));
            return product(row, column).sub(&product(column, row));
        }
        Candidate::TotalAngularMomentum => {
            let mut entry = |i, j| atom(Quantity::TotalAffineMomentum.at([i, j]));
            return entry(row, column).sub(&entry(column, row));
        }
        Candidate::LinearMomentum => Quantity::LinearMomentum.at([row]),
        Candidate::ComovingLinearMomentum => Quantity::ComovingLinearMomentum.at([row]),
        Candidate::Spin => Quantity::Spin.at([row, column]),
        Candidate::Vorticity => Quantity::Vorticity.at([row, column]),
        Candidate::ComovingAffineSpin => Quantity::ComovingAffineSpin.at([row, column]),
        Candidate::TotalAffineMomentum => Quantity::TotalAffineMomentum.at([row, column]),
        Candidate::CanonicalMomentum => Quantity::CanonicalMomentum.at([row, column]),
        _ => Quantity::AffineSpin.at([row, column]),
    };
    atom(one)
}
