//! The Hamiltonian as stated on the momentum side.

use super::written::{bracketed, vanishing_term};
use crate::algebra::fault::never_missing;
use crate::algebra::{Arena, Polynomial};
use crate::diagnostics::{Diagnostics, Directions, FormMistake, TermMistake};
use crate::lower::constant;
use crate::mechanics::direction::Direction;
use crate::mechanics::momentum_side::Stated;
use crate::spec::{Expression, ExpressionKind, MomentumKind, Named, Requirement, Spec, Term, Value};

/// Each term is a multiple of one invariant.
pub(super) fn scalars(spec: &Spec, found: &mut Diagnostics) {
    for term in terms(spec).filter(|term| written(term).is_none()) {
        let mistake = TermMistake::TermShape {
            term: term.kind.value.name(),
            found: term.value.shape(),
            takes: "a scalar: it multiplies one invariant of the affine spin or of p".to_owned(),
            instead: "write one expression, as in `casimir2 = 5/6`; inertias and tensors are stated in `kinetic(...)`"
                .to_owned(),
        };
        found.report(term.span, mistake);
    }
}

/// `|Vort|^2` is a constant form in `Sigma_hat`, `|S|^2` in `Sigma`, and likewise `|p_hat|^2` and `|p|^2`: the velocity
/// of their sum is a form in the momentum that depends on phi.
pub(super) fn one_frame(spec: &Spec, found: &mut Diagnostics) {
    let forms = |kind| match kind {
        MomentumKind::VorticitySquared => Some((false, "Sigma_hat = Pi phi")),
        MomentumKind::SpinSquared => Some((false, "Sigma = phi Pi")),
        MomentumKind::BodyTranslation => Some((true, "p_hat = phi^T p")),
        MomentumKind::SpaceTranslation => Some((true, "p")),
        _ => None,
    };
    let mut earlier: [Option<(&'static str, &'static str)>; 2] = [None; 2];
    for term in terms(spec).filter(|term| !is_zero(term, spec.dim.value)) {
        let Some((of_centre, momentum)) = forms(term.kind.value) else { continue };
        let name = term.kind.value.name();
        match earlier[usize::from(of_centre)] {
            None => earlier[usize::from(of_centre)] = Some((name, momentum)),
            Some((first, first_velocity)) => {
                let mistake = FormMistake::MixedFrames {
                    first,
                    first_velocity,
                    second: name,
                    second_velocity: momentum,
                };
                found.report(term.kind.span, mistake);
            }
        }
    }
}

/// `tr X^3` is a function of `tr X` and `tr X^2` for n = 2 (Cayley and Hamilton).
pub(super) fn third_casimir(spec: &Spec, found: &mut Diagnostics) {
    let cubic = terms(spec).find(|term| term.kind.value == MomentumKind::Casimir3);
    if let Some(term) = cubic.filter(|_| spec.dim.value == 2) {
        found.report(term.kind.span, TermMistake::PlanarCasimir3);
    }
}

/// `x_dot = p/m`: with `1/m = 0` the centre stands still whatever `p` is.
pub(super) fn inverse_masses(spec: &Spec, found: &mut Diagnostics) {
    for term in terms(spec).filter(|term| term.kind.value.is_translation() && is_zero(term, spec.dim.value)) {
        let coefficient = written(term).map(Expression::to_string);
        let coefficient = never_missing(coefficient, "what is zero was written", String::new());
        found.report(term.span, TermMistake::ZeroInverseMass { term: term.kind.value.name(), coefficient });
    }
}

/// The velocity `O = a X + b tr(X) 1 - c (X - X^T)` determines the momentum iff none of `a`, `2c - a`, `a + n b` is
/// zero; values with fields are left to `prepare()`. With `casimir3` the velocity never does, and nothing is asked.
pub(super) fn invertible(spec: &Spec, stated: &Stated, found: &mut Diagnostics) {
    if stated.is_cubic() {
        return;
    }
    let sum = stated.invariants();
    let eigenvalues = stated.eigenvalues();
    let shears = eigenvalues.iter().any(|(direction, _)| *direction == Direction::Shear);
    for (direction, value) in eigenvalues.into_iter().filter(|(_, value)| value.is_zero()) {
        // Without a norm, or without the other Casimir, these vanish with `casimir2`, which is reported.
        let alone = match direction {
            Direction::Rotation => shears && sum.skew.is_zero() && value == sum.casimir2,
            Direction::Dilatation => shears && sum.casimir1_squared.is_zero(),
            Direction::Shear | Direction::Entry => false,
        };
        if !alone {
            let (eigenvalue, numbers, directions) = eigenvalue(spec, direction);
            let mistake = FormMistake::DegenerateHamiltonian { eigenvalue, numbers, directions };
            found.report(spec.kinetic_key, mistake);
        }
    }
}

