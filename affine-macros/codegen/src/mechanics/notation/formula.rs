//! A formula as text, and in LaTeX on demand.

use super::names::Notation;
use super::sentence::Sentence;
use crate::algebra::Arena;

/// A formula as it stands in a description.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Formula {
    /// Plain text.
    pub text: String,
    /// LaTeX, where that is asked for.
    pub latex: Option<String>,
}

impl Notation<'_> {
    /// A sentence as it is asked for.
    pub fn printed(&self, arena: &Arena, sentence: &Sentence) -> Formula {
        let latex = self.in_latex.then(|| self.latex(arena, sentence));
        Formula { text: self.text(arena, sentence), latex }
    }
}
