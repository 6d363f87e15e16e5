//! Directions in the space of affine velocities, and bases of it.

use crate::algebra::Rational;
use crate::algebra::ring::above_diagonal;

/// A direction in the space of affine velocities.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BasisVector {
    /// Which subspace of the velocity space it belongs to.
    pub kind: Direction,
    /// Its nonzero entries: row-major index and weight.
    pub entries: Vec<(usize, Rational)>,
}

/// Subspaces of the velocity space that are invariant under rotations, or none.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Direction {
    /// Symmetric and traceless.
    Shear,
    /// Skew.
    Rotation,
    /// Multiples of the identity.
    Dilatation,
    /// A single entry.
    Entry,
}

impl BasisVector {
    pub(super) fn square(&self) -> Rational {
        self.entries.iter().fold(Rational::ZERO, |sum, (_, w)| &sum + &(w * w))
    }
}

/// The entries themselves.
pub(super) fn entries(count: usize) -> Vec<BasisVector> {
    (0..count).map(|k| BasisVector { kind: Direction::Entry, entries: vec![(k, Rational::ONE)] }).collect()
}

/// Symmetric traceless, skew and trace directions, orthogonal and rational.
pub(super) fn invariant(n: usize) -> Vec<BasisVector> {
    let one = || Rational::ONE;
    let mut basis = Vec::new();
    for (a, b) in above_diagonal(n) {
        for (kind, weight) in [(Direction::Shear, one()), (Direction::Rotation, Rational::MINUS_ONE)] {
            basis.push(BasisVector { kind, entries: vec![(n * a + b, one()), (n * b + a, weight)] });
        }
    }
    for a in 1..n {
        let mut entries: Vec<_> = (0..a).map(|b| (n * b + b, one())).collect();
        entries.push((n * a + a, -&Rational::whole(a)));
        basis.push(BasisVector { kind: Direction::Shear, entries });
    }
    basis.push(BasisVector {
        kind: Direction::Dilatation,
        entries: (0..n).map(|a| (n * a + a, one())).collect(),
    });
    basis
}
