//! What the names in expressions stand for.

use proc_macro2::Ident;

use super::{Field, MatrixName, Named, Spec};

/// What a name in an expression stands for.
#[derive(Clone, Copy)]
#[must_use]
pub enum Symbol<'a> {
    /// `n`.
    Dimension,
    /// `q = ln(det phi)/n`, the mean logarithmic stretch.
    Dilatation,
    /// `D = exp(q)`.
    Scale,
    /// `det`, the determinant of phi.
    Determinant,
    /// `t`.
    Time,
    /// `I1`, ..., `In`: coefficients of the characteristic polynomial of G, I1 = tr G, In = det G. The index as
    /// written, not yet known to be at most n.
    Invariant(usize),
    /// `q1..qn`, `Q1..Qn`: logarithmic stretches and stretches. The index as written.
    Stretch(usize),
    /// `d` of `pairs(...)`: the difference of two logarithmic stretches.
    Difference,
    /// A matrix, which is no number by itself.
    Matrix(MatrixName),
    /// `x`, the centre: likewise.
    Centre,
    /// A field of the struct.
    Field(&'a Field),
}

/// The symbols of all expressions besides the fields, with their meaning.
pub const SYMBOLS: [(&str, &str); 1] = [("n", "the dimension")];

/// The symbols of potentials besides those of all expressions.
pub const POTENTIAL_SYMBOLS: [(&str, &str); 18] = [
    ("q", "the mean logarithmic stretch ln(det phi)/n"),
    ("D", "the mean stretch exp(q)"),
    ("det", "the determinant of phi"),
    ("t", "the time"),
    ("x", "the place of the centre"),
    ("G", "the Green deformation tensor phi^T phi"),
    ("Ct", "phi phi^T, the inverse Cauchy deformation tensor"),
    ("phi", "the placement"),
    ("I1", "the first invariant of G"),
    ("I2", "the second invariant of G"),
    ("I3", "the third invariant of G"),
    ("d", "the difference q_a - q_b of a pair"),
    ("q1", "the first logarithmic stretch"),
    ("q2", "the second logarithmic stretch"),
    ("q3", "the third logarithmic stretch"),
    ("Q1", "the first stretch"),
    ("Q2", "the second stretch"),
    ("Q3", "the third stretch"),
];

impl Spec {
    /// What `name` stands for in this model's coefficients; symbols go before fields.
    pub fn resolve(&self, name: &Ident) -> Option<Symbol<'_>> {
        if name == "n" {
            return Some(Symbol::Dimension);
        }
        self.item.fields.iter().find(|field| field.ident == *name).map(Symbol::Field)
    }

    /// What `name` stands for in this model's potential; symbols go before fields.
    pub fn resolve_in_potential(&self, name: &Ident) -> Option<Symbol<'_>> {
        let text = name.to_string();
        Some(match text.as_str() {
            "q" => Symbol::Dilatation,
            "D" => Symbol::Scale,
            "det" => Symbol::Determinant,
            "t" => Symbol::Time,
            "x" => Symbol::Centre,
            "d" => Symbol::Difference,
            _ => match (MatrixName::named(&text), numbered(&text)) {
                (Some(matrix), _) => Symbol::Matrix(matrix),
                (None, Some(('I', index))) => Symbol::Invariant(index),
                (None, Some(('q' | 'Q', index))) => Symbol::Stretch(index),
                _ => return self.resolve(name),
            },
        })
    }
}

/// A letter and one digit: no dimension has two.
pub(crate) fn numbered(name: &str) -> Option<(char, usize)> {
    match name.chars().collect::<Vec<char>>().as_slice() {
        [letter, digit] => Some((*letter, digit.to_digit(10)? as usize)),
        _ => None,
    }
}
