//! Capabilities.

use crate::algebra::Arena;
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::mechanics::hamiltonian::Hamiltonian;
use crate::mechanics::hessian::Hessian;
use crate::mechanics::kinetic::{Frame, Kinetic};
use crate::mechanics::potential::Potential;
use crate::spec::{Capability, Named, Spec};

/// A capability that cannot be emitted is refused rather than ignored: code that relies on it would fail far
/// from here.
pub(super) fn available(spec: &Spec, found: &mut Diagnostics) {
    let available = [Capability::Splitting, Capability::Taylor];
    for capability in spec.emit.iter().filter(|c| !available.contains(&c.value)) {
        let name = capability.value;
        found.report(
            capability.span,
            Diagnostic::UnavailableCapability { capability: name.name(), gives: name.gives() },
        );
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
        found.report(taylor.span, Diagnostic::CapabilityBeside { capability, beside });
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
    let Some(splitting) = spec.emit.iter().find(|c| c.value == Capability::Splitting) else { return };
    let energy = if kinetic.frame == Frame::Space { "space_inertia" } else { "body_inertia" };
    let mut isotropic = || Hamiltonian::new(arena, kinetic, hessian).is_none_or(|h| h.isotropic.is_some());
    let reason = if let Some(constraint) = &spec.constraint {
        let name = constraint.value.name();
        Some((
            format!("`constraint = {name}`"),
            format!("the motion on {} is integrated in charts, or with its multiplier", constraint.value.group()),
            "`Method::Gauss`, which is symmetric, or `Method::Rattle` integrate the model".to_owned(),
        ))
    } else if kinetic.frame != Frame::Flat && !isotropic() {
        Some((
            "an anisotropic kinetic energy of affine velocities".to_owned(),
            "its energy is no function of C(1), C(2) and |W|^2, whose flows are exponentials (4.24); squares of single \
             momenta would make up to n^2 pieces"
                .to_owned(),
            format!("state an isotropic one, `{energy} = I` with a number: `Method::Gauss` integrates this one"),
        ))
    } else {
        None
    };
    if let Some((beside, why, instead)) = reason {
        found.report(splitting.span, Diagnostic::NoExactPieces { beside, why, instead });
    }
}
