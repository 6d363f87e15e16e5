//! What goes together: pairs of parts that exclude each other, each with its reason. Whatever is not in [`REFUSED`] goes
//! together; a test tries every pair.

use crate::diagnostics::{Diagnostics, TogetherMistake};
use crate::mechanics::potential::Potential;
use crate::spec::{Capability, Named, Spec};

use super::parts::{self, Part, Present};
use Part::{
    AffineVelocities, BodyTranslation, Casimir3, Confined, Emitted, Energy, FieldPotential, Force, Free,
    Friction, Kick, Metrics, OnCentre, OnStretches, OnTime, PhiDot, SelfGravity, Similar, Sum, Unitary,
    Weight,
};

/// Parts that are refused beside each of others, for one reason.
struct Row(&'static [Part], &'static [Part], &'static str);

const TAYLOR: Part = Emitted(Capability::Taylor);
const SPLITTING: Part = Emitted(Capability::Splitting);
const NYSTROM: Part = Emitted(Capability::Nystrom);
const TWO_POLAR: Part = Emitted(Capability::TwoPolar);
const RATIOS: Part = Emitted(Capability::Ratios);
const BALANCE: Part = Emitted(Capability::Balance);
const METRIC: Part = Emitted(Capability::Metric);

/// What does not go together.
const REFUSED: [Row; 24] = [
    Row(
        &[TAYLOR],
        &[OnStretches],
        "stretches are found by an iteration, and what follows from the operations of a formula does not follow from it",
    ),
    Row(
        &[TAYLOR],
        &[Force, Kick, FieldPotential],
        "what a field computes is not known operation by operation",
    ),
    Row(
        &[TAYLOR],
        &[SelfGravity],
        "its integral is found by an iteration, and not known operation by operation",
    ),
    Row(
        &[SPLITTING],
        &[Weight],
        "the energy has the weight D^2, and no piece of it is quadratic in momenta with constant coefficients",
    ),
    Row(&[SPLITTING], &[Sum], "the mass matrix depends on phi: the flow of the kinetic energy is not known"),
    Row(
        &[SPLITTING],
        &[Force],
        "a force is a piece of its own where it depends on positions alone, and is said to: `custom(field, form, position)`",
    ),
    Row(
        &[NYSTROM],
        &[Confined],
        "Nystrom methods integrate q'' = f(t, q); a constraint acts by forces that depend on velocities",
    ),
    Row(
        &[NYSTROM],
        &[AffineVelocities, Sum],
        "Nystrom methods integrate q'' = f(t, q); the mass matrix of phi_dot depends on phi here, and phi'' on phi_dot",
    ),
    Row(
        &[NYSTROM],
        &[BodyTranslation],
        "Nystrom methods integrate q'' = f(t, q); the weight of the centre depends on phi here, and x'' on phi_dot",
    ),
    Row(
        &[NYSTROM],
        &[Free],
        "a body that nothing acts on moves in a straight line, phi = phi0 + t phi_dot0, known in closed form",
    ),
    Row(
        &[NYSTROM],
        &[Friction, Force, Kick],
        "Nystrom methods integrate q'' = f(t, q); friction and the work of a force depend on velocities",
    ),
    Row(&[TWO_POLAR], &[Metrics], LATTICE),
    Row(&[TWO_POLAR], &[Similar], "all stretches are equal there, and nothing of the lattice moves"),
    Row(&[TWO_POLAR], &[OnTime, OnCentre], LATTICE),
    Row(
        &[TWO_POLAR],
        &[BodyTranslation],
        "the weight of the centre depends on the stretches, and moves them",
    ),
    Row(
        &[TWO_POLAR],
        &[Casimir3, Sum],
        "the lattice is that of one quadratic energy of velocities (6.2) to (6.5)",
    ),
    Row(
        &[TWO_POLAR],
        &[Friction, Force, Kick, FieldPotential, SelfGravity],
        "its equations follow from T and potentials that are formulas",
    ),
    Row(&[RATIOS], &[Energy, PhiDot], RATIONAL),
    Row(&[BALANCE], &[AffineVelocities, Confined, Metrics], KINEMATICAL),
    Row(
        &[METRIC],
        &[Casimir3],
        "the velocity is quadratic in the momentum, and the kinetic energy no quadratic form of velocities",
    ),
    Row(
        &[Friction, Force, Kick, FieldPotential, SelfGravity],
        &[Casimir3],
        "what it leaves conserved is decided for velocities that are linear in the momenta",
    ),
    Row(
        &[Friction, Force, Kick, FieldPotential, SelfGravity],
        &[Unitary],
        "the lattice of U(n) is that of the Casimir terms alone",
    ),
    Row(
        &[Confined],
        &[Metrics],
        "the group of a constraint is that of orthonormal bases, and points stand in others",
    ),
    Row(
        &[Confined],
        &[Casimir3],
        "the velocity is quadratic in the momentum: the momenta whose velocities the group leaves free form no linear space",
    ),
];

const LATTICE: &str =
    "(q, p, M, N) of (6.2) to (6.5) describe the internal motion on GL(n) alone, in orthonormal coordinates";
const RATIONAL: &str = "in exp(q_b - q_a), M + N and M - N the lattice of the Casimirs is rational, (6.2) to (6.4); forces of a potential \
                        and (6.5) are not";
const KINEMATICAL: &str = "K = phi Pi, phi J phi_dot^T of (2.1), is balanced against phi_dot and Pi (3.6): for energies with a term in phi_dot, \
                           or terms of space and body, of a motion on all of GL(n) in orthonormal coordinates";

/// A pair of parts that exclude each other.
#[derive(Clone, Copy, Debug)]
pub struct Refusal {
    /// What is refused.
    pub part: Part,
    /// Beside what.
    pub beside: Part,
    /// The reason.
    pub why: &'static str,
}

/// All of them.
pub fn refusals() -> impl Iterator<Item = Refusal> {
    REFUSED.iter().flat_map(|Row(parts, others, why)| {
        parts.iter().flat_map(move |part| {
            others.iter().map(move |beside| Refusal { part: *part, beside: *beside, why })
        })
    })
}

/// The table in Markdown, a row for each reason.
pub fn table() -> String {
    let names = |parts: &[Part]| parts.iter().map(|part| part.name()).collect::<Vec<_>>().join(", ");
    let row = |Row(parts, others, why): &Row| format!("| {} | {} | {why} |\n", names(parts), names(others));
    let rows: String = REFUSED.iter().map(row).collect();
    format!("| refused | beside | why |\n|---|---|---|\n{rows}")
}

/// No two parts of a specification exclude each other.
pub(super) fn as_written(spec: &Spec, found: &mut Diagnostics) {
    let parts = parts::written(spec);
    exclude(&parts, &parts, found);
}

/// Does the specification say anything that this part may not stand beside?
pub(super) fn refuses(spec: &Spec, part: Part) -> bool {
    let written = parts::written(spec);
    refusals()
        .filter(|refusal| refusal.part == part)
        .any(|refusal| written.iter().any(|present| present.part == refusal.beside))
}

/// Nor does what the potential turns out to depend on exclude any.
pub(super) fn with_potential(spec: &Spec, potential: Option<&Potential>, found: &mut Diagnostics) {
    if let Some(potential) = potential {
        exclude(&parts::written(spec), &parts::of_potential(spec, potential), found);
    }
}

fn exclude(parts: &[Present], others: &[Present], found: &mut Diagnostics) {
    for Refusal { part, beside, why } in refusals() {
        for present in parts.iter().filter(|present| present.part == part) {
            for other in others.iter().filter(|other| other.part == beside) {
                let emitted = match part {
                    Emitted(capability) => Some(capability.name()),
                    _ => None,
                };
                let (part, beside) = (present.name.clone(), other.name.clone());
                found.report(present.at, TogetherMistake::Beside { part, beside, why, emitted });
            }
        }
    }
}
