//! Capabilities.

use crate::diagnostics::{CapabilityMistake, Diagnostics, PotentialMistake};
use crate::spec::{Capability, Named, Spec};

use super::parts::Part;
use super::together;

/// The lattice in ratios of stretches is a way to write the lattice; of a model that has none in ratios that is said already.
pub(super) fn ratios(spec: &Spec, found: &mut Diagnostics) {
    let refused = || together::refuses(spec, Part::Emitted(Capability::Ratios));
    let ratios = spec.emitted(Capability::Ratios);
    if let Some(ratios) = ratios.filter(|_| !spec.asked().has(Capability::TwoPolar) && !refused()) {
        found.report(ratios, CapabilityMistake::RatiosAlone);
    }
}

/// Where the centre of mass is fixed it has no acceleration.
pub(super) fn centre(spec: &Spec, found: &mut Diagnostics) {
    let asked = spec.emitted(Capability::Acceleration);
    if let Some(acceleration) = asked.filter(|_| spec.translation().is_none()) {
        let form = Capability::Acceleration.name().to_owned();
        found.report(acceleration, PotentialMistake::FixedCentre { form });
    }
}
