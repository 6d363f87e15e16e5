//! Names of matrices, of their entries and of those of their inverses.

use crate::algebra::text::Written;

/// A matrix by name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MatrixName {
    /// As text.
    pub(in crate::mechanics) text: String,
    /// In LaTeX.
    pub(in crate::mechanics) latex: String,
    /// Can an index be set at the LaTeX?
    pub(super) letter: bool,
}

impl MatrixName {
    pub(super) fn new(text: impl Into<String>, latex: impl Into<String>, letter: bool) -> Self {
        Self { text: text.into(), latex: latex.into(), letter }
    }

    /// The LaTeX to which an index is set.
    pub(in crate::mechanics) fn indexed(&self) -> String {
        if self.letter { self.latex.clone() } else { format!("({})", self.latex) }
    }

    /// Text and LaTeX of an entry, indices from 1.
    pub(super) fn entry(&self, row: usize, column: usize) -> [Written; 2] {
        [
            Written::letter(format!("{}[{row},{column}]", self.text)),
            Written::letter(format!("{}_{{{row}{column}}}", self.indexed())),
        ]
    }

    /// The inverse.
    #[must_use]
    pub(in crate::mechanics) fn inverse(&self) -> Self {
        Self {
            text: format!("{}^-1", self.text),
            latex: format!("{}^{{-1}}", self.latex),
            letter: self.letter,
        }
    }

    /// Text and LaTeX of an entry of the inverse.
    pub(super) fn inverse_entry(&self, row: usize, column: usize) -> [Written; 2] {
        self.inverse().entry(row, column).map(|Written { body, .. }| Written::raised(body))
    }
}
