//! What does not go with a constraint.

use super::message::{Text, text};
use super::names::names;

/// What does not go with a constraint.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ConstraintMistake {
    /// A term that is zero wherever the constraint holds.
    VanishingTerm {
        /// The term.
        term: &'static str,
        /// The constraint.
        constraint: &'static str,
        /// What it is a form of: `affine velocities`, `affine momenta`.
        of: &'static str,
        /// What they are under it: `traceless`, `skew`.
        directions: &'static str,
    },
    /// A potential that is constant, or has no value, wherever the constraint holds.
    ConstrainedPotential {
        /// `is constant`, `has no value`.
        defect: &'static str,
        /// The constraint.
        constraint: &'static str,
        /// The group: `det phi = 1`.
        group: &'static str,
    },
}

names! { ConstraintMistake
    VanishingTerm => "vanishing-term",
    ConstrainedPotential => "constrained-potential",
}

impl ConstraintMistake {
    pub(super) fn text(&self) -> Text {
        match self {
            Self::VanishingTerm { term, constraint, of, directions } => text(
                format!("`{term}` is zero under `constraint = {constraint}`"),
                format!("{of} are {directions} there, and it is zero on all of them"),
                format!("remove `{term}` or the constraint"),
            ),
            Self::ConstrainedPotential { defect, constraint, group } => text(
                format!("this potential {defect} under `constraint = {constraint}`"),
                match *constraint {
                    "rigid" => format!("{group}: q = 0, det phi = 1, and G and Ct are the identity"),
                    "conformal" => format!("{group}: G and Ct are exp(2q) times the identity"),
                    _ => format!("{group}: q = 0 and D = 1"),
                },
                match *defect {
                    "is constant" => "remove the potential or the constraint",
                    _ => "write a potential that is finite there, or remove the constraint",
                },
            ),
        }
    }
}
