//! A formula in both notations.

/// A formula in both notations.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Formula {
    /// Plain text.
    pub text: String,
    /// LaTeX.
    pub latex: String,
}

impl Formula {
    /// With definitions of what it names.
    #[must_use]
    pub(in crate::mechanics) fn with(self, definitions: Vec<Formula>) -> Self {
        definitions.into_iter().fold(self, |formula, Formula { text, latex }| Formula {
            text: format!("{}, {text}", formula.text),
            latex: format!("{},\\quad {latex}", formula.latex),
        })
    }

    /// `left = self`.
    pub(in crate::mechanics) fn of(self, left: &str, left_latex: &str) -> Self {
        let Self { text, latex } = self;
        Self { text: format!("{left} = {text}"), latex: format!("{left_latex} = {latex}") }
    }
}
