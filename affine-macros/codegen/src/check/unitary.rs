//! The rule of U(n).

use crate::diagnostics::{CapabilityMistake, Diagnostics};
use crate::mechanics::potential::Potential;
use crate::spec::{Capability, Named, Spec};
use crate::symbol::Pattern;

/// A potential on the circle depends on its angles alone.
pub(super) fn of_angles(spec: &Spec, potential: Option<&Potential>, found: &mut Diagnostics) {
    if let (Some(_), Some(written), Some(potential)) = (spec.group, &spec.potential, potential)
        && !potential.is_of_places()
    {
        found.report(written.key, CapabilityMistake::UnitaryPotential);
    }
}

/// On U(n) the Casimir terms stand, `-A/2 tr Om^2 - B/2 (tr Om)^2` (89): `Om` is anti-Hermitian, every other term breaks
/// the symmetry from both sides that the lattice form rests on, and there are no coordinates of a centre.
pub(super) fn casimirs_alone(spec: &Spec, found: &mut Diagnostics) {
    if spec.group.is_none() {
        return;
    }
    for term in &spec.kinetic {
        if !matches!(term.kind.value.pattern(), Pattern::TraceOfSquare | Pattern::SquareOfTrace) {
            found.report(term.kind.span, CapabilityMistake::UnitaryTerm { part: term.kind.value.name() });
        }
    }
    // Claims and requirements speak of GL(n, R).
    if let Some(symmetry) = &spec.symmetry {
        found.report(symmetry.space.span, CapabilityMistake::UnitaryTerm { part: "symmetry" });
    }
    if let Some(constraint) = &spec.constraint {
        found.report(constraint.span, CapabilityMistake::UnitaryTerm { part: "constraint" });
    }
    if spec.hamiltonian.is_some() {
        found.report(spec.kinetic_key, CapabilityMistake::UnitaryTerm { part: "hamiltonian" });
    }
    for metric in spec.metrics.iter().flatten() {
        found.report(metric.span, CapabilityMistake::UnitaryTerm { part: "metrics" });
    }
    for requirement in &spec.require {
        found.report(requirement.span, CapabilityMistake::UnitaryTerm { part: requirement.value.name() });
    }
    // Besides the lattice itself, its pieces and its formulas.
    let goes = |capability: Capability| matches!(capability, Capability::Splitting | Capability::Latex);
    for capability in spec.emit.iter().filter(|capability| !goes(capability.value)) {
        found.report(capability.span, CapabilityMistake::UnitaryTerm { part: capability.value.name() });
    }
}
