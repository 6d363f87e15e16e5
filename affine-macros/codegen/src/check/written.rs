//! Quadratic forms in the user's own numbers, for messages.

use std::collections::BTreeMap;

use crate::algebra::Rational;
use crate::diagnostics::{ConstraintMistake, Directions};
use crate::mechanics::direction::Direction;
use crate::spec::{self, Named, Value};
use crate::symbol::{Constraint, Frame};

/// The internal terms of a quadratic form as the user wrote them.
pub(super) struct Written<'a> {
    pub(super) n: usize,
    pub(super) terms: Vec<&'a spec::Term>,
}

/// Eigenvalues of the isotropic form and the velocities they belong to.
pub(super) fn eigenvalue_name(kind: Direction) -> (&'static str, Directions) {
    match kind {
        Direction::Rotation => ("I - A", Directions::Skew),
        Direction::Dilatation => ("I + A + n B", Directions::Trace),
        Direction::Shear | Direction::Entry => ("I + A", Directions::SymmetricTraceless),
    }
}

/// The velocity of a frame.
pub(super) fn velocity_name(frame: Frame) -> &'static str {
    match frame {
        Frame::Body => "Oh",
        Frame::Space => "Om",
        Frame::Flat => "phi_dot",
    }
}

/// A coefficient as a factor.
pub(super) fn bracketed(text: String) -> String {
    let simple = text.chars().all(|c| c.is_alphanumeric() || c == '.' || c == '_');
    if simple { text } else { format!("({text})") }
}

/// That a term is zero on all velocities, or momenta, that a constraint leaves.
pub(super) fn vanishing_term(
    term: &'static str,
    constraint: Constraint,
    of: &'static str,
) -> ConstraintMistake {
    let directions = constraint.velocities();
    ConstraintMistake::VanishingTerm { term, constraint: constraint.name(), of, directions }
}

impl Written<'_> {
    /// Are all of them multiples of the three rotation-invariant squares?
    pub(super) fn only_isotropic(&self) -> bool {
        self.terms.iter().all(|t| matches!(t.value, Value::Scalar(_)))
    }

    /// The value of a scalar coefficient.
    pub(super) fn scalar(&self, term: &spec::Term) -> Option<Rational> {
        match &term.value {
            Value::Scalar(e) => crate::lower::constant(e, self.n),
            _ => None,
        }
    }

    /// An eigenvalue with the user's coefficients in it: `1 + 0.2 + 3*(-0.4)`.
    pub(super) fn eigenvalue_in_numbers(&self, kind: Direction) -> String {
        let written: BTreeMap<&str, String> = self
            .terms
            .iter()
            .filter_map(|t| match &t.value {
                Value::Scalar(e) => Some((t.kind.value.name(), e.to_string())),
                _ => None,
            })
            .collect();
        let get = |names: &[&str]| {
            names.iter().find_map(|name| written.get(name)).cloned().unwrap_or_else(|| "0".to_owned())
        };
        let i = get(&["body_inertia", "space_inertia", "dalembert"]);
        let a = bracketed(get(&["casimir2"]));
        let b = bracketed(get(&["casimir1_squared"]));
        match kind {
            Direction::Rotation => format!("{i} - {a}"),
            Direction::Dilatation => format!("{i} + {a} + {}*{b}", self.n),
            Direction::Shear | Direction::Entry => format!("{i} + {a}"),
        }
    }
}

/// An affine velocity as a nested matrix.
pub(super) fn matrix_text(n: usize, entries: &[Rational]) -> String {
    let rows: Vec<String> = entries
        .chunks(n)
        .map(|row| format!("[{}]", row.iter().map(Rational::to_string).collect::<Vec<_>>().join(", ")))
        .collect();
    format!("[{}]", rows.join(", "))
}
