//! What `prepare()` asks of the values of the fields.

use crate::algebra::Rational;
use crate::ir::Program;
use crate::mechanics::direction::Direction;
use crate::symbol::Symbol;

/// A quantity that must not vanish once the fields have values.
pub struct Condition {
    /// What must not vanish.
    pub factor: Factor,
    /// Which velocities lose their momentum, or which momenta their velocity.
    pub directions: &'static str,
    /// Is it a factor of velocities, or of momenta?
    pub relation: Relation,
    /// Must it be positive?
    pub positive: bool,
    /// Computes the value, then the terms whose sizes make the threshold.
    pub program: Program,
}

/// A factor between velocities and momenta, by name: all eigenvalues share a threshold, masses have another, and a minor, whose
/// unit is that of no other, its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Factor {
    /// `I + A`.
    Eigenvalue(&'static str),
    /// `m`, `1/m`.
    Mass(&'static str),
    /// A leading minor of `J`.
    Minor,
}

impl Factor {
    /// The name in messages of `prepare()`, without what it is a factor of.
    pub fn name(self) -> &'static str {
        match self {
            Self::Eigenvalue(name) | Self::Mass(name) => name,
            Self::Minor => "a leading minor of J",
        }
    }
}

/// The eigenvalue of an isotropic form on an invariant subspace of velocities, and what these are.
pub(super) fn eigenvalue(on: Direction) -> Option<(&'static str, &'static str)> {
    match on {
        Direction::Shear => Some(("I + A", "symmetric traceless velocities (shear)")),
        Direction::Rotation => Some(("I - A", "skew velocities (rotation)")),
        Direction::Dilatation => Some(("I + A + n B", "multiples of the identity (dilatation)")),
        Direction::Entry => None,
    }
}

/// What an eigenvalue is a factor of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    /// The momentum is the eigenvalue times the velocity.
    MomentumOfVelocity,
    /// The velocity is the eigenvalue times the momentum.
    VelocityOfMomentum,
}

/// A block to be inverted, or looked at, in numbers.
pub struct NumericBlock {
    /// Computes the upper triangle, row after row, then the terms whose sizes make the threshold.
    pub program: Program,
    /// Names of the entries of the inverse, upper triangle, row after row.
    pub inverse: Vec<Symbol>,
    /// The velocities that it is written in: row-major places and weights.
    pub basis: Vec<Vec<(usize, Rational)>>,
    /// Number of rows of the block.
    pub size: usize,
    /// Must it be positive definite?
    pub positive: bool,
}
