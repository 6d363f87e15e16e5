//! The rule of the two-polar form.

use crate::diagnostics::{CapabilityMistake, Diagnostics, Reported};
use crate::mechanics::kinetic::Kinetic;
use crate::mechanics::potential::Potential;
use crate::mechanics::symmetry::{Breaker, Group, Side, broken_by};
use crate::mechanics::term::Frame;
use crate::spec::{Capability, MomentumKind, Spec};

/// Is `two_polar` asked for? The stretches and `M`, `N` move by themselves only in doubly isotropic models: kinetic and
/// potential energy unchanged by O(n) in space and in the body, (6.2) to (6.5).
pub(super) fn asked(
    spec: &Spec,
    kinetic: &Kinetic,
    places: &[usize],
    potential: Option<&Potential>,
    found: &mut Diagnostics,
) -> Result<bool, Reported> {
    let Some(asked) = spec.emit.iter().find(|capability| capability.value == Capability::TwoPolar) else {
        return Ok(false);
    };
    let mut without = |holds: bool, part: &str, lacks: &'static str| {
        if holds {
            found.report(asked.span, CapabilityMistake::LatticeWithout { part: part.to_owned(), lacks });
        }
    };
    let terms = spec.hamiltonian.iter().flatten();
    let is_cubic = terms.map(|term| term.kind.value).any(|kind| kind == MomentumKind::Casimir3);
    without(is_cubic, "`casimir3`", "third Casimir");
    without(spec.constraint.is_some(), "a constraint", "constraint");
    without(spec.metrics.iter().any(Option::is_some), "`metrics(...)`", "metrics");
    without(potential.is_some_and(Potential::depends_on_time), "a potential of the time", "time");
    // A centre of mass that moves freely moves beside it.
    let coupled = kinetic.translation.as_ref().is_some_and(|t| t.frame == Frame::Body);
    without(coupled, "`body_translation`", "centre of mass");
    without(potential.is_some_and(Potential::moves_the_centre), "a potential of `x`", "centre of mass");
    found.verdict()?;
    let mut anisotropic = |part: String, side: Side, transformation: String| {
        let side = if side == Side::Space { "space" } else { "the body" };
        found.report(asked.span, CapabilityMistake::NotDoublyIsotropic { part, side, transformation });
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
