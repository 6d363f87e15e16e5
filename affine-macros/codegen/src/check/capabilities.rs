//! Capabilities.

use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::mechanics::potential::Potential;
use crate::spec::{Capability, Named, Spec};

/// A capability that cannot be emitted is refused rather than ignored: code that relies on it would fail far
/// from here.
pub(super) fn available(spec: &Spec, found: &mut Diagnostics) {
    let available = [Capability::Taylor, Capability::Lanes];
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
