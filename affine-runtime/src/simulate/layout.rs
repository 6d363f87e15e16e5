//! Where in a state its groups are, known when a model is compiled: what one does not need is then not compiled for it.

use core::ops::Range;

use crate::model::{Description, Group, Model, Quantity};
use crate::state::Phase;

/// Where a state holds what a run looks at without expanding it.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    /// The placement, row by row, up to factors of positive determinant that the expansion restores.
    pub(super) placement: Option<Range<usize>>,
    /// The work of the forces that no potential has.
    pub(super) work: Option<usize>,
}

/// The components of the first group that matches a pattern. Patterns are compared while compiling, `==` is not.
macro_rules! components {
    ($groups:expr, $wanted:pat) => {{
        let (groups, mut start, mut k, mut found) = ($groups, 0, 0, None);
        while k < groups.len() && found.is_none() {
            let end = start + groups[k].len;
            if matches!(groups[k].quantity, $wanted) {
                found = Some(start..end);
            }
            start = end;
            k += 1;
        }
        found
    }};
}

impl Layout {
    /// That of a state of a body in dimension `n`.
    pub(super) const fn of(groups: &[Group], n: usize) -> Self {
        let work = match components!(groups, Quantity::Work) {
            Some(range) => Some(range.start),
            None => None,
        };
        Self { placement: placement_in(groups, n), work }
    }
}

/// Energy goes elsewhere: friction, a drive, a force of the user.
pub(super) const fn has_work(model: &Description) -> bool {
    components!(model.reduced, Quantity::Work).is_some()
}

/// Components of a state that are the internal momentum, in whatever frame, where it has all `n^2` of them.
pub(super) const fn momentum_in(groups: &[Group], n: usize) -> Option<Range<usize>> {
    let momentum = components!(
        groups,
        Quantity::CanonicalMomentum | Quantity::AffineSpin | Quantity::ComovingAffineSpin
    );
    match momentum {
        Some(range) if range.end - range.start == n * n => Some(range),
        _ => None,
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
    match components!(groups, Quantity::Placement | Quantity::IsochoricPlacement) {
        Some(range) if range.end - range.start == n * n => Some(range),
        _ => None,
    }
}

/// `1/D` or `q` is integrated beside the placement, so that `det phi` is not formed.
pub(super) const fn carries_dilatation(model: &Description) -> bool {
    components!(model.reduced, Quantity::InverseDilatation | Quantity::MeanLogStretch).is_some()
}

/// The momentum of the phase point is that of a flat metric, `Pi`, and the placement may be any.
pub(super) const fn is_free_in_pi(model: &Description) -> bool {
    model.constraint.is_none() && components!(model.full, Quantity::CanonicalMomentum).is_some()
}

/// Steps are taken on the group to which the motion is confined: the reduced state holds the placement.
pub(super) const fn moves_on_group(model: &Description, n: usize) -> bool {
    model.constraint.is_some() && placement_in(model.reduced, n).is_some()
}

/// Steps of a body are looked at one by one: no placement stands in its state, the state is on a group, a mass matrix that
/// depends on the placement may change its signature, or a potential does not have a value everywhere.
pub(super) fn is_looked_after<const N: usize, M: Model<N>>(model: &M, point: &M::Point<f64>) -> bool {
    let never =
        const { placement_in(M::DESCRIPTION.reduced, N).is_none() || M::DESCRIPTION.constraint.is_some() };
    never || !M::DESCRIPTION.domain.is_empty() || model.regularity(point.phi()).is_some()
}
