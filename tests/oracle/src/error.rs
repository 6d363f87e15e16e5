//! Typed errors.

use std::fmt;

/// What keeps a question from having an answer.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// A dimension other than 2 and 3.
    Dimension(usize),
    /// An array or matrix of the wrong shape.
    Shape {
        /// The quantity.
        quantity: &'static str,
        /// Rows and columns it must have.
        expected: (usize, usize),
        /// Rows and columns it has; `(entries, 1)` for a plain array.
        found: (usize, usize),
    },
    /// A number is infinite or not a number, so it is no rational number.
    NotFinite {
        /// The quantity.
        quantity: &'static str,
    },
    /// `det phi = 0`.
    SingularPlacement,
    /// The mass matrix is singular: the kinetic energy has no Legendre transformation.
    SingularMass,
    /// The state has a linear momentum, the kinetic energy no translational term.
    MomentumWithoutTranslation,
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::Dimension(n) => write!(f, "dimension {n}: bodies live in 2 or 3 dimensions"),
            Error::Shape { quantity, expected, found } => {
                write!(f, "{quantity} must be {} x {}, not {} x {}", expected.0, expected.1, found.0, found.1)
            }
            Error::NotFinite { quantity } => write!(f, "{quantity} is not finite"),
            Error::SingularPlacement => write!(f, "det phi = 0: phi has no inverse"),
            Error::SingularMass => {
                write!(f, "the mass matrix is singular: velocities do not follow from momenta")
            }
            Error::MomentumWithoutTranslation => {
                write!(f, "p is not zero, but the kinetic energy has no translational term")
            }
        }
    }
}

impl std::error::Error for Error {}
