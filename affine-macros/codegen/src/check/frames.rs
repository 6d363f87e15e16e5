//! Frames of the terms, and the claims.

use crate::diagnostics::{Diagnostics, FormMistake};
use crate::lower::constant;
use crate::spec::{Claim, Spec, Term, Value};
use crate::symbol::{Constraint, Frame, TermKind};

/// Where H is derived by inverting a matrix that depends on phi: the terms that are not exactly zero have constant
/// coefficients in different velocities. Internal and translational ones are inverted apart, and count apart. The
/// Casimirs have constant coefficients in Oh as well as in Om. Under a constraint a flat tensor is a matrix that depends on
/// phi by itself, and so are masses where phi is no rotation up to scale.
pub(super) fn are_mixed(spec: &Spec) -> bool {
    let constraint = spec.constraint.as_ref().map(|constraint| constraint.value);
    let turns = |term: &Term| match (constraint, term.kind.value) {
        (Some(_), TermKind::FlatTensor) | (Some(Constraint::Isochoric), TermKind::Dalembert) => {
            !is_zero(term, spec.dim.value)
        }
        _ => false,
    };
    if spec.kinetic.iter().any(turns) {
        return true;
    }
    let terms = |translation: bool| {
        let of_motion = move |term: &&Term| term.kind.value.is_translation() == translation;
        spec.kinetic.iter().filter(of_motion).filter(|term| !is_zero(term, spec.dim.value))
    };
    [false, true].into_iter().any(|translation| {
        let frames: Vec<Option<Frame>> = terms(translation).map(|term| frame(term, constraint)).collect();
        let has = |wanted: Frame| frames.contains(&Some(wanted));
        let affine = frames.iter().any(|frame| *frame != Some(Frame::Flat));
        (has(Frame::Flat) && affine) || (has(Frame::Body) && has(Frame::Space))
    })
}

/// The frame in which a term has constant coefficients; `None` where any of body and space will do.
fn frame(term: &Term, constraint: Option<Constraint>) -> Option<Frame> {
    let scalar = matches!(term.value, Value::Scalar(_));
    let kind = term.kind.value;
    match (constraint, constraint.map_or(kind, |group| group.same_as(kind))) {
        // tr(Om Om^T) = tr(Oh Oh^T) where phi is a rotation up to scale.
        (Some(Constraint::Rigid | Constraint::Conformal), TermKind::BodyInertia | TermKind::SpaceInertia)
            if scalar =>
        {
            None
        }
        (_, kind) => kind.internal_frame().or(kind.translation_frame()),
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
        found.report(spec.kinetic_key, FormMistake::NoKineticEnergy);
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
        found.report(at, FormMistake::AffineTranslation { term });
    }
}
