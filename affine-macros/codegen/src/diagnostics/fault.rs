//! The macro's own mistakes.

use super::message::{Text, text};
use super::names::names;

/// What is wrong with the macro, not with the specification.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FaultMistake {
    /// The derivation met what it took for impossible.
    Impossible {
        /// What was thought to hold.
        belief: &'static str,
        /// Where it was thought.
        place: String,
    },
}

names! { FaultMistake
    Impossible => "impossible",
}

impl FaultMistake {
    pub(super) fn text(&self) -> Text {
        match self {
            Self::Impossible { belief, place } => text(
                "`affine_model(...)` has a fault of its own: the specification is not to blame",
                format!("{belief}; that did not hold at {place}, and what is derived from it could be wrong"),
                "report it as a fault of affine-macros, with the whole attribute and its struct",
            ),
        }
    }
}
