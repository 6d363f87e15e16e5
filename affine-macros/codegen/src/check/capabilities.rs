//! Capabilities.

use crate::algebra::Arena;
use crate::diagnostics::{Diagnostic, Diagnostics};
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
        Capability::Lanes,
        Capability::Metric,
        Capability::Acceleration,
        Capability::Balance,
    ];
    for capability in spec.emit.iter().filter(|c| !available.contains(&c.value)) {
        let name = capability.value;
        found.report(
            capability.span,
            Diagnostic::UnavailableCapability { capability: name.name(), gives: name.gives() },
        );
    }
}

/// Where the centre of mass is fixed it has no acceleration.
pub(super) fn centre(spec: &Spec, found: &mut Diagnostics) {
    let asked = spec.emit.iter().find(|capability| capability.value == Capability::Acceleration);
    if let Some(acceleration) = asked.filter(|_| spec.translation().is_none()) {
        let form = acceleration.value.name().to_owned();
        found.report(acceleration.span, Diagnostic::FixedCentre { form });
    }
}

/// `K = phi J phi_dot^T` is the affine spin, and (3.6) its law of motion, where the energy is (2.1) and every placement
/// of GL+(n) is free: the multiplier of a constraint would be one more moment, and with `m/2 |phi^-1 x_dot|^2` the
/// moment of the momentum of the centre.
pub(super) fn balance(spec: &Spec, found: &mut Diagnostics) {
    let Some(balance) = spec.emit.iter().find(|c| c.value == Capability::Balance) else { return };
    let fits = |kind: TermKind| matches!(kind, TermKind::Dalembert | TermKind::SpaceTranslation);
    let kinds = spec.kinetic.iter().map(|term| term.kind.value);
    let terms = kinds.filter(|kind| !fits(*kind)).map(|kind| format!("`{}`", kind.name()));
    let keys = [
        ("`hamiltonian(...)`", spec.hamiltonian.is_some()),
        ("`constraint`", spec.constraint.is_some()),
        ("`metrics(...)`", spec.has_metrics()),
    ];
    let keys = keys.into_iter().filter(|(_, stated)| *stated).map(|(key, _)| key.to_owned());
    for part in terms.chain(keys) {
        found.report(balance.span, Diagnostic::BalanceBeside { part });
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
        found.report(capability.span, Diagnostic::NoExactPieces { beside, why });
    }
}
