//! Sentences on what is not integrated.

/// Something that is not integrated, and in which runs it is not.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LeftOut {
    /// What it is and why, in words.
    pub what: String,
    /// The runs.
    pub scope: Scope,
}

/// The runs that leave something out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// Every run of the model.
    Model,
    /// Those by the reduced equations.
    Reduction,
    /// Those by methods that integrate what the reduced state carries along.
    Carried,
    /// Those in closed form.
    ClosedForm,
}

impl Scope {
    /// Something that these runs leave out.
    pub fn without(self, what: impl Into<String>) -> LeftOut {
        LeftOut { what: what.into(), scope: self }
    }
}
