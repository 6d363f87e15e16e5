//! The words that arguments begin with, and how each may look.

use super::momentum_side::MomentumKind;
use super::names::{Named, named, set_of_names};
use crate::symbol::TermKind;

/// A word that an argument begins with.
pub(super) trait Keyword: Named + PartialEq {
    /// Does a list in parentheses follow it, and no `= value`?
    fn takes_list(self) -> bool {
        false
    }
}

impl Keyword for Side {}
impl Keyword for TermKind {}
impl Keyword for MomentumKind {}

impl Keyword for Key {
    /// As its example shows.
    fn takes_list(self) -> bool {
        self.example().starts_with(&format!("{}(", self.name()))
    }
}

set_of_names! {
    /// The keys of `affine_model(...)`.
    pub(super) enum Key {
        Dim = "dim",
        Symmetry = "symmetry",
        Kinetic = "kinetic",
        Hamiltonian = "hamiltonian",
        Metrics = "metrics",
        Constraint = "constraint",
        Group = "group",
        Potential = "potential",
        Dissipation = "dissipation",
        Forces = "forces",
        Require = "require",
        Emit = "emit",
        Crate = "crate",
    }
}

impl Key {
    /// How an entry with it may look.
    pub(super) fn example(self) -> &'static str {
        match self {
            Self::Dim => "dim = 3",
            Self::Symmetry => "symmetry(space = affine, body = metric)",
            Self::Kinetic => "kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1)",
            Self::Hamiltonian => {
                "hamiltonian(casimir2 = 5/6, casimir1_squared = -1/18, vorticity_squared = 25/24)"
            }
            Self::Metrics => "metrics(space = diag(1, 1, 2), body = [[2, 1, 0], [1, 2, 0], [0, 0, 1]])",
            Self::Constraint => "constraint = isochoric",
            Self::Group => "group = unitary",
            Self::Potential => "potential = kappa/2*sinh(q)^2",
            Self::Dissipation => "dissipation(body_inertia = 0.1, casimir2 = 0.1)",
            Self::Forces => "forces = custom(wind, spatial)",
            Self::Require => "require(positive_definite)",
            Self::Emit => "emit(taylor)",
            Self::Crate => "crate = ::affine_runtime",
        }
    }
}

set_of_names! {
    /// The sides of `symmetry(...)`.
    pub(super) enum Side {
        Space = "space",
        Body = "body",
    }
}
