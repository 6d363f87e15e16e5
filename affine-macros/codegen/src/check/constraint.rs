//! Rules on what a constraint leaves of a model.

use super::constant;
use crate::diagnostics::{ConstraintMistake, Diagnostics};
use crate::spec::{MomentumKind, Named, Spec, Term, TermKind};

/// On the group, energies in `phi_dot` have mass matrices that depend on the placement, but for one:
/// `tr(phi_dot J phi_dot^T) = D^2 tr(Oh J Oh^T)` of a rigid or conformal motion depends at most on `D`, and the isochoric
/// one has a multiplier instead.
pub(super) fn constant_mass_matrix(spec: &Spec, found: &mut Diagnostics) {
    let Some(constraint) = spec.constraint else { return };
    for term in terms(spec) {
        if term.kind.value == TermKind::FlatTensor {
            let mistake = ConstraintMistake::ConstrainedMassMatrix {
                term: term.kind.value.name(),
                constraint: constraint.value.name(),
                group: constraint.value.group(),
            };
            found.report(term.kind.span, mistake);
        }
    }
}

/// With `C(3)` velocities are quadratic in the momenta, and those of a subalgebra do not belong to the momenta of its
/// dual; and the group of a metric is that of its orthonormal bases.
pub(super) fn stands_alone(spec: &Spec, found: &mut Diagnostics) {
    let Some(constraint) = spec.constraint else { return };
    let cubic = spec.hamiltonian.iter().flatten().any(|term| term.kind.value == MomentumKind::Casimir3);
    let beside = [("casimir3", cubic), ("metrics(...)", spec.has_metrics())];
    for (key, _) in beside.into_iter().filter(|(_, stated)| *stated) {
        found.report(constraint.span, ConstraintMistake::ConstraintBeside { key });
    }
}

/// The terms that are not exactly zero.
fn terms(spec: &Spec) -> impl Iterator<Item = &Term> {
    let zero = |term: &Term| {
        term.value
            .expressions()
            .all(|entry| constant(entry, spec.dim.value).is_some_and(|value| value.is_zero()))
    };
    spec.kinetic.iter().filter(move |term| !zero(term))
}
