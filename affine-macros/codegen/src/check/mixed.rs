//! Rules on a kinetic energy whose mass matrix depends on the placement: what can be decided for all placements.

use crate::algebra::Arena;
use crate::diagnostics::{CapabilityMistake, Diagnostics, FormMistake, Reported};
use crate::lower;
use crate::mechanics::form::{MixedForm, Positive};
use crate::mechanics::hessian::Hessian;
use crate::mechanics::kinetic::Kinetic;
use crate::mechanics::mixed::{Internal, Masses, Mixed};
use crate::mechanics::symmetry::Side;
use crate::mechanics::term::{Frame, Term};
use crate::spec::{Capability, Named, Requirement, Spec};

use super::form::{self};
use super::{capabilities, definite};

/// Builds the form and holds it against every rule.
///
/// # Errors
/// [`Reported`] if any rule is broken; all broken ones are in the bag.
pub(super) fn form(spec: &Spec, found: &mut Diagnostics) -> Result<MixedForm, Reported> {
    if spec.has_metrics() {
        found.report(spec.kinetic_key, FormMistake::SumBeside { key: "metrics(...)" });
    }
    let group = spec.constraint.as_ref().map(|constraint| lower::constraint(constraint.value));
    if let Some(lattice) = spec.emit.iter().find(|capability| capability.value == Capability::TwoPolar) {
        let part = "terms of different frames".to_owned();
        found.report(
            lattice.span,
            CapabilityMistake::LatticeWithout { part, lacks: "mass matrix that depends on phi" },
        );
    }
    capabilities::one_frame(spec, found);
    capabilities::on_the_group(spec, found);
    let mut arena = Arena::new();
    let stated = lower::terms(&mut arena, spec.dim.value, &spec.kinetic);
    let (places, free): (Vec<usize>, Vec<Term>) = stated.iter().cloned().unzip();
    let free = group.map(|_| Mixed::new(&mut arena, spec.dim.value, &free, Frame::Body, None));
    let (own_places, terms): (Vec<usize>, Vec<Term>) = match group {
        Some(group) => group.restated(&mut arena, stated),
        None => stated,
    }
    .into_iter()
    .unzip();
    let mut sums = [Frame::Body, Frame::Space]
        .map(|casimirs| Mixed::new(&mut arena, spec.dim.value, &terms, casimirs, group));
    let hessian = match sums[0].internal.as_slice() {
        [one] if group.is_none() => {
            let hessian = Hessian::new(one);
            definite::invertible(spec, &hessian, found);
            Some(hessian)
        }
        _ => {
            regular_somewhere(spec, &mut arena, &sums[0], found);
            None
        }
    };
    // The Casimirs may stand beside either affine energy: one sum of squares is as good as another.
    let proved = sums.each_ref().map(is_positive);
    sums.swap(0, usize::from(!proved[0] && proved[1]));
    let [mixed, _] = sums;
    let masses = Masses::of(&mixed);
    let heavy = |mass| arena.as_constant(mass).is_some_and(|m| !m.is_negative());
    let positive = Positive {
        internal: proved.contains(&true),
        centre: masses.body.into_iter().chain(masses.space).all(heavy),
    };
    if !positive.internal {
        unproved(spec, &mixed, found);
    }
    form::nothing_vanishes(spec, &mixed.internal, &own_places, found);
    // Symmetries are those of the energy as stated, on all of GL(n).
    let free = free.unwrap_or_else(|| mixed.clone());
    for part in free.parts() {
        form::claims(spec, &part, |place| spec.kinetic[places[place]].kind.value.name(), found);
    }
    let own = match (group, mixed.internal.as_slice()) {
        (Some(_), _) => Frame::Body,
        (None, [one]) => one.frame,
        (None, _) => Frame::Flat,
    };
    let mut forces = form::forces(&mut arena, spec, own, (None, &mut Vec::new()), found);
    found.verdict()?;
    super::smooth::potential(&mut arena, spec, found);
    found.verdict()?;
    let potential = form::potential(&mut arena, spec, group, (None, &mut Vec::new()), found);
    forces.driven = form::driven(spec, potential.as_ref());
    capabilities::series(spec, potential.as_ref(), found);
    capabilities::tangent(spec, potential.as_ref(), found);
    found.verdict()?;
    Ok(MixedForm {
        hessian,
        positive,
        space_group: free.largest_group(Side::Space),
        body_group: free.largest_group(Side::Body),
        mixed,
        potential,
        forces,
        asked: capabilities::asked_for(spec),
        arena,
    })
}

/// The momentum determines the velocity at some placement: the mass matrix is not singular everywhere. Where along a
/// motion it becomes so is for the run to notice.
fn regular_somewhere(spec: &Spec, arena: &mut Arena, mixed: &Mixed, found: &mut Diagnostics) {
    if Internal::new(arena, mixed).is_none() {
        let names = spec.kinetic.iter().filter(|term| !term.kind.value.is_translation());
        let terms: Vec<&str> = names.map(|term| crate::spec::Named::name(term.kind.value)).collect();
        found.report(spec.kinetic_key, FormMistake::DegenerateSum { terms: terms.join(" + ") });
    }
}

/// A sum of positive semidefinite energies, one of them definite, is positive definite at every placement. Undecided
/// where fields enter.
fn is_positive(mixed: &Mixed) -> bool {
    let squares = |part: &Kinetic| {
        let blocks = Hessian::new(part).blocks;
        let inertias: Option<Vec<_>> = blocks.iter().map(|block| block.inertia(mixed.dim)).collect();
        let inertias = inertias?;
        let semidefinite = inertias.iter().all(|inertia| inertia.negative == 0);
        Some((semidefinite, inertias.iter().all(|inertia| inertia.kernel.is_none())))
    };
    let squares: Option<Vec<(bool, bool)>> = mixed.internal.iter().map(squares).collect();
    squares.is_some_and(|list| list.iter().all(|s| s.0) && list.iter().any(|s| s.1))
}

/// `require(positive_definite)` of an energy without fields that is no sum of squares. One with fields is held to it
/// at every start and along every motion.
fn unproved(spec: &Spec, mixed: &Mixed, found: &mut Diagnostics) {
    let required = spec.require.iter().find(|r| r.value == Requirement::PositiveDefinite);
    let Some(required) = required else { return };
    let has_fields = mixed
        .internal
        .iter()
        .any(|part| Hessian::new(part).blocks.iter().any(|block| block.numbers().is_none()));
    if !has_fields {
        let defect =
            "a sum over different velocities is so at every placement where its parts in Oh, in Om and in \
                      phi_dot have no negative squares, and one of these has"
                .to_owned();
        found.report(required.span, FormMistake::NotPositiveDefinite { defect });
    }
}
