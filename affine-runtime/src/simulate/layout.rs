//! Where in a state its groups are, known when a model is compiled: what one does not need is then not compiled for it.

use core::ops::Range;

use crate::model::{Constraint, Description, Group, WORK};

/// Where a state holds what a run looks at without expanding it.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    /// The placement, row by row, up to factors of positive determinant that the expansion restores.
    pub(super) placement: Option<Range<usize>>,
    /// The work of the forces that no potential has.
    pub(super) work: Option<usize>,
}

impl Layout {
    /// That of a state of a body in dimension `n`.
    pub(super) const fn of(groups: &[Group], n: usize) -> Self {
        let work = match components(groups, WORK) {
            Some(range) => Some(range.start),
            None => None,
        };
        Self { placement: placement_in(groups, n), work }
    }
}

/// Number of components.
pub(super) const fn total(groups: &[Group]) -> usize {
    let mut total = 0;
    let mut k = 0;
    while k < groups.len() {
        total += groups[k].len;
        k += 1;
    }
    total
}

/// Components of a state that are the placement, row by row, up to factors of positive determinant that
/// the expansion restores.
pub(super) const fn placement_in(groups: &[Group], n: usize) -> Option<Range<usize>> {
    match components(groups, "phi") {
        Some(range) if range.end - range.start == n * n => Some(range),
        _ => match components(groups, "Psi") {
            Some(range) if range.end - range.start == n * n => Some(range),
            _ => None,
        },
    }
}

/// The reduced equations are those of the body without constraint, over `phi` and `Pi`.
pub(super) const fn is_canonical(model: &Description) -> bool {
    components(model.reduced, "Pi").is_some()
}

/// The equations are `q'' = f(t, q)`, so that `emit(nystrom)` exists: over `phi`, `Pi` and their like alone, of a kinetic
/// energy of `phi_dot` and `x_dot` without affine velocities.
pub(super) fn is_second_order(model: &Description) -> bool {
    let canonical = ["x", "phi", "p", "Pi", "1/D", "q"];
    let of_these = || model.reduced.iter().all(|group| canonical.contains(&group.name));
    let flat = || !["Omega", "phi^-1"].iter().any(|affine| model.kinetic_energy.text.contains(affine));
    model.constraint.is_none() && is_canonical(model) && of_these() && flat()
}

/// `1/D` or `q` is integrated beside the placement, so that `det phi` is not formed.
pub(super) const fn carries_dilatation(model: &Description) -> bool {
    components(model.reduced, "1/D").is_some() || components(model.reduced, "q").is_some()
}

/// The momentum of the phase point is that of a flat metric, `Pi`, and the placement may be any.
pub(super) const fn is_free_in_pi(model: &Description) -> bool {
    model.constraint.is_none() && components(model.full, "Pi").is_some()
}

/// The phase point is that of an isochoric body, with `Pi` its momentum: a multiplier keeps `det phi = 1`.
pub(crate) const fn has_multiplier(model: &Description) -> bool {
    matches!(model.constraint, Some(Constraint::Isochoric)) && components(model.full, "Pi").is_some()
}

/// Steps are taken on the group to which the motion is confined: the reduced state holds the placement.
pub(super) const fn moves_on_group(model: &Description, n: usize) -> bool {
    model.constraint.is_some() && placement_in(model.reduced, n).is_some()
}

const fn components(groups: &[Group], name: &str) -> Option<Range<usize>> {
    let mut start = 0;
    let mut k = 0;
    while k < groups.len() {
        if is_same(groups[k].name, name) {
            return Some(start..start + groups[k].len);
        }
        start += groups[k].len;
        k += 1;
    }
    None
}

/// Strings are not compared by `==` while compiling.
const fn is_same(a: &str, b: &str) -> bool {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    if a.len() != b.len() {
        return false;
    }
    let mut k = 0;
    while k < a.len() {
        if a[k] != b[k] {
            return false;
        }
        k += 1;
    }
    true
}
