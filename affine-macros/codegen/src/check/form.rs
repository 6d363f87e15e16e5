//! Rules on the kinetic energy as a quadratic form, decided exactly.

use super::arithmetic::no_value;
use super::written::vanishing_term;
use super::{definite, dissipation, momentum_side, smooth, together, two_polar, unitary};
use crate::algebra::Arena;
use crate::diagnostics::{ConstraintMistake, Diagnostics, FormMistake, Reported};
use crate::lower::{self, PotentialEnergy};
use crate::mechanics::constraint::Constraint;
use crate::mechanics::forces::Forces;
use crate::mechanics::form::{Form, Mass, Positive};
use crate::mechanics::hessian::Hessian;
use crate::mechanics::kinetic::Kinetic;
use crate::mechanics::metrics::{Metrics, Rebased};
use crate::mechanics::mixed::Mixed;
use crate::mechanics::momentum_side::Stated;
use crate::mechanics::potential::Potential;
use crate::mechanics::symmetry::{Breaker, Group, Side, broken_by, largest_group};
use crate::mechanics::term::{Frame, Term};
use crate::spec::{Capability, Claim, Named, Spec};

/// A kinetic energy that was held against its own rules.
pub(super) struct Energy {
    pub(super) parts: Vec<Kinetic>,
    pub(super) mass: Mass,
    pub(super) positive: Positive,
    pub(super) stated: Option<Stated>,
    /// The parts of the energy as stated, on all of GL(n), where its terms may have different frames.
    pub(super) free: Vec<Kinetic>,
    pub(super) forces: Forces,
    pub(super) metrics: Option<Metrics>,
    pub(super) rebased: Vec<Rebased>,
    /// The places of its terms in the specification.
    pub(super) places: Vec<usize>,
}

/// The energy with what acts beside it, held against every rule.
///
/// # Errors
/// [`Reported`] if any is broken; all broken ones are in the bag.
pub(super) fn beside(
    mut arena: Arena,
    spec: &Spec,
    energy: Energy,
    found: &mut Diagnostics,
) -> Result<Form, Reported> {
    let Energy { parts, mass, positive, stated, free, mut forces, metrics, mut rebased, places } = energy;
    let (arena_of, metrics_of) = (&mut arena, metrics.as_ref());
    let group = parts.first().and_then(|part| part.constraint);
    let potential = potential(arena_of, spec, group, (metrics_of, &mut rebased), found);
    forces.driven = potential.as_ref().is_some_and(Potential::depends_on_time);
    forces.accounted = forces.driven && accounts(spec, &forces);
    together::with_potential(spec, potential.as_ref(), found);
    unitary::of_angles(spec, potential.as_ref(), found);
    let alone = match (&mass, parts.as_slice()) {
        (Mass::Constant(_), [kinetic]) => Some(kinetic),
        _ => None,
    };
    found.verdict()?;
    // Under `phi -> c phi` the energies of affine frames scale by `1/c^2` against flat ones, and on either side only one
    // affine frame is moved: a sum is invariant exactly if every part is.
    let group = |side: Side| free.iter().map(|part| largest_group(part, side)).min().unwrap_or(Group::Affine);
    let unitary = spec.group.is_some();
    let two_polar = match alone.filter(|_| !unitary) {
        Some(kinetic) => two_polar::asked(spec, kinetic, &places, potential.as_ref(), found)?,
        None => unitary,
    };
    Ok(Form {
        space_group: group(Side::Space),
        body_group: group(Side::Body),
        parts,
        mass,
        positive,
        stated,
        potential,
        forces,
        metrics,
        rebased,
        asked: spec.asked().with(Capability::TwoPolar, two_polar),
        unitary,
        arena,
    })
}

