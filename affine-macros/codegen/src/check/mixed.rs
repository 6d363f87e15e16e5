//! Rules on a kinetic energy whose mass matrix depends on the placement: what can be decided for all placements.

use crate::algebra::{Arena, Expr};
use crate::diagnostics::{Diagnostics, FormMistake, Reported};
use crate::lower;
use crate::mechanics::form::{Mass, Positive};
use crate::mechanics::hessian::Hessian;
use crate::mechanics::kinetic::Kinetic;
use crate::mechanics::mixed::{Internal, Masses, Mixed};
use crate::mechanics::term::{Frame, Term};
use crate::spec::{Requirement, Spec};

use super::definite;
use super::form::{self, Energy};

/// Builds a sum of energies and holds it against its rules.
///
/// # Errors
/// [`Reported`] if any is broken; all broken ones are in the bag.
pub(super) fn energy(arena: &mut Arena, spec: &Spec, found: &mut Diagnostics) -> Result<Energy, Reported> {
    let group = spec.constraint.as_ref().map(|constraint| constraint.value);
    let (places, given): (Vec<usize>, Vec<Term>) =
        lower::terms(arena, spec.dim.value, &spec.kinetic).into_iter().unzip();
    let (metrics, mut rebased) = (lower::metrics(arena, spec), Vec::new());
    let free = match &metrics {
        Some(metrics) => metrics.orthonormal(arena, &given, &mut rebased),
        None => given,
    };
    let stated = places.iter().copied().zip(free.iter().cloned()).collect();
    let free = group.map(|_| Mixed::new(arena, spec.dim.value, &free, Frame::Body, None));
    let (own_places, terms): (Vec<usize>, Vec<Term>) = match group {
        Some(group) => group.restated(arena, stated),
        None => stated,
    }
    .into_iter()
    .unzip();
    let mut sums = [Frame::Body, Frame::Space]
        .map(|casimirs| Mixed::new(arena, spec.dim.value, &terms, casimirs, group));
    // The Casimirs may stand beside either affine energy: one sum of squares is as good as another.
    let proved = sums.each_ref().map(is_positive);
    sums.swap(0, usize::from(!proved[0] && proved[1]));
    let [mixed, _] = sums;
    let mass = match mixed.internal.as_slice() {
        [one] if group.is_none() => {
            let hessian = Hessian::new(one);
            definite::invertible(spec, one.frame, &hessian, found);
            Ok(Mass::Constant(hessian))
        }
        _ => regular_somewhere(spec, arena, &mixed, found),
    };
    let parts = mixed.parts();
    let heavy = |mass: &Expr| arena.as_constant(*mass).is_some_and(|m| !m.is_negative());
    let centre = Masses::of(&parts).list().iter().all(heavy);
    // Masses are positive, whatever the fields.
    let of_masses = mixed.internal.iter().all(Kinetic::is_dalembert);
    let positive = Positive { internal: of_masses || proved.contains(&true), centre: of_masses || centre };
    if !positive.internal {
        unproved(spec, &mixed, found);
    }
    form::nothing_vanishes(spec, &mixed.internal, &own_places, found);
    // Symmetries are those of the energy as stated, on all of GL(n).
    let free = free.map_or_else(|| parts.clone(), |free| free.parts());
    for part in &free {
        form::claims(spec, part, |place| spec.kinetic[places[place]].kind.value.name(), found);
    }
    let frame = match (group, mixed.internal.as_slice()) {
        (Some(_), _) => Frame::Body,
        (None, [one]) => one.frame,
        (None, _) => Frame::Flat,
    };
    let forces = form::forces(arena, spec, frame, (metrics.as_ref(), &mut rebased), found);
    form::smooth_beside(arena, spec, found)?;
    Ok(Energy { parts, mass: mass?, positive, stated: None, free, forces, metrics, rebased, places })
}

/// The momentum determines the velocity at some placement: the mass matrix is not singular everywhere. Where along a
/// motion it becomes so is for the run to notice.
fn regular_somewhere(
    spec: &Spec,
    arena: &mut Arena,
    mixed: &Mixed,
    found: &mut Diagnostics,
) -> Result<Mass, Reported> {
    let internal = Internal::new(arena, mixed).ok_or_else(|| {
        let terms = definite::internal_names(spec);
        found.report(spec.kinetic_key, FormMistake::DegenerateSum { terms })
    })?;
    Ok(Mass::Factorised(Box::new(internal)))
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
    let Some(required) = spec.required(Requirement::PositiveDefinite) else { return };
    let has_fields = mixed
        .internal
        .iter()
        .any(|part| Hessian::new(part).blocks.iter().any(|block| block.numbers().is_none()));
    if !has_fields {
        let defect =
            "a sum over different velocities is so at every placement where its parts in Oh, in Om and in \
                      phi_dot have no negative squares, and one of these has"
                .to_owned();
        found.report(required, FormMistake::NotPositiveDefinite { defect });
    }
}
