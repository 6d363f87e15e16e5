//! The parts of a model, as far as others may not stand beside them.

use crate::diagnostics::Region;
use crate::mechanics::potential::Potential;
use crate::spec::{Capability, Custom, Mark, MomentumKind, Named, Spec};
use crate::symbol::{Constraint, Frame, TermKind};

use super::frames;

/// A part that a model may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// `constraint = ...`.
    Confined,
    /// `constraint = isochoric` of `dalembert`, which acts through its multiplier.
    Multiplier,
    /// `constraint = conformal` of `dalembert`, whose energy has the weight `D^2`.
    Weight,
    /// Terms whose mass matrices are constant in different frames.
    Sum,
    /// Such terms under a constraint.
    ConfinedSum,
    /// `metrics(...)`.
    Metrics,
    /// `hamiltonian(...)`.
    Hamiltonian,
    /// `casimir3`.
    Casimir3,
    /// `group = unitary`.
    Unitary,
    /// A kinetic energy of affine velocities, none of `phi_dot`.
    AffineVelocities,
    /// A term in `phi_dot`.
    PhiDot,
    /// A term other than `dalembert` and `space_translation`.
    BeyondDalembert,
    /// A centre of mass whose weight the body carries.
    BodyTranslation,
    /// No potential at all.
    Free,
    /// `potential = ...` with a formula.
    Energy,
    /// A potential of single stretches.
    OnStretches,
    /// A potential of the time.
    OnTime,
    /// A potential of the position.
    OnCentre,
    /// `dissipation(...)`.
    Friction,
    /// A force of a field that may depend on velocities.
    Force,
    /// A force of a field that depends on positions alone.
    Kick,
    /// A potential that a field computes.
    FieldPotential,
    /// Something that `emit(...)` asks for.
    Emitted(Capability),
}

impl Part {
    /// What it is called, as the end of a sentence.
    #[must_use]
    pub fn name(self) -> String {
        match self {
            Self::Confined => "a constraint",
            Self::Multiplier => "`constraint = isochoric` of `dalembert`",
            Self::Weight => "`constraint = conformal` of `dalembert`",
            Self::Sum => "a sum of different frames",
            Self::ConfinedSum => "a sum of different frames under a constraint",
            Self::Metrics => "`metrics(...)`",
            Self::Hamiltonian => "`hamiltonian(...)`",
            Self::Casimir3 => "`casimir3`",
            Self::Unitary => "`group = unitary`",
            Self::AffineVelocities => "a kinetic energy of affine velocities",
            Self::PhiDot => "a kinetic energy of `phi_dot`",
            Self::BeyondDalembert => "terms other than `dalembert` and `space_translation`",
            Self::BodyTranslation => "`body_translation`",
            Self::Free => "a motion without a potential",
            Self::Energy => "a potential",
            Self::OnStretches => "a potential of single stretches",
            Self::OnTime => "a potential of the time",
            Self::OnCentre => "a potential of `x`",
            Self::Friction => "`dissipation(...)`",
            Self::Force => "`custom(field, form)` in `forces`",
            Self::Kick => "`custom(field, form, position)` in `forces`",
            Self::FieldPotential => "`custom(field, class)` in `potential`",
            Self::Emitted(capability) => return format!("`emit({})`", capability.name()),
        }
        .to_owned()
    }
}

/// A part that a model has.
pub(super) struct Present {
    pub(super) part: Part,
    /// Where it stands.
    pub(super) at: Region,
    /// As written there.
    pub(super) name: String,
}

impl Present {
    fn at(part: Part, at: Region) -> Self {
        Self { part, at, name: part.name() }
    }
}

