//! The terms of `hamiltonian(...)` as symbolic terms.

use super::constant::constant;
use crate::algebra::{Arena, Polynomial};
use crate::mechanics::hamiltonian::Isotropic;
use crate::mechanics::momentum_side::Stated;
use crate::mechanics::term::Frame;
use crate::spec::{MomentumKind, Spec, Value};

use super::certain;

/// The Hamiltonian, if the model states one; terms that are exactly zero leave no trace.
pub fn stated(arena: &mut Arena, spec: &Spec) -> Option<Stated> {
    let n = spec.dim.value;
    let (mut parts, mut translation, mut norm) = (Vec::new(), None, None);
    for (place, term) in spec.hamiltonian.as_ref()?.iter().enumerate() {
        let Value::Scalar(written) = &term.value else { continue };
        if constant(written, n).is_some_and(|value| value.is_zero()) {
            continue;
        }
        let value = certain(arena, n, written);
        let value = Polynomial::normal_form(arena, value);
        let zero = Isotropic::zero();
        let frame = match term.kind.value {
            MomentumKind::SpinSquared | MomentumKind::SpaceTranslation => Frame::Space,
            _ => Frame::Body,
        };
        let part = match term.kind.value {
            MomentumKind::Casimir2 => Isotropic { casimir2: value, ..zero },
            MomentumKind::Casimir1Squared => Isotropic { casimir1_squared: value, ..zero },
            MomentumKind::VorticitySquared | MomentumKind::SpinSquared => {
                norm = Some(frame);
                Isotropic { skew: value, ..zero }
            }
            MomentumKind::Casimir3 => Isotropic { casimir3: value, ..zero },
            MomentumKind::BodyTranslation | MomentumKind::SpaceTranslation => {
                translation = Some((place, frame, value));
                continue;
            }
        };
        parts.push((place, part));
    }
    let moving = translation.as_ref().map(|(_, frame, _)| *frame);
    let frame = norm.or(moving).unwrap_or(Frame::Body);
    let constraint = spec.constraint.as_ref().map(|constraint| constraint.value);
    Some(Stated { dim: n, constraint, frame, parts, translation })
}
