//! Capabilities.

use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::spec::{Capability, Named, Spec};

/// A capability that cannot be emitted is refused rather than ignored: code that relies on it would fail far
/// from here.
pub(super) fn available(spec: &Spec, found: &mut Diagnostics) {
    let later = |capability: Capability| !matches!(capability, Capability::Metric | Capability::Acceleration);
    for capability in spec.emit.iter().filter(|capability| later(capability.value)) {
        let name = capability.value;
        found.report(
            capability.span,
            Diagnostic::UnavailableCapability { capability: name.name(), gives: name.gives() },
        );
    }
}

/// Where the centre of mass is fixed it has no acceleration.
pub(super) fn centre(spec: &Spec, found: &mut Diagnostics) {
    let moves = spec.kinetic.iter().any(|term| term.kind.value.is_translation());
    let asked = spec.emit.iter().find(|capability| capability.value == Capability::Acceleration);
    if let Some(acceleration) = asked.filter(|_| !moves) {
        let form = acceleration.value.name().to_owned();
        found.report(acceleration.span, Diagnostic::FixedCentre { form });
    }
}
