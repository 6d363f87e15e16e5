//! The form of the texts, which stand with their mistakes. Every message has three parts: what is wrong, why, and
//! what to write instead.

use std::fmt;

/// The three parts of a message.
#[must_use]
pub(super) struct Text {
    what: String,
    why: String,
    instead: String,
}

impl Text {
    /// Writes the message of the mistake with this name.
    pub(super) fn write(&self, name: &str, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { what, why, instead } = self;
        write!(f, "{what} [{name}]\nwhy: {why}\ninstead: {instead}")
    }
}

/// A text of these parts.
pub(super) fn text(what: impl Into<String>, why: impl Into<String>, instead: impl Into<String>) -> Text {
    Text { what: what.into(), why: why.into(), instead: instead.into() }
}

/// `` `a`, `b` and `c` ``.
pub(super) fn listed<S: AsRef<str>>(names: &[S]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{}`", name.as_ref())).collect();
    match quoted.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, rest)) => format!("{} and {last}", rest.join(", ")),
        None => "none".to_owned(),
    }
}

/// The nearest known name, or else the advice to pick one.
pub(super) fn suggestion(nearest: Option<&str>, otherwise: &str) -> String {
    nearest.map_or_else(|| otherwise.to_owned(), |name| format!("did you mean `{name}`?"))
}

/// `a = b`, or `a` alone where both are the same text.
pub(super) fn equated(name: &str, value: &str) -> String {
    if name == value { name.to_owned() } else { format!("{name} = {value}") }
}
