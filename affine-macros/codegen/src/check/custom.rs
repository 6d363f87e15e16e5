//! Rules on `custom(...)` and `self_gravity(k)`.

use crate::diagnostics::{Diagnostics, ForceMistake, PotentialMistake};
use crate::spec::{Role, Spec, nearest};

/// What is called is a field of the struct, of any type: whether it computes what is said is for the compiler.
pub(super) fn fields(spec: &Spec, found: &mut Diagnostics) {
    for custom in &spec.customs {
        if spec.item.fields.iter().any(|field| field.ident == custom.field) {
            continue;
        }
        let fields: Vec<String> = spec.item.fields.iter().map(|field| field.ident.to_string()).collect();
        let name = custom.field.to_string();
        let nearest = nearest(&name, fields.iter().map(String::as_str)).map(str::to_owned);
        found.report(custom.field.span(), ForceMistake::UnknownField { name, nearest, fields });
    }
}

/// The gravity of a body on itself is that of an ellipsoid in space.
pub(super) fn in_space(spec: &Spec, found: &mut Diagnostics) {
    for gravity in spec.self_gravity.iter().filter(|_| spec.dim.value != 3) {
        found.report(gravity.span, PotentialMistake::GravityInThePlane);
    }
}

/// Without a translational kinetic energy the centre is fixed in space: nothing pushes it, and x is not part of the
/// state.
pub(super) fn centre(spec: &Spec, found: &mut Diagnostics) {
    if spec.translation().is_some() {
        return;
    }
    for custom in &spec.customs {
        let form = format!("custom({}, ..)", custom.field);
        if custom.role.value == Role::Translation {
            found.report(custom.span, ForceMistake::FixedCentreForce { term: form, key: "forces" });
        } else if custom.mark.is_some() && !custom.role.value.is_force() {
            found.report(custom.span, PotentialMistake::FixedCentre { form });
        }
    }
}