/// Every term says something about the momenta that the constraint leaves: `C(1)^2` is zero where they are traceless.
pub(super) fn nothing_vanishes(arena: &mut Arena, spec: &Spec, stated: &Stated, found: &mut Diagnostics) {
    let Some(constraint) = &spec.constraint else { return };
    for term in stated.vanishing(arena).into_iter().filter_map(|place| terms(spec).nth(place)) {
        let mistake = vanishing_term(term.kind.value.name(), constraint.value, "affine momenta");
        found.report(term.kind.span, mistake);
    }
}

/// `require(positive_definite)`: `T > 0` iff `H > 0`, for a form and its inverse have the same signs. Values with
/// fields are left to `prepare()`.
pub(super) fn positive(spec: &Spec, stated: &Stated, found: &mut Diagnostics) {
    let Some(required) = spec.required(Requirement::PositiveDefinite) else { return };
    if stated.is_cubic() {
        let defect = "with `casimir3`, tr X^3 takes both signs".to_owned();
        found.report(required, FormMistake::NotPositiveDefinite { defect });
        return;
    }
    let negative = |value: &Polynomial| value.as_constant().is_some_and(|value| value.is_negative());
    for (direction, _) in stated.eigenvalues().iter().filter(|(_, value)| negative(value)) {
        let (eigenvalue, numbers, _) = eigenvalue(spec, *direction);
        let text = match numbers {
            Some(numbers) if eigenvalue != numbers => format!("{eigenvalue} = {numbers}"),
            _ => eigenvalue,
        };
        found.report(required, FormMistake::NotPositiveDefinite { defect: format!("{text} is negative") });
    }
    if let Some((place, _, value)) = &stated.translation
        && let (Some(value), Some(term)) = (value.as_constant(), terms(spec).nth(*place))
        && value.is_negative()
    {
        let defect = format!("the inverse mass `{} = {value}` is negative", term.kind.value.name());
        found.report(required, FormMistake::NotPositiveDefinite { defect });
    }
}

/// An eigenvalue by the names of the terms, with the user's coefficients in it, and the momenta it belongs to.
fn eigenvalue(spec: &Spec, direction: Direction) -> (String, Option<String>, Directions) {
    let of = |kind| terms(spec).find(|term| term.kind.value == kind).and_then(written);
    let coefficient = |kind| of(kind).map_or_else(|| "0".to_owned(), |e| bracketed(e.to_string()));
    let a = coefficient(MomentumKind::Casimir2);
    match direction {
        Direction::Shear | Direction::Entry => {
            let written = of(MomentumKind::Casimir2);
            let is_zero =
                |e: &Expression| matches!(&e.kind, ExpressionKind::Number(number) if number.is_zero());
            let numbers = written.filter(|e| !is_zero(e)).map(|_| a);
            ("casimir2".to_owned(), numbers, Directions::SymmetricTraceless)
        }
        Direction::Rotation => {
            let norms = [MomentumKind::VorticitySquared, MomentumKind::SpinSquared];
            let norm = norms.into_iter().find(|kind| terms(spec).any(|term| term.kind.value == *kind));
            match norm {
                Some(kind) => (
                    format!("2 {} - casimir2", kind.name()),
                    Some(format!("2*{} - {a}", coefficient(kind))),
                    Directions::Skew,
                ),
                None => ("-casimir2".to_owned(), Some(format!("-{a}")), Directions::Skew),
            }
        }
        Direction::Dilatation => (
            "casimir2 + n casimir1_squared".to_owned(),
            Some(format!("{a} + {}*{}", spec.dim.value, coefficient(MomentumKind::Casimir1Squared))),
            Directions::Trace,
        ),
    }
}

fn terms(spec: &Spec) -> impl Iterator<Item = &Term<MomentumKind>> {
    spec.hamiltonian.iter().flatten()
}

fn written(term: &Term<MomentumKind>) -> Option<&Expression> {
    match &term.value {
        Value::Scalar(e) => Some(e),
        _ => None,
    }
}

fn is_zero(term: &Term<MomentumKind>, n: usize) -> bool {
    written(term).and_then(|e| constant(e, n)).is_some_and(|value| value.is_zero())
}
