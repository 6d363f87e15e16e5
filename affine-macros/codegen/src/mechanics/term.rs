//! Terms of quadratic forms in velocities.

use crate::algebra::{Expr, Matrix};

pub use crate::symbol::{Frame, Pattern, TermKind};

/// A term of the kinetic energy and its coefficient.
#[derive(Clone, Debug)]
pub struct Term {
    /// The quadratic form that the coefficient multiplies.
    pub kind: TermKind,
    /// Its coefficient or coefficients.
    pub value: Coefficient,
}

/// Coefficient of a term.
#[derive(Clone, Debug)]
pub enum Coefficient {
    /// A number or expression in the model's parameters.
    Scalar(Expr),
    /// A matrix of them, row after row.
    Matrix(Matrix),
}
