//! Capabilities.

use crate::diagnostics::{CapabilityMistake, Diagnostics, PotentialMistake};
use crate::mechanics::asked::Asked;
use crate::mechanics::kinetic::Kinetic;
use crate::mechanics::potential::Potential;
use crate::spec::{Capability, Named, Spanned, Spec};
use crate::symbol::TermKind;

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
        found.report(balance.span, CapabilityMistake::BalanceBeside { part });
    }
}

/// Taylor coefficients follow from the operations of right-hand sides; single stretches are found by an iteration, and a constrained motion is integrated in charts that change from step to step.
pub(super) fn series(spec: &Spec, potential: Option<&Potential>, found: &mut Diagnostics) {
    let Some(taylor) = spec.emit.iter().find(|c| c.value == Capability::Taylor) else { return };
    let beside = [
        ("a constraint", spec.constraint.is_some()),
        ("a potential of single stretches", potential.is_some_and(Potential::has_single_stretches)),
    ];
    for (beside, _) in beside.into_iter().filter(|(_, stated)| *stated) {
        let capability = taylor.value.name();
        let why = "its recurrences follow from the operations of one right-hand side";
        found.report(taylor.span, CapabilityMistake::CapabilityBeside { capability, beside, why });
    }
}

/// The variational equations are the derivative of a right-hand side that is known operation by operation.
pub(super) fn tangent(spec: &Spec, potential: Option<&Potential>, found: &mut Diagnostics) {
    let Some(tangent) = spec.emit.iter().find(|c| c.value == Capability::Tangent) else { return };
    let beside = [
        (
            "a constraint",
            spec.constraint.is_some(),
            "tangent vectors of a group turn with the charts of its steps",
        ),
        (
            "a potential of single stretches",
            potential.is_some_and(Potential::has_single_stretches),
            "stretches are found by an iteration, whose derivative is not emitted",
        ),
        ("`custom` fields", !spec.customs.is_empty(), "the derivative of what a field computes is not known"),
    ];
    for (beside, _, why) in beside.into_iter().filter(|(_, stated, _)| *stated) {
        let capability = tangent.value.name();
        found.report(tangent.span, CapabilityMistake::CapabilityBeside { capability, beside, why });
    }
}

/// Is a capability asked for?
pub(super) fn asked(spec: &Spec, capability: Capability) -> bool {
    spec.emit.iter().any(|c| c.value == capability)
}

/// Everything that is asked for.
pub(super) fn asked_for(spec: &Spec) -> Asked {
    let asked = |capability| asked(spec, capability);
    Asked {
        two_polar: asked(Capability::TwoPolar),
        ratios: asked(Capability::Ratios),
        splitting: asked(Capability::Splitting),
        nystrom: asked(Capability::Nystrom),
        taylor: asked(Capability::Taylor),
        tangent: asked(Capability::Tangent),
        metric: asked(Capability::Metric),
        acceleration: asked(Capability::Acceleration),
        balance: asked(Capability::Balance),
    }
}

/// Pieces with exact flows: the Casimirs of an isotropic energy and the rotation beside them, the squares of any other,
/// or `T(Pi)`, and what is added to them; on a group as well, but where a multiplier keeps the motion on it, or a weight
/// `D^2` stands before the energy.
pub(super) fn pieces(spec: &Spec, kinetic: &Kinetic, found: &mut Diagnostics) {
    let Some(constraint) = spec.constraint.as_ref().filter(|_| asked(spec, Capability::Splitting)) else {
        return;
    };
    let why = match kinetic.confined() {
        None => "the force of the multiplier depends on all momenta and positions",
        Some(_) if kinetic.is_weighted() => {
            "the energy has the weight D^2, and no piece of it is quadratic in momenta with constant coefficients"
        }
        Some(_) => return,
    };
    not_split(
        spec,
        format!("`constraint = {}` and `phi_dot`", constraint.value.name()),
        why.to_owned(),
        found,
    );
}

/// Nystrom methods are for `q'' = f(t, q)`: a kinetic energy of `phi_dot` and `x_dot` with constant coefficients, and a
/// potential. Without one the motion is a straight line.
pub(super) fn second_order(spec: &Spec, flat: bool, potential: Option<&Potential>, found: &mut Diagnostics) {
    let Some(nystrom) = spec.emit.iter().find(|c| c.value == Capability::Nystrom) else { return };
    let beside = match &spec.constraint {
        Some(constraint) => Some((
            format!("`constraint = {}`", constraint.value.name()),
            "the multiplier of the constraint depends on the velocity",
        )),
        None if !flat => Some((
            "a kinetic energy of affine velocities".to_owned(),
            "the mass matrix of phi_dot depends on phi here, and phi'' on phi_dot",
        )),
        None if potential.is_none() => Some((
            "a motion without a potential".to_owned(),
            "a free body moves in a straight line, phi = phi0 + t phi_dot0, known in closed form",
        )),
        None => None,
    };
    if let Some((beside, why)) = beside {
        found.report(nystrom.span, CapabilityMistake::NotSecondOrder { beside, why });
    }
}

/// Where terms of different frames are added, no piece of `H` is quadratic in one momentum with constant coefficients.
pub(super) fn one_frame(spec: &Spec, found: &mut Diagnostics) {
    if asked(spec, Capability::Splitting) {
        let why = "the mass matrix of the sum depends on phi: the flow of the kinetic energy is not known"
            .to_owned();
        not_split(spec, "terms of different frames".to_owned(), why, found);
    }
    if let Some(nystrom) = spec.emit.iter().find(|c| c.value == Capability::Nystrom) {
        let beside = "terms of different frames".to_owned();
        let why = "the mass matrix of the sum depends on phi, and phi'' on phi_dot";
        found.report(nystrom.span, CapabilityMistake::NotSecondOrder { beside, why });
    }
}

/// Metric and acceleration are derived over all velocities: on a group the forms that are restricted to its Lie algebra
/// depend on the placement, and have no names.
pub(super) fn on_the_group(spec: &Spec, found: &mut Diagnostics) {
    let asked = |c: &&Spanned<Capability>| matches!(c.value, Capability::Metric | Capability::Acceleration);
    for capability in spec.emit.iter().filter(asked).filter(|_| spec.constraint.is_some()) {
        let mistake = CapabilityMistake::CapabilityBeside {
            capability: capability.value.name(),
            beside: "a sum of frames under a constraint",
            why: "it is derived over all of phi_dot, of which the constraint leaves a part that turns with phi",
        };
        found.report(capability.span, mistake);
    }
}

fn not_split(spec: &Spec, beside: String, why: String, found: &mut Diagnostics) {
    for capability in spec.emit.iter().filter(|c| c.value == Capability::Splitting) {
        let (beside, why) = (beside.clone(), why.clone());
        found.report(capability.span, CapabilityMistake::NoExactPieces { beside, why });
    }
}
