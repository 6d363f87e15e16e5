//! The names of `hamiltonian(...)`, the momentum-side statement.

use super::names::{Named, named, set_of_names};

set_of_names! {
    /// The kinds of terms of a Hamiltonian; `X` is `Sigma = phi Pi` or `Sigma_hat = Pi phi`.
    pub enum MomentumKind {
        /// `a/2 tr X^2`.
        Casimir2 = "casimir2",
        /// `b/2 (tr X)^2`.
        Casimir1Squared = "casimir1_squared",
        /// `c/2 |Vort|^2`, `Vort = Sigma_hat - Sigma_hat^T`, `|W|^2` the sum over `a < b` of `W_ab^2`.
        VorticitySquared = "vorticity_squared",
        /// `c/2 |S|^2`, `S = Sigma - Sigma^T`.
        SpinSquared = "spin_squared",
        /// `k/2 |p_hat|^2`, `k = 1/m`.
        BodyTranslation = "body_translation",
        /// `k/2 |p|^2`, `k = 1/m`.
        SpaceTranslation = "space_translation",
        /// `c/3 tr X^3`, n = 3 only.
        Casimir3 = "casimir3",
    }
}

impl MomentumKind {
    /// A kinetic energy of the centre of mass, in p?
    pub fn is_translation(self) -> bool {
        matches!(self, Self::BodyTranslation | Self::SpaceTranslation)
    }
}

/// A value that a term may have, in a message.
pub(super) fn example(kind: MomentumKind) -> &'static str {
    match kind {
        MomentumKind::Casimir2 => "5/6",
        MomentumKind::Casimir1Squared => "-1/18",
        MomentumKind::VorticitySquared | MomentumKind::SpinSquared => "25/24",
        MomentumKind::BodyTranslation | MomentumKind::SpaceTranslation => "1/2",
        MomentumKind::Casimir3 => "0.1",
    }
}