/// An energy whose mass matrix is constant in one frame.
///
/// # Errors
/// [`Reported`] if any rule is broken; all broken ones are in the bag.
pub(super) fn of_one_frame(
    arena: &mut Arena,
    spec: &Spec,
    found: &mut Diagnostics,
) -> Result<Energy, Reported> {
    let (places, stated): (Vec<usize>, Vec<Term>) =
        lower::terms(arena, spec.dim.value, &spec.kinetic).into_iter().unzip();
    let metrics = lower::metrics(arena, spec);
    let mut rebased = Vec::new();
    let terms = match &metrics {
        Some(metrics) => metrics.orthonormal(arena, &stated, &mut rebased),
        None => stated.clone(),
    };
    let free = spec.constraint.as_ref().map(|_| Mixed::new(arena, spec.dim.value, &terms, Frame::Body, None));
    let placed = places.iter().copied().zip(terms).collect();
    let (own_places, mut kinetic) = confined(arena, spec, placed)
        .filter(|(_, kinetic)| !kinetic.internal.is_empty())
        .ok_or_else(|| found.report(spec.kinetic_key, FormMistake::NoKineticEnergy))?;
    kinetic.congruent = metrics.as_ref().and_then(|metrics| metrics.congruent(arena, &kinetic, &stated));
    let hessian = Hessian::new(&kinetic);
    nothing_vanishes(spec, std::slice::from_ref(&kinetic), &own_places, found);
    definite::invertible(spec, kinetic.frame, &hessian, found);
    definite::positive(spec, &kinetic, &hessian, found);
    let free = free.map_or_else(|| vec![kinetic.clone()], |free| free.parts());
    for part in &free {
        claims(spec, part, |place| spec.kinetic[places[place]].kind.value.name(), found);
    }
    let forces = forces(arena, spec, kinetic.frame, (metrics.as_ref(), &mut rebased), found);
    smooth_beside(arena, spec, found)?;
    Ok(Energy {
        positive: Positive { internal: kinetic.is_dalembert(), centre: kinetic.is_dalembert() },
        parts: vec![kinetic],
        mass: Mass::Constant(hessian),
        stated: None,
        free,
        forces,
        metrics,
        rebased,
        places,
    })
}

/// A stated Hamiltonian. Groups and claims are decided on the form in the momenta.
///
/// # Errors
/// As [`of_one_frame`].
pub(super) fn of_momenta(
    arena: &mut Arena,
    spec: &Spec,
    stated: Stated,
    found: &mut Diagnostics,
) -> Result<Energy, Reported> {
    momentum_side::invertible(spec, &stated, found);
    momentum_side::positive(spec, &stated, found);
    momentum_side::nothing_vanishes(arena, spec, &stated, found);
    let on_momenta = stated.on_momenta(arena);
    let name = |place: usize| {
        spec.hamiltonian.iter().flatten().nth(place).map_or("hamiltonian", |term| term.kind.value.name())
    };
    claims(spec, &on_momenta, name, found);
    smooth_beside(arena, spec, found)?;
    let kinetic =
        stated.kinetic(arena).ok_or_else(|| found.report(spec.kinetic_key, FormMistake::NoKineticEnergy))?;
    let metrics = lower::metrics(arena, spec);
    let mut rebased = Vec::new();
    Ok(Energy {
        forces: forces(arena, spec, kinetic.frame, (metrics.as_ref(), &mut rebased), found),
        mass: Mass::Constant(Hessian::new(&kinetic)),
        parts: vec![kinetic],
        positive: Positive { internal: false, centre: false },
        stated: Some(stated),
        free: vec![on_momenta],
        metrics,
        rebased,
        places: Vec::new(),
    })
}

/// The potential beside an energy without mistakes is smooth.
///
/// # Errors
/// [`Reported`] if it is not, or anything was reported before.
pub(super) fn smooth_beside(arena: &mut Arena, spec: &Spec, found: &mut Diagnostics) -> Result<(), Reported> {
    found.verdict()?;
    smooth::potential(arena, spec, found);
    found.verdict()
}

/// The forces besides those of the potential, the dissipation held against its rule.
pub(super) fn forces(
    arena: &mut Arena,
    spec: &Spec,
    own: Frame,
    (metrics, rebased): (Option<&Metrics>, &mut Vec<Rebased>),
    found: &mut Diagnostics,
) -> Forces {
    let forces = lower::forces(arena, spec, own, metrics, rebased);
    if let Some(damping) = &forces.dissipation {
        dissipation::semidefinite(spec, damping, found);
        dissipation::nothing_vanishes(spec, damping, found);
    }
    forces
}

/// Has the motion a place for the work of a potential that depends on the time, `dH/dt = dU/dt` at rest? The halves of
/// equations of second order have none, and the kicks of pieces only beside the work of forces, which stands in one sum with it.
fn accounts(spec: &Spec, forces: &Forces) -> bool {
    let asked = spec.asked();
    !asked.has(Capability::Nystrom) && (!asked.has(Capability::Splitting) || forces.do_work())
}

