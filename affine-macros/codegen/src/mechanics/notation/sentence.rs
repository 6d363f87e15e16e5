//! Formulas of matrices as trees. Two printers write a tree, as text and in LaTeX.

use super::letter::Letter;
use super::letters;
use super::matrix_name::MatrixName;
use crate::algebra::arena::Node;
use crate::algebra::text::sign;
use crate::algebra::{Arena, Expr, Rational};

/// A formula.
#[derive(Clone, Debug, PartialEq, Eq)]
#[must_use]
pub enum Sentence {
    /// Nothing but a number, or an expression in symbols of the mechanics and fields.
    Scalar(Expr),
    /// The number 1, or the identity.
    One,
    /// A symbol that formulas name as a whole.
    Letter(Letter),
    /// What a field gives: `Q[f]`, with the name of the field as text and in LaTeX.
    OfField(Letter, [String; 2]),
    /// A component of a force: `N_12`.
    Component(Letter, String),
    /// A matrix of coefficients by its name.
    Matrix(MatrixName),
    /// A matrix by its rows.
    Rows(Vec<Vec<Sentence>>),
    /// A matrix by its diagonal.
    Diagonal(Vec<Sentence>),
    /// An entry by the letters of its indices, of a matrix of pairs of indices by those of two pairs.
    Entry(Box<Sentence>, &'static [[char; 2]]),
    /// A sum, with the summands that are subtracted.
    Sum(Vec<Summand>),
    /// Factors side by side.
    Product(Vec<Sentence>),
    /// A number times something.
    Multiple(Expr, Box<Sentence>),
    /// Something over a whole number.
    Over(Box<Sentence>, usize),
    /// Something over the dimension.
    OverDimension(Box<Sentence>),
    /// A transpose, an inverse or a power.
    Raised(Box<Sentence>, Exponent),
    /// The trace.
    Trace(Box<Sentence>),
    /// The length of a vector.
    Length(Box<Sentence>),
    /// The norm of a matrix.
    Norm(Letter),
    /// `[a, b]`.
    Commutator(Box<[Sentence; 2]>),
    /// The derivative with respect to time.
    Rate(Box<Sentence>),
    /// The derivative with respect to time of all that follows.
    RateOfAll(Box<Sentence>),
    /// The derivative of one by the other.
    Slope(Box<[Sentence; 2]>),
    /// The derivative of a potential with respect to time, with the body at rest.
    SlopeAtRest(Letter),
    /// A function or an operator on arguments in brackets.
    Applied(Letter, Vec<Sentence>),
    /// The inner product of two vectors.
    Inner(Box<[Sentence; 2]>),
    /// One is the other.
    Equation(Box<[Sentence; 2]>),
    /// An equation that is solved for something.
    Solved(Box<Sentence>, Box<Sentence>),
    /// What a matrix is in bases that the user gave.
    InGivenBases(Box<Sentence>),
    /// Sentences one after the other.
    Several(Vec<Sentence>),
}

/// A summand, with its sign apart.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Summand {
    /// Is it subtracted?
    pub negative: bool,
    /// What is added or subtracted.
    pub value: Sentence,
}

/// What stands raised.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exponent {
    /// `^T`.
    Transpose,
    /// `^-1`.
    Inverse,
    /// `^2` and higher.
    Power(usize),
}

impl From<Letter> for Sentence {
    fn from(letter: Letter) -> Self {
        Self::Letter(letter)
    }
}

/// Factors side by side.
pub(in crate::mechanics) fn product<const N: usize>(factors: [Sentence; N]) -> Sentence {
    Sentence::Product(factors.into())
}

/// `phi`.
pub(in crate::mechanics) fn placement() -> Sentence {
    letters::PLACEMENT.into()
}

/// `[a, b]`.
pub(in crate::mechanics) fn commutator(a: impl Into<Sentence>, b: impl Into<Sentence>) -> Sentence {
    Sentence::Commutator(Box::new([a.into(), b.into()]))
}

