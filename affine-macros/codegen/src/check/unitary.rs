//! The rule of U(n).

use crate::diagnostics::{CapabilityMistake, Diagnostics};
use crate::mechanics::potential::Potential;
use crate::spec::{Capability, Named, Spec};
use crate::symbol::{Pattern, TermKind};

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
    let casimirs = |kind: TermKind| matches!(kind.pattern(), Pattern::TraceOfSquare | Pattern::SquareOfTrace);
    let others = spec.kinetic.iter().filter(|term| !casimirs(term.kind.value));
    let others = others.map(|term| (term.kind.span, term.kind.value.name()));
    // Claims and requirements speak of GL(n, R).
    let stated = [
        spec.symmetry.as_ref().map(|symmetry| (symmetry.space.span, "symmetry")),
        spec.constraint.map(|constraint| (constraint.span, "constraint")),
        spec.hamiltonian.as_ref().map(|_| (spec.kinetic_key, "hamiltonian")),
    ];
    let metrics = spec.metrics.iter().flatten().map(|metric| (metric.span, "metrics"));
    let required = spec.require.iter().map(|requirement| (requirement.span, requirement.value.name()));
    // Besides the lattice itself, its pieces and its formulas.
    let goes = |capability: Capability| matches!(capability, Capability::Splitting | Capability::Latex);
    let emitted = spec.emit.iter().filter(|capability| !goes(capability.value));
    let emitted = emitted.map(|capability| (capability.span, capability.value.name()));
    let all = others.chain(stated.into_iter().flatten()).chain(metrics).chain(required).chain(emitted);
    for (at, part) in all {
        found.report(at, CapabilityMistake::UnitaryTerm { part });
    }
}
