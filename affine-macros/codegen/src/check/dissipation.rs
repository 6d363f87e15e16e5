//! Rules on the dissipation function `R`.

use super::written::{Written, eigenvalue_name, matrix_text, vanishing_term, velocity_name};
use crate::algebra::Rational;
use crate::algebra::linear::negative_direction;
use crate::diagnostics::{Diagnostics, ForceMistake};
use crate::mechanics::direction::Direction;
use crate::mechanics::dissipation::{Dissipation, Part};
use crate::mechanics::hessian::{Block, Hessian};
use crate::mechanics::kinetic::Kinetic;
use crate::mechanics::term::Frame;
use crate::spec::{self, Spec};

/// Without a translational kinetic energy the centre of mass stands still, and nothing slows it.
pub(super) fn centre(spec: &Spec, found: &mut Diagnostics) {
    if spec.translation().is_some() {
        return;
    }
    for term in spec.dissipation.iter().filter(|term| term.kind.value.is_translation()) {
        let term_name = term.kind.value.name().to_owned();
        found.report(term.kind.span, ForceMistake::FixedCentreForce { term: term_name, key: "dissipation" });
    }
}

/// Every term takes energy from velocities that the constraint leaves free: `(tr Om)^2` takes none where they are
/// traceless.
pub(super) fn nothing_vanishes(spec: &Spec, dissipation: &Dissipation, found: &mut Diagnostics) {
    let Some(constraint) = spec.constraint else { return };
    let group = Some(constraint.value);
    for Part { form, .. } in dissipation.parts.iter().filter(|part| part.form.frame != Frame::Flat) {
        for (place, energy) in &form.internal {
            let form = Kinetic { constraint: group, ..form.clone() };
            let written = spec.dissipation.iter().find(|term| same_kind(term, &form.terms[*place]));
            if let Some(term) = written.filter(|_| Hessian::new(&form.only(*place, energy)).is_zero()) {
                let mistake = vanishing_term(term.kind.value.name(), constraint.value, "affine velocities");
                found.report(term.kind.span, mistake);
            }
        }
    }
}

/// `dE/dt = -2 R`: a dissipation takes energy or nothing, whatever the velocity. The terms of each frame are decided
/// together, exactly: `R >= 0` for all placements as soon as it holds in each. Blocks with fields are left to
/// `prepare()`.
pub(super) fn semidefinite(spec: &Spec, dissipation: &Dissipation, found: &mut Diagnostics) {
    for term in spec.dissipation.iter().filter(|term| term.kind.value.is_translation()) {
        let written = Written { n: spec.dim.value, terms: vec![term] };
        if let Some(value) = written.scalar(term).filter(Rational::is_negative) {
            let defect = format!("`{}` is {value}", term.kind.value.name());
            found.report(term.span, ForceMistake::NegativeDissipation { defect });
        }
    }
    let internal = || spec.dissipation.iter().filter(|term| !term.kind.value.is_translation());
    for part in &dissipation.parts {
        let terms: Vec<&spec::Term> =
            part.form.terms.iter().filter_map(|term| internal().find(|t| same_kind(t, term))).collect();
        let Some(first) = terms.first() else { continue };
        let written = Written { n: spec.dim.value, terms: terms.clone() };
        let mut reported = Vec::new();
        for block in &part.hessian.blocks {
            let kind = block.basis[0].kind;
            let Some(defect) = defect(&written, part, block).filter(|_| !reported.contains(&kind)) else {
                continue;
            };
            reported.push(kind);
            found.report(first.kind.span, ForceMistake::NegativeDissipation { defect });
            if !written.only_isotropic() {
                break;
            }
        }
    }
}

fn same_kind(written: &spec::Term, term: &crate::mechanics::term::Term) -> bool {
    written.kind.value == term.kind
}

/// A velocity of the block on which `R` is negative.
fn defect(written: &Written, part: &Part, block: &Block) -> Option<String> {
    let kind = block.basis[0].kind;
    if let Some(value) = block.eigenvalue().filter(|_| written.only_isotropic() && kind != Direction::Entry) {
        let value = value.as_constant().filter(Rational::is_negative)?;
        let (name, directions) = eigenvalue_name(kind);
        let numbers = written.eigenvalue_in_numbers(kind);
        return Some(format!("{name} = {numbers} = {value} on {directions}"));
    }
    let direction = negative_direction(&block.numbers()?)?;
    let velocity = block.velocity(written.n, &direction);
    let half = Rational::HALF;
    let value = &block.square(&direction)? * &half;
    let name = velocity_name(part.form.frame);
    Some(format!("R = {value} at {name} = {}", matrix_text(written.n, &velocity)))
}