/// The parts that a specification says.
pub(super) fn written(spec: &Spec) -> Vec<Present> {
    let mut parts: Vec<Present> = Vec::new();
    let mixed = frames::are_mixed(spec);
    if let Some(constraint) = spec.constraint {
        let name = format!("`constraint = {}`", constraint.value.name());
        parts.push(Present { part: Part::Confined, at: constraint.span, name });
        let weight = constraint.value == Constraint::Conformal && is_dalembert(spec);
        parts.extend(has_multiplier(spec).then(|| Present::at(Part::Multiplier, constraint.span)));
        parts.extend(weight.then(|| Present::at(Part::Weight, constraint.span)));
    }
    let energy = |part| Present::at(part, spec.kinetic_key);
    parts.extend(mixed.then(|| energy(Part::Sum)));
    parts.extend((mixed && spec.constraint.is_some()).then(|| energy(Part::ConfinedSum)));
    parts.extend(kinds(spec, mixed));
    parts.extend(spec.metrics.iter().flatten().take(1).map(|metric| Present::at(Part::Metrics, metric.span)));
    parts.extend(spec.group.map(|group| Present::at(Part::Unitary, group.span)));
    let fields = || spec.customs.iter().filter(|custom| !custom.role.value.is_force());
    match &spec.potential {
        Some(potential) => parts.push(Present::at(Part::Energy, potential.key)),
        None if fields().next().is_none() => parts.push(energy(Part::Free)),
        None => {}
    }
    parts.extend(spec.dissipation.first().map(|term| Present::at(Part::Friction, term.kind.span)));
    parts.extend(spec.customs.iter().map(|custom| Present {
        part: field(custom),
        at: custom.span,
        name: format!("`custom({}, ..)`", custom.field),
    }));
    parts.extend(spec.emit.iter().map(|asked| Present::at(Part::Emitted(asked.value), asked.span)));
    parts
}

/// Does the constraint act through its multiplier?
pub(super) fn has_multiplier(spec: &Spec) -> bool {
    spec.constraint.is_some_and(|constraint| constraint.value == Constraint::Isochoric) && is_dalembert(spec)
}

/// Is the energy that of `dalembert` alone, but for a centre of mass?
fn is_dalembert(spec: &Spec) -> bool {
    spec.term(TermKind::Dalembert).is_some() && !frames::are_mixed(spec)
}

/// What the terms of the energy make of it.
fn kinds(spec: &Spec, mixed: bool) -> Vec<Present> {
    let mut parts: Vec<Present> = Vec::new();
    let mut is_flat = false;
    for term in &spec.kinetic {
        let at = |part| Present { part, at: term.kind.span, name: format!("`{}`", term.kind.value.name()) };
        let flat = term.kind.value.internal_frame() == Some(Frame::Flat);
        parts.extend((flat && !is_flat).then(|| at(Part::PhiDot)));
        is_flat |= flat;
        let balanced = matches!(term.kind.value, TermKind::Dalembert | TermKind::SpaceTranslation);
        parts.extend((!balanced).then(|| at(Part::BeyondDalembert)));
        parts.extend((term.kind.value == TermKind::BodyTranslation).then(|| at(Part::BodyTranslation)));
    }
    parts.extend((!is_flat && !mixed).then(|| Present::at(Part::AffineVelocities, spec.kinetic_key)));
    for term in spec.hamiltonian.iter().flatten() {
        let at = |part| Present { part, at: term.kind.span, name: format!("`{}`", term.kind.value.name()) };
        parts.extend((term.kind.value == MomentumKind::Casimir3).then(|| at(Part::Casimir3)));
        parts.extend((term.kind.value == MomentumKind::BodyTranslation).then(|| at(Part::BodyTranslation)));
    }
    parts.extend(spec.hamiltonian.is_some().then(|| Present::at(Part::Hamiltonian, spec.kinetic_key)));
    parts
}

fn field(custom: &Custom) -> Part {
    match custom.role.value.is_force() {
        false => Part::FieldPotential,
        true if custom.mark == Some(Mark::Position) => Part::Kick,
        true => Part::Force,
    }
}

/// What a potential depends on, once what cancels in it is gone.
pub(super) fn of_potential(spec: &Spec, potential: &Potential) -> Vec<Present> {
    let Some(written) = &spec.potential else { return Vec::new() };
    let depends = [
        (Part::OnStretches, potential.has_single_stretches()),
        (Part::OnTime, potential.depends_on_time()),
        (Part::OnCentre, potential.moves_the_centre()),
    ];
    depends.into_iter().filter(|(_, does)| *does).map(|(part, _)| Present::at(part, written.key)).collect()
}
