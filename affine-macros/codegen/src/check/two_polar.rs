//! The rule of the two-polar form.

use crate::diagnostics::{CapabilityMistake, Diagnostics, Reported};
use crate::mechanics::kinetic::Kinetic;
use crate::mechanics::potential::Potential;
use crate::mechanics::symmetry::{Breaker, Group, Side, broken_by};
use crate::spec::{Capability, Spec};

/// Is `two_polar` asked for? The stretches and `M`, `N` move by themselves only in doubly isotropic models: kinetic and
/// potential energy unchanged by O(n) in space and in the body, (6.2) to (6.5).
pub(super) fn asked(
    spec: &Spec,
    kinetic: &Kinetic,
    places: &[usize],
    potential: Option<&Potential>,
    found: &mut Diagnostics,
) -> Result<bool, Reported> {
    let Some(asked) = spec.emitted(Capability::TwoPolar) else { return Ok(false) };
    let mut anisotropic = |part: String, side: Side, transformation: String| {
        let side = if side == Side::Space { "space" } else { "the body" };
        found.report(asked, CapabilityMistake::NotDoublyIsotropic { part, side, transformation });
    };
    for side in [Side::Space, Side::Body] {
        if let Some((breaker, place)) = broken_by(kinetic, side, Group::Metric) {
            let term = places.get(place).and_then(|place| spec.kinetic.get(*place));
            let term = term.map_or("kinetic", |term| term.kind.value.name());
            let transformation = match breaker {
                Breaker::Reflection => "the reflection of the first axis".to_owned(),
                Breaker::Rotation(a, b) | Breaker::Generator(a, b) => rotation(a, b),
            };
            anisotropic(format!("the term `{term}`"), side, transformation);
        }
    }
    if let Some((side, (a, b))) = potential.and_then(Potential::anisotropy) {
        anisotropic("the potential".to_owned(), side, rotation(a, b));
    }
    found.verdict()?;
    Ok(true)
}

fn rotation(a: usize, b: usize) -> String {
    format!("the rotation E[{a},{b}] - E[{b},{a}]")
}
