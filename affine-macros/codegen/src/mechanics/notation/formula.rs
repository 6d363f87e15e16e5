//! A formula in both notations.

use super::names::Notation;
use super::sentence::Sentence;
use crate::algebra::Arena;

/// A formula in both notations.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Formula {
    /// Plain text.
    pub text: String,
    /// LaTeX.
    pub latex: String,
}

impl Notation<'_> {
    /// A sentence in both notations.
    #[must_use]
    pub fn printed(&self, arena: &Arena, sentence: &Sentence) -> Formula {
        Formula { text: self.text(arena, sentence), latex: self.latex(arena, sentence) }
    }
}
