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
        /// The reason.
        why: &'static str,
    },
    /// `emit(balance)` for a model other than d'Alembert's.
    BalanceBeside {
        /// A term or a key that makes it another.
        part: String,
    },
    /// `emit(splitting)` for a Hamiltonian without pieces whose flows are known.
    NoExactPieces {
        /// What stands against it.
        beside: String,
        /// The reason.
        why: String,
    },
    /// `emit(nystrom)` for equations that are not `q'' = f(t, q)`.
    NotSecondOrder {
        /// What stands against it.
        beside: String,
        /// The reason.
        why: &'static str,
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
    /// `ratios` for a lattice that is not rational in them.
    NotRational {
        /// What the model has, or has not.
        part: &'static str,
    },
}

names! { CapabilityMistake
    CapabilityBeside => "capability-beside",
    BalanceBeside => "balance-beside",
    NoExactPieces => "no-exact-pieces",
    NotSecondOrder => "not-second-order",
    NotDoublyIsotropic => "not-doubly-isotropic",
    UnitaryTerm => "unitary-term",
    LatticeWithout => "lattice-without",
    NotRational => "not-rational",
}

impl CapabilityMistake {
    pub(super) fn text(&self) -> Text {
        match self {
            Self::CapabilityBeside { capability, beside, why } => text(
                format!("`emit({capability})` does not go with {beside} in this version"),
                *why,
                format!(
                    "remove `{capability}` from `emit(...)`: Runge-Kutta and Gauss methods integrate the model"
                ),
            ),
            Self::BalanceBeside { part } => text(
                format!("`emit(balance)` is that of d'Alembert models, and does not go with {part}"),
                "the kinematical spin K = phi J phi_dot^T is the affine spin, and dK/dt = phi_dot J phi_dot^T + N (3.6), for \
                 the energy m/2 |x_dot|^2 + 1/2 tr(phi_dot J phi_dot^T) (2.1) of a motion on all of GL(n) alone",
                "remove `balance` from `emit(...)`, or state the energy by `dalembert` and `space_translation` alone",
            ),
            Self::NoExactPieces { beside, why } => text(
                format!("`emit(splitting)` does not go with {beside}"),
                why.clone(),
                "remove `splitting` from `emit(...)`: Gauss collocation is symmetric and integrates the model",
            ),
            Self::NotSecondOrder { beside, why } => text(
                format!("`emit(nystrom)` does not go with {beside}"),
                format!("Nystrom methods integrate q'' = f(t, q); {why}"),
                "remove `nystrom` from `emit(...)`: the other methods integrate the model",
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
                "(q, p, M, N) of (6.2) to (6.5) describe the internal motion on GL(n) alone, in orthonormal coordinates",
                format!("remove `two_polar` from `emit(...)`, or state a model without {part}"),
            ),
            Self::NotRational { part } => text(
                format!("`emit(ratios)` with {part}"),
                "in exp(q_b - q_a), M + N and M - N the lattice of the Casimirs is rational, (6.2) to (6.4); forces of a \
                 potential and (6.5) are not",
                "write `emit(two_polar, ratios)` for a model of affine velocities without potential, or remove `ratios`",
            ),
        }
    }
}
