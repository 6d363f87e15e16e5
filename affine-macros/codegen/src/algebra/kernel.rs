//! Runtime functions among the quantities of a program: what no straight line of arithmetic computes.

use super::arena::Expr;
use super::polynomial::Polynomial;

/// A call of a runtime function. Its results are symbols, which polynomials use like any other quantity; a call whose
/// results nothing uses is left out.
#[derive(Clone, Debug)]
pub struct Kernel {
    /// The runtime function that is called.
    pub callee: Callee,
    /// What it reads: polynomials in the state, in shared quantities and in results of other calls.
    pub arguments: Vec<Group<Polynomial>>,
    /// The symbols of its results, in groups.
    pub results: Vec<Group<Expr>>,
}

/// The runtime functions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Callee {
    /// Placement -> stretches and principal axes.
    Stretches,
    /// The same with log-stretches, counted from the undeformed state.
    LogStretches,
    /// `x, s -> (exp(x s) - 1)/s, (exp(-x s) - 1)/s`.
    Elongation,
    /// `x, k -> sinh(x sqrt k)/sqrt k, (cosh(x sqrt k) - 1)/k`.
    Turn,
    /// `h, A, z -> (exp(-h A) - 1) z`.
    Fading,
    /// `phi -> R_F(Q_1^2, Q_2^2, Q_3^2)`, Carlson's integral of the squared stretches.
    Ellipsoidal,
    /// Its derivatives by the entries of `phi`.
    EllipsoidalSlopes,
    /// The field `custom_k` of the model, `k` from 1, asked for a force or a potential.
    Custom(usize, Asked),
}

/// What a field of the model is asked for, with what was said of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Asked {
    /// `Q`, or `Q_hat`, or `Q_tr`: the name of the runtime function; and whether it has no power.
    Force(&'static str, bool),
    /// `U`; the class as a number, and whether it depends on `x`.
    Energy(u8, bool),
    /// `dU/dx` and `dU/dphi`; likewise.
    Slopes(u8, bool),
}

/// Numbers that travel together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Group<E> {
    /// One number.
    Scalar(E),
    /// An array.
    Vector(Vec<E>),
    /// An array of rows.
    Matrix(Vec<Vec<E>>),
}

impl<E> Group<E> {
    /// All numbers, row after row.
    pub fn entries(&self) -> Vec<&E> {
        match self {
            Self::Scalar(one) => vec![one],
            Self::Vector(list) => list.iter().collect(),
            Self::Matrix(rows) => rows.iter().flatten().collect(),
        }
    }

    /// The same shape with other entries.
    pub fn map<F>(&self, mut value: impl FnMut(&E) -> F) -> Group<F> {
        match self {
            Self::Scalar(one) => Group::Scalar(value(one)),
            Self::Vector(list) => Group::Vector(list.iter().map(value).collect()),
            Self::Matrix(rows) => {
                Group::Matrix(rows.iter().map(|row| row.iter().map(&mut value).collect()).collect())
            }
        }
    }
}

impl Kernel {
    /// Its results, one symbol after the other.
    pub fn outputs(&self) -> impl Iterator<Item = Expr> {
        self.results.iter().flat_map(Group::entries).copied()
    }

    /// Its arguments, one polynomial after the other.
    pub fn inputs(&self) -> impl Iterator<Item = &Polynomial> {
        self.arguments.iter().flat_map(Group::entries)
    }

    /// The same call with other arguments.
    pub fn with_arguments(&self, mut value: impl FnMut(&Polynomial) -> Polynomial) -> Self {
        let arguments = self.arguments.iter().map(|group| group.map(&mut value)).collect();
        Self { callee: self.callee, arguments, results: self.results.clone() }
    }
}
