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
    /// `constraint = rigid` or `constraint = conformal`: all stretches are equal.
    Similar,
    /// `constraint = conformal` of `dalembert`, whose energy has the weight `D^2`.
    Weight,
    /// Terms whose mass matrices are constant in different frames, or not on the group of the constraint.
    Sum,
    /// `metrics(...)`.
    Metrics,
    /// `casimir3`.
    Casimir3,
    /// `group = unitary`.
    Unitary,
    /// A kinetic energy of affine velocities, none of `phi_dot`.
    AffineVelocities,
    /// A term in `phi_dot`.
    PhiDot,
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
    /// The gravity of the body on itself.
    SelfGravity,
    /// Something that `emit(...)` asks for.
    Emitted(Capability),
}

impl Part {
    /// What it is called, as the end of a sentence.
    pub fn name(self) -> String {
        match self {
            Self::Confined => "a constraint",
            Self::Similar => "`constraint = rigid` or `conformal`",
            Self::Weight => "`constraint = conformal` of `dalembert`",
            Self::Sum => "a mass matrix that depends on `phi`",
            Self::Metrics => "`metrics(...)`",
            Self::Casimir3 => "`casimir3`",
            Self::Unitary => "`group = unitary`",
            Self::AffineVelocities => "a kinetic energy of affine velocities",
            Self::PhiDot => "a kinetic energy of `phi_dot`",
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
            Self::SelfGravity => "`self_gravity(k)`",
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
        // That of `dalembert` alone, but for a centre of mass.
        let alone = spec.term(TermKind::Dalembert).is_some() && !mixed;
        let weight = constraint.value == Constraint::Conformal && alone;
        let similar = constraint.value != Constraint::Isochoric;
        parts.extend(similar.then(|| Present::at(Part::Similar, constraint.span)));
        parts.extend(weight.then(|| Present::at(Part::Weight, constraint.span)));
    }
    let energy = |part| Present::at(part, spec.kinetic_key);
    // Without a constraint the frames of its terms make it so.
    let name = spec.constraint.as_ref().map_or_else(
        || "a sum of different frames".to_owned(),
        |group| {
            format!("`constraint = {}`, under which the mass matrix depends on `phi`", group.value.name())
        },
    );
    parts.extend(mixed.then(|| Present { name, ..energy(Part::Sum) }));
    parts.extend(kinds(spec, mixed));
    parts.extend(spec.metrics.iter().flatten().take(1).map(|metric| Present::at(Part::Metrics, metric.span)));
    parts.extend(spec.group.map(|group| Present::at(Part::Unitary, group.span)));
    let fields = || spec.customs.iter().filter(|custom| !custom.role.value.is_force());
    match &spec.potential {
        Some(potential) => parts.push(Present::at(Part::Energy, potential.key)),
        None if fields().next().is_none() && spec.self_gravity.is_empty() => parts.push(energy(Part::Free)),
        None => {}
    }
    parts.extend(spec.dissipation.first().map(|term| Present::at(Part::Friction, term.kind.span)));
    parts.extend(spec.customs.iter().map(|custom| Present {
        part: field(custom),
        at: custom.span,
        name: format!("`custom({}, ..)`", custom.field),
    }));
    parts.extend(spec.self_gravity.iter().map(|gravity| Present::at(Part::SelfGravity, gravity.span)));
    parts.extend(spec.emit.iter().map(|asked| Present::at(Part::Emitted(asked.value), asked.span)));
    parts
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
        parts.extend((term.kind.value == TermKind::BodyTranslation).then(|| at(Part::BodyTranslation)));
    }
    // Terms that differ in the translation alone keep the frame of their velocities.
    let of = |frame: Frame| spec.kinetic.iter().any(|term| term.kind.value.internal_frame() == Some(frame));
    let is_over_phi_dot = is_flat || (mixed && of(Frame::Body) && of(Frame::Space));
    parts.extend((!is_over_phi_dot).then(|| Present::at(Part::AffineVelocities, spec.kinetic_key)));
    for term in spec.hamiltonian.iter().flatten() {
        let at = |part| Present { part, at: term.kind.span, name: format!("`{}`", term.kind.value.name()) };
        parts.extend((term.kind.value == MomentumKind::Casimir3).then(|| at(Part::Casimir3)));
        parts.extend((term.kind.value == MomentumKind::BodyTranslation).then(|| at(Part::BodyTranslation)));
    }
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
