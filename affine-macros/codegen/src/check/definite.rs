//! Rules on the signs of a kinetic energy: no eigenvalue may vanish, and none be negative where that is required.

use super::written::{Written, eigenvalue_name, matrix_text, velocity_name};
use crate::diagnostics::{Diagnostics, FormMistake};
use crate::mechanics::direction::Direction;
use crate::mechanics::hessian::Hessian;
use crate::mechanics::kinetic::Kinetic;
use crate::mechanics::term::Frame;
use crate::spec::{self, Requirement, Spec};

/// The Legendre transformation (4.18), (4.20), (4.6), (4.8) must be invertible: no eigenvalue of the isotropic
/// form is zero, and a tensor has no kernel. Blocks with fields are left to `prepare()`.
pub(super) fn invertible(spec: &Spec, frame: Frame, hessian: &Hessian, found: &mut Diagnostics) {
    let mut reported = Vec::new();
    for block in &hessian.blocks {
        let kind = block.basis[0].kind;
        let vanishes = block.eigenvalue().is_some_and(|e| e.is_zero());
        if vanishes && kinetic_terms(spec).only_isotropic() && kind != Direction::Entry {
            if !reported.contains(&kind) {
                reported.push(kind);
                found.report(spec.kinetic_key, degenerate(spec, kind));
            }
        } else if let Some(kernel) = block.inertia(spec.dim.value).and_then(|inertia| inertia.kernel) {
            let kernel = matrix_text(spec.dim.value, &kernel);
            let mistake = FormMistake::DegenerateTensor {
                terms: internal_names(spec),
                velocity: velocity_name(frame),
                kernel,
            };
            found.report(spec.kinetic_key, mistake);
            return;
        }
    }
}

/// `require(positive_definite)`: every square of the form, and the mass, is positive. Squares with fields are
/// left to `prepare()`.
pub(super) fn positive(spec: &Spec, kinetic: &Kinetic, hessian: &Hessian, found: &mut Diagnostics) {
    let Some(required) = spec.required(Requirement::PositiveDefinite) else { return };
    let mut reported = Vec::new();
    for block in &hessian.blocks {
        let kind = block.basis[0].kind;
        let Some(inertia) = block.inertia(kinetic.dim).filter(|i| i.negative > 0) else { continue };
        let defect = match block.eigenvalue().and_then(|e| e.as_constant()) {
            Some(_) if kinetic_terms(spec).only_isotropic() && kind != Direction::Entry => {
                if reported.contains(&kind) {
                    continue;
                }
                reported.push(kind);
                format!(
                    "{} = {} is negative",
                    eigenvalue_name(kind).0,
                    kinetic_terms(spec).eigenvalue_in_numbers(kind)
                )
            }
            _ if inertia.negative == 1 => "T has a negative square".to_owned(),
            _ => format!("T has {} negative squares", inertia.negative),
        };
        found.report(required, FormMistake::NotPositiveDefinite { defect });
    }
    let mass = spec.kinetic.iter().find(|t| t.kind.value.is_translation());
    if let Some((term, value)) = mass.and_then(|t| Some((t, kinetic_terms(spec).scalar(t)?)))
        && value.is_negative()
    {
        let defect = format!("the mass `{} = {value}` is negative", term.kind.value.name());
        found.report(required, FormMistake::NotPositiveDefinite { defect });
    }
}

fn internal_terms(spec: &Spec) -> impl Iterator<Item = &spec::Term> {
    spec.kinetic.iter().filter(|t| !t.kind.value.is_translation())
}

/// Their names, joined by `+`.
pub(super) fn internal_names(spec: &Spec) -> String {
    internal_terms(spec).map(|term| term.kind.value.name()).collect::<Vec<_>>().join(" + ")
}

fn kinetic_terms(spec: &Spec) -> Written<'_> {
    Written { n: spec.dim.value, terms: internal_terms(spec).collect() }
}

fn degenerate(spec: &Spec, kind: Direction) -> FormMistake {
    let (eigenvalue, directions) = eigenvalue_name(kind);
    FormMistake::Degenerate {
        eigenvalue: eigenvalue.to_owned(),
        numbers: kinetic_terms(spec).eigenvalue_in_numbers(kind),
        directions,
    }
}