/// The energy of a motion that may be confined to a group, with the places of its terms; `None` without a common frame,
/// which such energies have.
fn confined(arena: &mut Arena, spec: &Spec, stated: Vec<(usize, Term)>) -> Option<(Vec<usize>, Kinetic)> {
    let group = spec.constraint.as_ref().map(|constraint| constraint.value);
    let restated = match group {
        Some(group) => group.restated(arena, stated),
        None => stated,
    };
    let (places, terms): (Vec<usize>, Vec<Term>) = restated.into_iter().unzip();
    Some((places, Kinetic::under(arena, spec.dim.value, &terms, group).ok()?))
}

/// Every term says something about the velocities that the constraint leaves free: `(tr Om)^2` is zero where they are
/// traceless, and would be read by nobody.
pub(super) fn nothing_vanishes(spec: &Spec, parts: &[Kinetic], places: &[usize], found: &mut Diagnostics) {
    let Some(constraint) = spec.constraint else { return };
    let energies = parts.iter().flat_map(|part| part.internal.iter().map(move |energy| (part, energy)));
    for (part, (place, energy)) in energies {
        if Hessian::new(&part.only(*place, energy)).is_zero() {
            let kind = spec.kinetic[places[*place]].kind;
            let mistake = vanishing_term(kind.value.name(), constraint.value, "affine velocities");
            found.report(kind.span, mistake);
        }
    }
}

/// The potential on the group that is left: one that is constant there moves nothing, and one without a value there is
/// none.
fn potential(
    arena: &mut Arena,
    spec: &Spec,
    group: Option<Constraint>,
    (metrics, rebased): (Option<&Metrics>, &mut Vec<Rebased>),
    found: &mut Diagnostics,
) -> Option<Potential> {
    let stated = match lower::potential(arena, spec, metrics, rebased) {
        Ok(stated) => stated?,
        Err(reason) => return no_value(reason, found).ok().and(None),
    };
    let PotentialEnergy { energy, domain, slopes, multiplied_out } = stated;
    let (Some(group), Some(constraint), Some(written)) = (group, spec.constraint, &spec.potential) else {
        let mut potential = Potential::new(arena, spec.dim.value, energy).within(domain);
        if let Some(slopes) = slopes {
            potential = potential.with_slopes(arena, slopes);
        }
        return Some(match multiplied_out {
            Some(energy) => potential.or_by(arena, energy),
            None => potential,
        });
    };
    let left = Potential::under(arena, spec.dim.value, (energy, domain), group);
    let defect = match &left {
        None => "has no value",
        Some(left) if left.is_constant() => "is constant",
        Some(_) => return left,
    };
    let (constraint, group) = (constraint.value.name(), constraint.value.group());
    found.report(written.span, ConstraintMistake::ConstrainedPotential { defect, constraint, group });
    None
}

/// A claimed symmetry is a theorem about the form: its derivative along every generator of the group vanishes,
/// and for O(n) one reflection leaves it unchanged as well.
pub(super) fn claims(
    spec: &Spec,
    kinetic: &Kinetic,
    term: impl Fn(usize) -> &'static str,
    found: &mut Diagnostics,
) {
    let Some(symmetry) = &spec.symmetry else { return };
    for (side, name, claim) in [(Side::Space, "space", symmetry.space), (Side::Body, "body", symmetry.body)] {
        let (group, letters, less) = match claim.value {
            Claim::Affine => (Group::Affine, "GL", Some(Claim::Metric.name())),
            Claim::Metric => (Group::Metric, "O", None),
            Claim::None => continue,
        };
        let Some((breaker, place)) = broken_by(kinetic, side, group) else { continue };
        let n = kinetic.dim;
        let mistake = FormMistake::ClaimBroken {
            side: name,
            action: match side {
                Side::Space => "in space, phi -> L phi",
                Side::Body => "in the body, phi -> phi R",
            },
            claim: claim.value.name(),
            less,
            group: format!("{letters}({n})"),
            term: term(place),
            transformation: match breaker {
                Breaker::Generator(a, b) => format!("the generator E[{a},{b}]"),
                Breaker::Rotation(a, b) => format!("the generator E[{a},{b}] - E[{b},{a}]"),
                Breaker::Reflection => {
                    format!("the reflection diag(-1{})", ", 1".repeat(n - 1))
                }
            },
        };
        found.report(claim.span, mistake);
    }
}
