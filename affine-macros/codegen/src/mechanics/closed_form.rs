//! Motions that are known without integration.

use super::hamiltonian::Hamiltonian;
use super::reduction::left_out::{LeftOut, Scope};
use super::term::Frame;

/// Closed-form motions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ClosedForm {
    /// `phi0 exp(tX) exp(tW)`
    Body,
    /// `exp(tW) exp(tX) phi0`
    Space,
    /// `phi0 + t phi_dot0`
    Straight,
}

impl ClosedForm {
    /// That of the geodesics of an energy.
    pub fn of(h: &Hamiltonian) -> Option<Self> {
        match h.frame {
            // The multiplier of a constraint bends the line.
            Frame::Flat => h.constraint.is_none().then_some(Self::Straight),
            // The Casimirs commute with the rotation that the skew part of the energy makes.
            Frame::Body => h.isotropic.as_ref().map(|_| Self::Body),
            Frame::Space => h.isotropic.as_ref().map(|_| Self::Space),
        }
    }

    /// What a closed form leaves out: all integration, or that of motions with `p = 0`.
    pub fn left_out(only_at_rest: bool) -> LeftOut {
        match only_at_rest {
            false => Scope::ClosedForm.without("integration: every motion has a closed form"),
            true => Scope::ClosedForm.without("integration of motions with p = 0: they have a closed form"),
        }
    }
}
