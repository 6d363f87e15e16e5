//! Capabilities that a model does not have.

use super::message::{Text, text};
use super::names::names;

/// A capability that the model does not have.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CapabilityMistake {
    /// A capability beside something that it does not exist for.
    CapabilityBeside {
        /// The capability.
        capability: &'static str,
        /// The other thing.
        beside: &'static str,
    },
    /// `emit(splitting)` for a Hamiltonian without pieces whose flows are known.
    NoExactPieces {
        /// What stands against it.
        beside: String,
        /// The reason.
        why: String,
    },
    /// A capability that this version does not have.
    UnavailableCapability {
        /// The capability.
        capability: &'static str,
        /// What it will give.
        gives: &'static str,
    },
    /// `two_polar` for a model that rotations of space or body change.
    NotDoublyIsotropic {
        /// What they change: a term, or the potential.
        part: String,
        /// `space` or `body`.
        side: &'static str,
        /// The rotation or reflection.
        transformation: String,
    },
    /// A part that U(n) does not have.
    UnitaryTerm {
        /// A term, `potential`, or a capability.
        part: &'static str,
    },
    /// `two_polar` for a model with what the lattice does not have.
    LatticeWithout {
        /// What the model has.
        part: String,
        /// What the lattice has not.
        lacks: &'static str,
    },
}

names! { CapabilityMistake
    CapabilityBeside => "capability-beside",
    NoExactPieces => "no-exact-pieces",
    UnavailableCapability => "unavailable-capability",
    NotDoublyIsotropic => "not-doubly-isotropic",
    UnitaryTerm => "unitary-term",
    LatticeWithout => "lattice-without",
}

impl CapabilityMistake {
    pub(super) fn text(&self) -> Text {
        match self {
            Self::CapabilityBeside { capability, beside } => text(
                format!("`emit({capability})` does not go with {beside} in this version"),
                "its recurrences follow from the operations of one autonomous right-hand side",
                format!(
                    "remove `{capability}` from `emit(...)`: Runge-Kutta and Gauss methods integrate the model"
                ),
            ),
            Self::NoExactPieces { beside, why } => text(
                format!("`emit(splitting)` does not go with {beside}"),
                why.clone(),
                "remove `splitting` from `emit(...)`: Gauss collocation is symmetric and integrates the model",
            ),
            Self::UnavailableCapability { capability, gives } => text(
                format!("the capability `{capability}` is not available in this version"),
                format!(
                    "it will give {gives}; this version emits the default, Hamilton's equations, `splitting`, `taylor`, \
                      `two_polar` and `lanes`"
                ),
                format!("remove `{capability}` from `emit(...)`"),
            ),
            Self::NotDoublyIsotropic { part, side, transformation } => text(
                format!("`two_polar` needs a doubly isotropic model, and {part} is not isotropic in {side}"),
                format!(
                    "{transformation} of {side} changes it: the motion of the stretches in phi = L D R^T then depends \
                     on the frames L and R, and (q, p, M, N) do not form a system of their own, (6.2) to (6.5)"
                ),
                format!(
                    "remove `two_polar` from `emit(...)`, or state a model that rotations of {side} do not change"
                ),
            ),
            Self::UnitaryTerm { part } => text(
                format!("`{part}` has no place beside `group = unitary`"),
                "on U(n) the energy is -A/2 tr Om^2 - B/2 (tr Om)^2 (89), which U(n) leaves unchanged from both sides; it is \
                 emitted as its lattice on the circle and nothing else",
                format!("remove `{part}`, and keep `casimir2` and `casimir1_squared`"),
            ),
            Self::LatticeWithout { part, lacks } => text(
                format!("`two_polar` with {part}: the lattice has no {lacks}"),
                "(q, p, M, N) of (6.2) to (6.5) describe the internal motion on GL(n) alone, of an energy in velocities, in \
                 orthonormal coordinates",
                format!("remove `two_polar` from `emit(...)`, or state a model without {part}"),
            ),
        }
    }
}
