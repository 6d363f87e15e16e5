//! Mistakes in single terms of the energy, and in their coefficients.

use super::message::{Text, equated, text};
use super::names::names;

/// A mistake in a term of the energy.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TermMistake {
    /// A scalar where a matrix is due, or the other way round.
    TermShape {
        /// The term.
        term: &'static str,
        /// The shape of the value that is written.
        found: &'static str,
        /// What the term takes.
        takes: String,
        /// What to write.
        instead: String,
    },
    /// A matrix of the wrong size.
    MatrixSize {
        /// The term.
        term: &'static str,
        /// What is counted: `rows`, `entries in row 2`, `diagonal entries`.
        counted: String,
        /// How many there are.
        found: usize,
        /// How many are due.
        expected: usize,
        /// Where that number comes from: `n^2 = 9`.
        because: String,
    },
    /// `K[(A,B),(C,D)] != K[(C,D),(A,B)]`.
    TensorNotSymmetric {
        /// The term.
        term: &'static str,
        /// The first bi-index, 1-based: `(1,2)`.
        first: String,
        /// The second bi-index.
        second: String,
        /// The value at (first, second).
        value: String,
        /// The value at (second, first).
        transposed: String,
    },
    /// `J[A,B] != J[B,A]`.
    InertiaNotSymmetric {
        /// The term.
        term: &'static str,
        /// The row, 1-based.
        row: usize,
        /// The column, 1-based.
        column: usize,
        /// The value at (row, column).
        value: String,
        /// The value at (column, row).
        transposed: String,
    },
    /// `J` is not positive definite.
    InertiaNotPositive {
        /// The term.
        term: &'static str,
        /// What shows it: `its leading 2 x 2 minor is -3`.
        defect: String,
    },
    /// A translation coefficient that is exactly zero.
    ZeroMass {
        /// The term.
        term: &'static str,
        /// The coefficient as written.
        coefficient: String,
    },
    /// A negative mass beside a d'Alembert energy.
    NegativeMass {
        /// The translation term.
        term: &'static str,
        /// The coefficient as written.
        coefficient: String,
        /// Its value.
        value: String,
    },
    /// An inverse mass that is exactly zero.
    ZeroInverseMass {
        /// The translation term of `hamiltonian(...)`.
        term: &'static str,
        /// The coefficient as written.
        coefficient: String,
    },
    /// `casimir3` for n = 2.
    PlanarCasimir3,
}

names! { TermMistake
    TermShape => "term-shape",
    MatrixSize => "matrix-size",
    TensorNotSymmetric => "tensor-not-symmetric",
    InertiaNotSymmetric => "inertia-not-symmetric",
    InertiaNotPositive => "inertia-not-positive",
    ZeroMass => "zero-mass",
    NegativeMass => "negative-mass",
    ZeroInverseMass => "zero-inverse-mass",
    PlanarCasimir3 => "planar-casimir3",
}

impl TermMistake {
    pub(super) fn text(&self) -> Text {
        match self {
            Self::TermShape { term, found, takes, instead } => {
                text(format!("`{term}` is given {found}"), format!("`{term}` takes {takes}"), instead.clone())
            }
            Self::MatrixSize { term, counted, found, expected, because } => text(
                format!("the matrix of `{term}` has {found} {counted}, not {expected}"),
                format!("its size follows from the dimension: {because}"),
                format!("write {expected} {counted}"),
            ),
            Self::TensorNotSymmetric { term, first, second, value, transposed } => text(
                format!(
                    "`{term}` is not symmetric: K[{first},{second}] = {value}, K[{second},{first}] = {transposed}"
                ),
                "in 1/2 K[(A,B),(C,D)] O[A,B] O[C,D] (4.1), (4.2) only the part symmetric under exchange of the \
                 pairs (A,B), (C,D) counts; row (A,B) is row n(A-1)+B, columns likewise",
                "write the same entry in both places; their mean gives the same energy",
            ),
            Self::InertiaNotSymmetric { term, row, column, value, transposed } => text(
                format!(
                    "the inertia of `{term}` is not symmetric: J[{row},{column}] = {value}, \
                     J[{column},{row}] = {transposed}"
                ),
                "T sees only the symmetric part of J (4.17), the integral of a a^T over the masses in (2.1)",
                "write the same entry in both places; their mean gives the same energy",
            ),
            Self::InertiaNotPositive { term, defect } => text(
                format!("the inertia of `{term}` is not positive definite: {defect}"),
                "J is the quadratic moment of positive masses, and H needs its inverse: \
                 Pi = J phi_dot^T (2.2)",
                "write a symmetric J whose leading minors are all positive; indefinite energies are stated with \
                 `casimir2`, `casimir1_squared`, `body_inertia`, `space_inertia`",
            ),
            Self::ZeroMass { term, coefficient } => text(
                format!("`{term} = {coefficient}` is zero"),
                "the momentum is the mass times the velocity (4.6), (4.8) and does not determine it",
                format!("write a mass that is not zero, or remove `{term}`: the body is then fixed in space"),
            ),
            Self::NegativeMass { term, coefficient, value } => text(
                format!("`{term} = {}` is negative", equated(coefficient, value)),
                "`dalembert` is the kinetic energy of positive masses (2.1), and these are the same masses",
                "write a positive mass",
            ),
            Self::ZeroInverseMass { term, coefficient } => text(
                format!("`{term} = {coefficient}` is zero"),
                "in `hamiltonian(...)` it is the inverse mass, the velocity is that times the momentum, and does not \
                 determine it",
                format!("write `{term} = 1/m`, or remove `{term}`: the body is then fixed in space"),
            ),
            Self::PlanarCasimir3 => text(
                "`casimir3` is for `dim = 3`",
                "for n = 2, tr X^3 = (3 tr X tr X^2 - (tr X)^3)/2 (Cayley and Hamilton) is no invariant of its own",
                "remove `casimir3`, or write `dim = 3`",
            ),
        }
    }
}
