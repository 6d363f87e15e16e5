//! What dissipations and what fields compute do not stand beside.

use super::frames;
use crate::diagnostics::{Diagnostics, ForceMistake, Region};
use crate::spec::{Capability, Custom, MomentumKind, Spec};
use crate::symbol::{Constraint, TermKind};

/// The forces are derived, and what they leave conserved is decided, in orthonormal bases, projected under a constraint.
/// The equations of an isochoric body with `dalembert` are those without the constraint, to which the method adds the
/// multiplier: there potentials of fields stand as well, but nothing that depends on the velocity. What is emitted beyond
/// the equations is derived from formulas alone.
pub(super) fn stand_alone(spec: &Spec, found: &mut Diagnostics) {
    let damping = spec.dissipation.first().map(|term| Force {
        name: "dissipation(...)".to_owned(),
        span: term.kind.span,
        under_a_multiplier: false,
        is_formula: true,
        has_a_flow: true,
        is_conservative: false,
    });
    for force in damping.into_iter().chain(spec.customs.iter().map(Force::of)) {
        for (key, _) in beside(spec, &force).into_iter().filter(|(_, stated)| *stated) {
            found.report(force.span, ForceMistake::ForceBeside { force: force.name.clone(), key });
        }
    }
}

/// A part of a model that forces come from.
struct Force {
    /// The key or field that the force comes from, as written.
    name: String,
    span: Region,
    /// Does it act on an isochoric body as on a free one, whatever the multiplier?
    under_a_multiplier: bool,
    /// Is it known by its formula?
    is_formula: bool,
    /// Is its motion known while positions stay: a kick, or friction that is linear in velocities?
    has_a_flow: bool,
    /// Does it follow from a potential? The work of any other is integrated beside the motion.
    is_conservative: bool,
}

impl Force {
    fn of(custom: &Custom) -> Self {
        let name = format!("custom({}, ..)", custom.field);
        let is_force = custom.role.value.is_force();
        Self {
            name,
            span: custom.span,
            under_a_multiplier: !is_force,
            is_formula: false,
            has_a_flow: custom.is_kick(),
            is_conservative: !is_force,
        }
    }
}

/// What may be stated beside a force, and whether it is and refuses it.
fn beside(spec: &Spec, force: &Force) -> [(&'static str, bool); 7] {
    let emitted = |wanted: Capability| spec.emit.iter().any(|capability| capability.value == wanted);
    let cubic = |terms: &Vec<_>| {
        terms.iter().any(|term: &crate::spec::Term<MomentumKind>| term.kind.value == MomentumKind::Casimir3)
    };
    [
        ("`constraint = isochoric` of `dalembert`", has_multiplier(spec) && !force.under_a_multiplier),
        ("`casimir3`", spec.hamiltonian.as_ref().is_some_and(cubic)),
        ("`group = unitary`", spec.group.is_some()),
        ("`emit(taylor)`", emitted(Capability::Taylor) && !force.is_formula),
        ("`emit(splitting)`", emitted(Capability::Splitting) && !force.has_a_flow),
        ("`emit(nystrom)`", emitted(Capability::Nystrom) && !force.is_conservative),
        ("`emit(two_polar)`", emitted(Capability::TwoPolar)),
    ]
}

/// Does the constraint act through its multiplier?
pub(super) fn has_multiplier(spec: &Spec) -> bool {
    spec.constraint.is_some_and(|constraint| constraint.value == Constraint::Isochoric)
        && spec.term(TermKind::Dalembert).is_some()
        && !frames::are_mixed(spec)
}
