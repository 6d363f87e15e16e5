//! Symbols of formulas: what each stands for, how it is written and what it means.

use crate::algebra::text::Shape;
use crate::symbol::{Aspect, Factor, Factorised, Quantity, Symbol};

/// A symbol of formulas.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Letter {
    /// What it stands for in the derivation; nothing where formulas alone name it.
    pub(super) of: Option<Of>,
    /// As text; `#` stands for indices.
    pub text: &'static str,
    /// As LaTeX, likewise.
    pub latex: &'static str,
    /// Where the LaTeX takes brackets.
    pub(super) shape: Shape,
    /// Its meaning, in words.
    pub meaning: &'static str,
}

/// Symbols of the derivation that are written alike but for their indices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Of {
    /// A quantity without components.
    One(Quantity),
    /// The components of a quantity.
    Components(Quantity),
    /// One of them.
    Component(Quantity, usize),
    /// What the energies in the body have of it.
    BodyShare(Quantity),
    /// The factorisation of the mass matrix of the centre.
    Centre(Factor),
}

impl Of {
    /// The indices of a symbol, where it is one of these.
    pub(super) fn indices(self, symbol: &Symbol) -> Option<&[usize]> {
        match (self, symbol) {
            (Self::One(quantity), Symbol::Component(own, indices)) => {
                (*own == quantity && indices.is_empty()).then_some(indices)
            }
            (Self::Components(quantity), Symbol::Component(own, indices)) => {
                (*own == quantity && !indices.is_empty()).then_some(indices)
            }
            (Self::Component(quantity, index), Symbol::Component(own, indices)) => {
                (*own == quantity && *indices == [index]).then_some(&[])
            }
            (Self::BodyShare(quantity), Symbol::About(Aspect::InTheBody, of)) => {
                Self::Components(quantity).indices(of)
            }
            (Self::Centre(factor), Symbol::Factor(own, Factorised::Centre, 0, indices)) => {
                (*own == factor).then_some(indices)
            }
            _ => None,
        }
    }
}

const fn letter(of: Option<Of>, text: &'static str, latex: &'static str, meaning: &'static str) -> Letter {
    Letter { of, text, latex, shape: Shape::Letter, meaning }
}

/// A quantity without components.
pub(super) const fn one(
    of: Quantity,
    text: &'static str,
    latex: &'static str,
    meaning: &'static str,
) -> Letter {
    letter(Some(Of::One(of)), text, latex, meaning)
}

/// The components of a quantity.
pub(super) const fn of(
    of: Quantity,
    text: &'static str,
    latex: &'static str,
    meaning: &'static str,
) -> Letter {
    letter(Some(Of::Components(of)), text, latex, meaning)
}

/// One of the traces of powers.
pub(super) const fn power(
    of: Quantity,
    power: usize,
    text: &'static str,
    latex: &'static str,
    meaning: &'static str,
) -> Letter {
    letter(Some(Of::Component(of, power)), text, latex, meaning)
}

/// What the energies in the body have of a momentum.
pub(super) const fn share(
    of: Quantity,
    text: &'static str,
    latex: &'static str,
    meaning: &'static str,
) -> Letter {
    letter(Some(Of::BodyShare(of)), text, latex, meaning)
}

/// Numbers of the factorised mass matrix of the centre.
pub(super) const fn factor(
    of: Factor,
    text: &'static str,
    latex: &'static str,
    meaning: &'static str,
) -> Letter {
    letter(Some(Of::Centre(of)), text, latex, meaning)
}

/// A matrix, a function or a group that formulas name as a whole.
pub(super) const fn whole(text: &'static str, latex: &'static str, meaning: &'static str) -> Letter {
    letter(None, text, latex, meaning)
}

/// One whose LaTeX has a superscript.
pub(super) const fn raised(letter: Letter) -> Letter {
    Letter { shape: Shape::Raised, ..letter }
}

/// One whose LaTeX is a function without brackets.
pub(super) const fn applied(letter: Letter) -> Letter {
    Letter { shape: Shape::Applied, ..letter }
}
