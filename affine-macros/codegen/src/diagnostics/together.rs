//! Parts of a model that exclude each other.

use super::message::{Text, text};
use super::names::names;

/// Parts that do not go together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TogetherMistake {
    /// A part beside another.
    Beside {
        /// The part, as written.
        part: String,
        /// The other one.
        beside: String,
        /// The reason.
        why: &'static str,
        /// Its name in `emit(...)`, where it stands there.
        emitted: Option<&'static str>,
    },
}

names! { TogetherMistake
    Beside => "beside",
}

impl TogetherMistake {
    pub(super) fn text(&self) -> Text {
        let Self::Beside { part, beside, why, emitted } = self;
        text(
            format!("{part} does not go with {beside}"),
            *why,
            match emitted {
                Some(name) => {
                    format!("remove `{name}` from `emit(...)`: nothing else needs it")
                }
                None => "remove one of the two".to_owned(),
            },
        )
    }
}
