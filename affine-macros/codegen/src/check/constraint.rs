//! Rules on what a constraint leaves of a model.

use crate::diagnostics::{ConstraintMistake, Diagnostics};
use crate::spec::{MomentumKind, Spec};

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
