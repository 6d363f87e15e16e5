//! Capabilities.

use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::spec::{Capability, Named, Spec};

/// A capability that cannot be emitted is refused rather than ignored: code that relies on it would fail far
/// from here.
pub(super) fn available(spec: &Spec, found: &mut Diagnostics) {
    for capability in spec.emit.iter().filter(|capability| capability.value != Capability::TwoPolar) {
        let name = capability.value;
        found.report(
            capability.span,
            Diagnostic::UnavailableCapability { capability: name.name(), gives: name.gives() },
        );
    }
}
