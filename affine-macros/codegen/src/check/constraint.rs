//! Rules on what a constraint leaves of a model.

use super::constant;
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::spec::{Constraint, Named, Spec, Term, TermKind};

/// On the group, energies in `phi_dot` have mass matrices that depend on the placement, but for two:
/// `tr(phi_dot J phi_dot^T) = tr(Oh J Oh^T)` of a rigid motion, and the isochoric one, whose constraint has a
/// multiplier instead.
pub(super) fn constant_mass_matrix(spec: &Spec, found: &mut Diagnostics) {
    let Some(constraint) = spec.constraint else { return };
    for term in terms(spec) {
        let curved = match (term.kind.value, constraint.value) {
            (TermKind::FlatTensor, _) => true,
            (TermKind::Dalembert, constraint) => constraint == Constraint::Conformal,
            _ => false,
        };
        if curved {
            let mistake = Diagnostic::ConstrainedMassMatrix {
                term: term.kind.value.name(),
                constraint: constraint.value.name(),
                group: constraint.value.group(),
            };
            found.report(term.kind.span, mistake);
        }
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
