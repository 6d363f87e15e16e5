//! Capabilities.

use crate::diagnostics::{CapabilityMistake, Diagnostics, PotentialMistake};
use crate::mechanics::asked::Asked;
use crate::spec::{Capability, Named, Spec};

/// The lattice in ratios of stretches is a way to write the lattice.
pub(super) fn ratios(spec: &Spec, found: &mut Diagnostics) {
    let ratios = spec.emit.iter().find(|c| c.value == Capability::Ratios);
    if let Some(ratios) = ratios.filter(|_| !asked(spec, Capability::TwoPolar)) {
        found.report(ratios.span, CapabilityMistake::RatiosAlone);
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
        latex: asked(Capability::Latex),
    }
}
