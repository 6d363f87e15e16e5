//! Mistakes in forces and in the dissipation.

use super::message::{Text, listed, suggestion, text};
use super::names::names;

/// A mistake in a force or in the dissipation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ForceMistake {
    /// `custom(...)` that does not say what the field computes, or something else in its place.
    MalformedCustom {
        /// `potential` or `forces`.
        key: &'static str,
        /// What stands there.
        found: String,
        /// What it takes besides the field.
        takes: &'static str,
        /// How it may look.
        example: String,
    },
    /// `custom(...)` of something that is no field.
    UnknownField {
        /// The name.
        name: String,
        /// The field probably meant.
        nearest: Option<String>,
        /// The fields.
        fields: Vec<String>,
    },
    /// A force on a centre that stands still.
    FixedCentreForce {
        /// The translation term, or `custom(..)`.
        term: String,
        /// The key it stands in.
        key: &'static str,
    },
    /// A dissipation function that is negative at some velocity.
    NegativeDissipation {
        /// What shows it, in the user's numbers: `I - A = 0.1 - 0.2 = -1/10 on skew velocities (rotation)`.
        defect: String,
    },
}

names! { ForceMistake
    MalformedCustom => "malformed-custom",
    UnknownField => "unknown-field",
    FixedCentreForce => "fixed-centre-force",
    NegativeDissipation => "negative-dissipation",
}

impl ForceMistake {
    pub(super) fn text(&self) -> Text {
        match self {
            Self::MalformedCustom { key, found, takes, example } => text(
                format!("`{key}` has {found} where `custom(field, ..)` should say what a field computes"),
                format!("it is a summand by itself, and takes {takes}"),
                format!("write `{key} = {example}`"),
            ),
            Self::UnknownField { name, nearest, fields } => text(
                format!("there is no field `{name}`"),
                format!("`custom(field, ..)` calls a field of the struct, which has {}", listed(fields)),
                suggestion(
                    nearest.as_deref(),
                    "add the field, of a type that implements `affine_runtime::force::Force` or \
                     `affine_runtime::potential::Potential`",
                ),
            ),
            Self::FixedCentreForce { term, key } => text(
                format!("`{term}` in `{key}` acts on a centre that stands still"),
                "without a translational kinetic energy the centre is fixed in space: x_dot = 0, and p is not part of \
                 the state",
                format!(
                    "add `space_translation = m` or `body_translation = m` to `kinetic(...)`, or remove `{term}`"
                ),
            ),
            Self::NegativeDissipation { defect } => text(
                format!("the dissipation is negative: {defect}"),
                "the forces of R have the power -2 R; where R < 0 they would feed energy in. The terms of each frame \
                 count together; casimir terms count with those of the body, or else with those of space",
                "change a coefficient so that R >= 0 at every velocity; an isotropic R has it iff I >= |A| and \
                 I + A + n B >= 0, where I is the inertia, A is `casimir2`, B is `casimir1_squared`",
            ),
        }
    }
}
