//! Terms of a kinetic energy that are the same on a group.

use crate::algebra::Arena;
use crate::mechanics::term::{Coefficient, Frame, Term, TermKind};

use super::Constraint;

impl Constraint {
    /// The terms, each with its place, in one frame where the group allows it: with `phi` a rotation up to scale is
    /// `tr(Om Om^T) = tr(Oh Oh^T)`, so that a scalar inertia goes with the matrix inertias and tensors of the other side;
    /// and on SO(n) is `|phi^-1 x_dot| = |x_dot|`, so that two masses are one.
    pub fn restated(self, arena: &mut Arena, mut terms: Vec<(usize, Term)>) -> Vec<(usize, Term)> {
        if self == Self::Isochoric {
            return terms;
        }
        let same = |term: &Term| self.same_as(term.kind);
        let scalar = |term: &Term| matches!(term.value, Coefficient::Scalar(_));
        let is_free = |term: &Term| {
            matches!(same(term), TermKind::BodyInertia | TermKind::SpaceInertia) && scalar(term)
        };
        let frame = |term: &Term| same(term).internal_frame();
        let bound =
            |wanted: Frame| terms.iter().any(|(_, term)| !is_free(term) && frame(term) == Some(wanted));
        let any_of_space = terms.iter().any(|(_, term)| frame(term) == Some(Frame::Space));
        let any_of_body = terms.iter().any(|(_, term)| frame(term) == Some(Frame::Body));
        let home = match (bound(Frame::Body), bound(Frame::Space)) {
            (false, true) => TermKind::SpaceInertia,
            _ => TermKind::BodyInertia,
        };
        if any_of_body && any_of_space {
            terms.iter_mut().filter(|(_, term)| is_free(term)).for_each(|(_, term)| term.kind = home);
        }
        if self == Self::Rigid {
            merge_masses(arena, &mut terms);
        }
        terms
    }
}

/// `m/2 |x_dot|^2` with the sum of two masses.
fn merge_masses(arena: &mut Arena, terms: &mut Vec<(usize, Term)>) {
    let places: Vec<usize> =
        (0..terms.len()).filter(|k| terms[*k].1.kind.translation_frame().is_some()).collect();
    let [first, second] = places.as_slice() else { return };
    if let (Coefficient::Scalar(one), Coefficient::Scalar(other)) =
        (&terms[*first].1.value, &terms[*second].1.value)
    {
        let sum = arena.add(*one, *other);
        terms[*first].1 = Term { kind: TermKind::SpaceTranslation, value: Coefficient::Scalar(sum) };
        terms.remove(*second);
    }
}