/// The derivative of one by the other.
pub(in crate::mechanics) fn slope(of: impl Into<Sentence>, by: impl Into<Sentence>) -> Sentence {
    Sentence::Slope(Box::new([of.into(), by.into()]))
}

/// The derivative with respect to time.
pub(in crate::mechanics) fn rate(of: impl Into<Sentence>) -> Sentence {
    Sentence::Rate(Box::new(of.into()))
}

/// The trace.
pub(in crate::mechanics) fn trace(of: impl Into<Sentence>) -> Sentence {
    Sentence::Trace(Box::new(of.into()))
}

/// `of/2`, as it is written.
pub(in crate::mechanics) fn half(arena: &mut Arena, of: Sentence) -> Sentence {
    Sentence::Multiple(arena.constant(Rational::HALF), Box::new(of))
}

impl Sentence {
    fn raised(self, exponent: Exponent) -> Self {
        Self::Raised(Box::new(self), exponent)
    }

    /// The transpose.
    pub(in crate::mechanics) fn transposed(self) -> Self {
        self.raised(Exponent::Transpose)
    }

    /// The inverse.
    pub(in crate::mechanics) fn inverse(self) -> Self {
        self.raised(Exponent::Inverse)
    }

    /// A power.
    pub(in crate::mechanics) fn power(self, exponent: usize) -> Self {
        self.raised(Exponent::Power(exponent))
    }

    /// The square of the length of a vector.
    pub(in crate::mechanics) fn length_squared(self) -> Self {
        Self::Length(Box::new(self)).power(2)
    }

    /// An entry by the letters of its indices.
    pub(in crate::mechanics) fn entry(self, indices: &'static [[char; 2]]) -> Self {
        Self::Entry(Box::new(self), indices)
    }

    /// `left = self`.
    pub(in crate::mechanics) fn of(self, left: impl Into<Sentence>) -> Self {
        Self::Equation(Box::new([left.into(), self]))
    }

    /// With definitions of what it names.
    pub(in crate::mechanics) fn with(self, definitions: Vec<Sentence>) -> Self {
        if definitions.is_empty() {
            return self;
        }
        let mut all = match self {
            Self::Several(sentences) => sentences,
            one => vec![one],
        };
        all.extend(definitions);
        Self::Several(all)
    }

    /// Does it take brackets among factors?
    pub(super) fn is_sum(&self) -> bool {
        matches!(self, Self::Sum(_))
    }

    /// Does it take brackets where something is raised?
    pub(super) fn is_composed(&self) -> bool {
        matches!(self, Self::Sum(_) | Self::Product(_) | Self::Multiple(..) | Self::Slope(_) | Self::Trace(_))
    }

    /// Is it a sum or a product, so that a function of it takes brackets?
    pub(super) fn is_several(&self) -> bool {
        matches!(self, Self::Sum(_) | Self::Product(_))
    }
}

impl Summand {
    /// What is added.
    pub(in crate::mechanics) fn plus(value: impl Into<Sentence>) -> Self {
        Self { negative: false, value: value.into() }
    }

    /// What is subtracted.
    pub(in crate::mechanics) fn minus(value: impl Into<Sentence>) -> Self {
        Self { negative: true, value: value.into() }
    }
}

/// A sum whose summands are `written` so.
pub(super) fn summed(summands: &[Summand], written: impl Fn(&Sentence) -> String) -> String {
    if summands.is_empty() {
        return "0".to_owned();
    }
    let mut sum = String::new();
    for Summand { negative, value } in summands {
        sum.push_str(sign(*negative, sum.is_empty()));
        sum.push_str(&written(value));
    }
    sum
}

/// Does a coefficient take brackets among factors?
pub(super) fn is_sum(arena: &Arena, coefficient: Expr) -> bool {
    matches!(arena.node(coefficient), Node::Sum(constant, terms) if terms.len() > 1 || !constant.is_zero())
}
