//! Terms that go together, and with the claims.

use super::constant::constant;
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::spec::{Claim, Named, Spec, Term, TermKind};

/// The velocity in which a term has constant coefficients.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Frame {
    /// `Oh = phi^-1 phi_dot` and `phi^-1 x_dot`.
    Comoving,
    /// `Om = phi_dot phi^-1`.
    Spatial,
    /// `Oh` as well as `Om`: the Casimirs.
    Both,
    /// `phi_dot`.
    Flat,
}

fn frame(kind: TermKind) -> Frame {
    match kind {
        TermKind::Casimir2 | TermKind::Casimir1Squared => Frame::Both,
        TermKind::BodyInertia | TermKind::BodyTensor | TermKind::BodyTranslation => Frame::Comoving,
        TermKind::SpaceInertia | TermKind::SpaceTensor | TermKind::SpaceTranslation => Frame::Spatial,
        TermKind::Dalembert | TermKind::FlatTensor => Frame::Flat,
    }
}

fn velocity(kind: TermKind) -> &'static str {
    match (frame(kind), kind.is_translation()) {
        (Frame::Comoving, true) => "phi^-1 x_dot",
        (Frame::Spatial, true) => "x_dot",
        (Frame::Comoving, false) => "Oh = phi^-1 phi_dot",
        (Frame::Spatial, false) => "Om = phi_dot phi^-1",
        (Frame::Both, _) => "Oh = phi^-1 phi_dot and in Om = phi_dot phi^-1",
        (Frame::Flat, _) => "phi_dot",
    }
}

/// H is derived by inverting a constant matrix. A sum of terms that are constant in different frames has none:
/// its mass matrix depends on phi, and so would its inverse. Internal and translational velocities are inverted
/// apart, so the rule holds for each. A term that is exactly zero does not count.
pub(super) fn same_frame(spec: &Spec, found: &mut Diagnostics) {
    for translation in [false, true] {
        let terms: Vec<&Term> = spec
            .kinetic
            .iter()
            .filter(|term| term.kind.value.is_translation() == translation && !is_zero(term, spec.dim.value))
            .collect();
        for (index, second) in terms.iter().enumerate() {
            let clash = |first: &&&Term| !compatible(first.kind.value, second.kind.value);
            if let Some(first) = terms[..index].iter().find(clash) {
                let (first, other) = (first.kind.value, second.kind.value);
                let mistake = Diagnostic::MixedFrames {
                    first: first.name(),
                    first_velocity: velocity(first),
                    second: other.name(),
                    second_velocity: velocity(other),
                };
                found.report(second.kind.span, mistake);
            }
        }
    }
}

fn compatible(first: TermKind, second: TermKind) -> bool {
    match (frame(first), frame(second)) {
        (Frame::Both, Frame::Flat) | (Frame::Flat, Frame::Both) => false,
        (Frame::Both, _) | (_, Frame::Both) => true,
        (first, second) => first == second,
    }
}

/// Exactly zero: it leaves no trace in the model.
fn is_zero(term: &Term, n: usize) -> bool {
    term.value.expressions().all(|entry| constant(entry, n).is_some_and(|value| value.is_zero()))
}

/// A model needs a kinetic energy in phi_dot: with none, Sigma = (dT/dOm)^T is zero whatever the motion, and
/// no Hamiltonian exists.
pub(super) fn internal_motion(spec: &Spec, found: &mut Diagnostics) {
    if spec.hamiltonian.is_none() && spec.kinetic.iter().all(|term| term.kind.value.is_translation()) {
        found.report(spec.kinetic_key, Diagnostic::NoKineticEnergy);
    }
}

/// No kinetic energy with translation is affine in space and in the body: every form on the affine group that
/// is invariant on both sides is degenerate (section 4, after (4.5)).
pub(super) fn affine_translation(spec: &Spec, found: &mut Diagnostics) {
    let Some(symmetry) = &spec.symmetry else { return };
    if [symmetry.space.value, symmetry.body.value] != [Claim::Affine; 2] {
        return;
    }
    if let Some((term, at)) = spec.translation() {
        found.report(at, Diagnostic::AffineTranslation { term });
    }
}
