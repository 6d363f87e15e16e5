//! Where in a state its groups are, known when a model is compiled: what one does not need is then not compiled for it.

use core::ops::Range;

use crate::model::{Constraint, Description, Group, WORK};

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

/// The component that is the work of the forces that no potential has.
pub(super) const fn work_in(groups: &[Group]) -> Option<usize> {
    match components(groups, WORK) {
        Some(range) => Some(range.start),
        None => None,
    }
}

/// The reduced equations are those of the body without constraint, over `phi` and `Pi`.
pub(super) const fn is_canonical(model: &Description) -> bool {
    components(model.reduced, "Pi").is_some()
}

/// The phase point is that of an isochoric body, with `Pi` its momentum.
pub(super) const fn is_isochoric_in_pi(model: &Description) -> bool {
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
