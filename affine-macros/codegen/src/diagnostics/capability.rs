//! Capabilities that a model does not have.

use super::message::{Text, text};
use super::names::names;

/// A capability that the model does not have.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CapabilityMistake {
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
    /// A potential of more than angles beside `group = unitary`.
    UnitaryPotential,
    /// `ratios` without `two_polar`.
    RatiosAlone,
}

names! { CapabilityMistake
    NotDoublyIsotropic => "not-doubly-isotropic",
    UnitaryTerm => "unitary-term",
    UnitaryPotential => "unitary-potential",
    RatiosAlone => "ratios-alone",
}

impl CapabilityMistake {
    pub(super) fn text(&self) -> Text {
        match self {
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
            Self::UnitaryPotential => text(
                "a potential beside `group = unitary` that depends on more than the angles `q1`, .., `qn`",
                "on U(n) D = diag(exp(i q_a)): there are no stretches, and what rotations of both sides leave alone is a function \
                 V(q_1, .., q_n) of the angles",
                "write it as a function of `q1`, .., `qn`, with the period 2 pi in each",
            ),
            Self::RatiosAlone => text(
                "`emit(ratios)` with no `two_polar` beside it",
                "it is the lattice of `two_polar` in exp(q_b - q_a), M + N and M - N",
                "write `emit(two_polar, ratios)`",
            ),
        }
    }
}
