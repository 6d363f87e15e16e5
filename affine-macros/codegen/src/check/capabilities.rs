//! Capabilities.

use crate::algebra::Arena;
use crate::diagnostics::{CapabilityMistake, Diagnostics, PotentialMistake};
use crate::mechanics::hamiltonian::Hamiltonian;
use crate::mechanics::hessian::Hessian;
use crate::mechanics::kinetic::{Frame, Kinetic};
use crate::mechanics::potential::Potential;
use crate::spec::{Capability, Named, Spec, TermKind};

/// A capability that cannot be emitted is refused rather than ignored: code that relies on it would fail far
/// from here.
pub(super) fn available(spec: &Spec, found: &mut Diagnostics) {
    let available = [
        Capability::Splitting,
        Capability::Taylor,
        Capability::TwoPolar,
        Capability::Ratios,
        Capability::Lanes,
        Capability::Metric,
        Capability::Acceleration,
    ];
    for capability in spec.emit.iter().filter(|c| !available.contains(&c.value)) {
        let name = capability.value;
        found.report(
            capability.span,
            CapabilityMistake::UnavailableCapability { capability: name.name(), gives: name.gives() },
        );
    }
}

/// In ratios of stretches the lattice of the Casimirs is rational. What moves the places otherwise is not.
pub(super) fn ratios(spec: &Spec, found: &mut Diagnostics) {
    let Some(asked_for) = spec.emit.iter().find(|c| c.value == Capability::Ratios) else { return };
    let flat = |kind: TermKind| matches!(kind, TermKind::Dalembert | TermKind::FlatTensor);
    let parts = [
        ("no `two_polar` beside it", !asked(spec, Capability::TwoPolar)),
        ("a potential", spec.potential.is_some()),
        ("an energy in `phi_dot`", spec.kinetic.iter().any(|term| flat(term.kind.value))),
    ];
    for (part, _) in parts.into_iter().filter(|(_, stated)| *stated) {
        found.report(asked_for.span, CapabilityMistake::NotRational { part });
    }
}

/// Where the centre of mass is fixed it has no acceleration.
pub(super) fn centre(spec: &Spec, found: &mut Diagnostics) {
    let asked = spec.emit.iter().find(|capability| capability.value == Capability::Acceleration);
    if let Some(acceleration) = asked.filter(|_| spec.translation().is_none()) {
        let form = acceleration.value.name().to_owned();
        found.report(acceleration.span, PotentialMistake::FixedCentre { form });
    }
}

/// Taylor coefficients follow from the operations of autonomous right-hand sides; single stretches are found by an
/// iteration, and a constrained motion is integrated in charts that change from step to step.
pub(super) fn series(spec: &Spec, potential: Option<&Potential>, found: &mut Diagnostics) {
    let Some(taylor) = spec.emit.iter().find(|c| c.value == Capability::Taylor) else { return };
    let beside = [
        ("a constraint", spec.constraint.is_some()),
        ("a potential of single stretches", potential.is_some_and(Potential::has_single_stretches)),
        ("a potential of time", potential.is_some_and(Potential::depends_on_time)),
    ];
    for (beside, _) in beside.into_iter().filter(|(_, stated)| *stated) {
        let capability = taylor.value.name();
        found.report(taylor.span, CapabilityMistake::CapabilityBeside { capability, beside });
    }
}

/// Is a capability asked for?
pub(super) fn asked(spec: &Spec, capability: Capability) -> bool {
    spec.emit.iter().any(|c| c.value == capability)
}

/// Pieces with exact flows: the Casimirs of an isotropic energy and the rotation beside them, or `T(Pi)`, and what is
/// added to them. A tensor is a sum of up to n^2 squares of momenta that do not commute; a constrained motion is
/// integrated in charts of its group, or with its multiplier.
pub(super) fn pieces(
    arena: &mut Arena,
    spec: &Spec,
    (kinetic, hessian): (&Kinetic, &Hessian),
    found: &mut Diagnostics,
) {
    if !asked(spec, Capability::Splitting) {
        return;
    }
    if let Some(constraint) = &spec.constraint {
        let why = format!("steps on {} are taken in charts, or with a multiplier", constraint.value.group());
        return not_split(spec, format!("`constraint = {}`", constraint.value.name()), why, found);
    }
    let isotropic = Hamiltonian::new(arena, kinetic, hessian).is_none_or(|h| h.isotropic.is_some());
    if kinetic.frame != Frame::Flat && !isotropic {
        let beside = "an anisotropic kinetic energy of affine velocities".to_owned();
        let why = "the energy is no sum of C(2), C(1)^2 and |W|^2, whose flows are exponentials (4.24), but of up to n^2 \
                   squares of momenta that do not commute"
            .to_owned();
        not_split(spec, beside, why, found);
    }
}

/// Where terms of different frames are added, no piece of `H` is quadratic in one momentum with constant coefficients.
pub(super) fn one_frame(spec: &Spec, found: &mut Diagnostics) {
    if asked(spec, Capability::Splitting) {
        let why = "the mass matrix of the sum depends on phi: the flow of the kinetic energy is not known"
            .to_owned();
        not_split(spec, "terms of different frames".to_owned(), why, found);
    }
}

fn not_split(spec: &Spec, beside: String, why: String, found: &mut Diagnostics) {
    for capability in spec.emit.iter().filter(|c| c.value == Capability::Splitting) {
        let (beside, why) = (beside.clone(), why.clone());
        found.report(capability.span, CapabilityMistake::NoExactPieces { beside, why });
    }
}
