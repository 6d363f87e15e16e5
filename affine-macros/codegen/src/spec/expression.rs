//! Expressions as written: a tree with places, no simplification.

use std::fmt;

use proc_macro2::Ident;

use super::names::{Named, named, set_of_names};
use crate::algebra::{Function, Rational};
use crate::diagnostics::Region;

/// An expression; `Display` writes it with the fewest parentheses, and reading that gives it back.
#[derive(Clone, Debug)]
pub struct Expression {
    /// The outermost form, with its operands.
    pub kind: ExpressionKind,
    /// The place of the whole expression in the source.
    pub span: Region,
}

/// The forms of an expression. Coefficients of the kinetic energy are made of the arithmetic forms, down to
/// [`ExpressionKind::Binary`]; only a potential has the others. Indices are those of the paper, from 1.
#[derive(Clone, Debug)]
pub enum ExpressionKind {
    /// A decimal literal, exactly.
    Number(Rational),
    /// A field or a symbol.
    Symbol(Ident),
    /// `j[1,2]`: row and column of a field of matrix type, made from the name of the field alone.
    FieldEntry(Ident, usize, usize),
    /// `-a`.
    Negate(Box<Expression>),
    /// `a + b`, `a ^ b` and the like.
    Binary(Operator, Box<Expression>, Box<Expression>),
    /// `exp(a)`.
    Call(Function, Box<Expression>),
    /// `tr(G*Ct)`: the trace of a product, factor by factor.
    Trace(Vec<MatrixName>),
    /// `tr((G + Ct)^4)`: the trace of a polynomial in matrices.
    PolynomialTrace(PolynomialTrace),
    /// `G` in such a polynomial.
    Matrix(MatrixName),
    /// `tr(G^-1) = tr(Ct^-1) = e_(n-1)/e_n`, in the invariants of `G`.
    InverseTrace(MatrixName),
    /// `G[1,2]`: row and column.
    Entry(MatrixName, usize, usize),
    /// `x[3]`: a coordinate of the centre.
    Component(usize),
    /// `norm(x) = sqrt(x . x)`.
    Norm,
    /// `pairs(f(d))`: the sum of f(q_a - q_b) over a < b; inside, `d` stands for the difference.
    Pairs(Box<Expression>),
}

/// The trace of a polynomial in matrices.
#[derive(Clone, Debug)]
pub struct PolynomialTrace {
    /// The polynomial as it is written, with [`ExpressionKind::Matrix`] for its matrices.
    pub written: Box<Expression>,
    /// The sum of the traces of its products, where these are few.
    pub products: Option<Box<Expression>>,
}

impl PolynomialTrace {
    /// Its matrices, as often as they stand there.
    pub fn matrices(&self) -> Vec<MatrixName> {
        matrices(&self.written)
    }

    /// The number of its factors, and of what its [powers](more_factors) are worth beyond their bases.
    pub fn factors(&self) -> usize {
        factors(&self.written)
    }
}

/// What a power of a matrix is worth in factors beyond those of its base: one factor for each further one where these are few,
/// two for each squaring otherwise, since the slope is a power as well.
pub fn more_factors(exponent: usize) -> usize {
    let beyond = exponent.saturating_sub(1);
    let squarings = (usize::BITS - beyond.leading_zeros()) as usize;
    beyond.min(2 * squarings)
}

/// The matrices of a part; those of traces within it are counted there.
fn matrices(part: &Expression) -> Vec<MatrixName> {
    match &part.kind {
        ExpressionKind::Matrix(matrix) => vec![*matrix],
        ExpressionKind::PolynomialTrace(_) => Vec::new(),
        _ => part.operands().into_iter().flat_map(matrices).collect(),
    }
}

/// The same of the factors of a part.
fn factors(part: &Expression) -> usize {
    let within: usize = match &part.kind {
        ExpressionKind::Matrix(_) => return 1,
        ExpressionKind::PolynomialTrace(_) => return 0,
        _ => part.operands().into_iter().map(factors).sum(),
    };
    let power = match &part.kind {
        ExpressionKind::Binary(Operator::Power, _, exponent) if within > 0 => match &exponent.kind {
            ExpressionKind::Number(power) => power.to_i64().and_then(|k| usize::try_from(k).ok()),
            _ => None,
        },
        _ => None,
    };
    within + power.map_or(0, more_factors)
}

set_of_names! {
    /// The n x n matrices of a potential.
    pub enum MatrixName {
        /// `G = phi^T phi`, the Green deformation tensor.
        Green = "G",
        /// `Ct = phi phi^T`, the inverse of the Cauchy deformation tensor (Finger tensor).
        Finger = "Ct",
        /// `phi`, the placement.
        Placement = "phi",
    }
}

/// The binary operators.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operator {
    /// `+`
    Add,
    /// `-`
    Subtract,
    /// `*`
    Multiply,
    /// `/`
    Divide,
    /// `^`
    Power,
}

impl Operator {
    /// Applies the operator; the place spans both operands.
    pub fn apply(self, left: Expression, right: Expression) -> Expression {
        let span = left.span.to(right.span);
        Expression { kind: ExpressionKind::Binary(self, Box::new(left), Box::new(right)), span }
    }

    /// How it is written, how tightly it binds, and how tightly its operands have to. An exponent takes a sign and further
    /// powers without parentheses: `2^-1`, `2^3^2 = 2^(3^2)`.
    fn notation(self) -> (&'static str, Binding, [Binding; 2]) {
        match self {
            Self::Add => (" + ", Binding::Sum, [Binding::Sum, Binding::Product]),
            Self::Subtract => (" - ", Binding::Sum, [Binding::Sum, Binding::Product]),
            Self::Multiply => ("*", Binding::Product, [Binding::Product, Binding::Sign]),
            Self::Divide => ("/", Binding::Product, [Binding::Product, Binding::Sign]),
            Self::Power => ("^", Binding::Power, [Binding::Atom, Binding::Sign]),
        }
    }
}

/// How tightly a form binds; an operand that binds less tightly than its place asks gets parentheses.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    Product,
    Sign,
    Power,
    Atom,
}

impl Expression {
    /// The operands of the outermost form.
    pub fn operands(&self) -> Vec<&Expression> {
        match &self.kind {
            ExpressionKind::PolynomialTrace(trace) => vec![&trace.written],
            ExpressionKind::Negate(one) | ExpressionKind::Call(_, one) | ExpressionKind::Pairs(one) => {
                vec![one]
            }
            ExpressionKind::Binary(_, left, right) => vec![left, right],
            _ => Vec::new(),
        }
    }

    fn binding(&self) -> Binding {
        match self.kind {
            ExpressionKind::Negate(_) => Binding::Sign,
            ExpressionKind::Binary(operator, ..) => operator.notation().1,
            // Names, numbers, and what has brackets of its own.
            _ => Binding::Atom,
        }
    }

    fn write(&self, at_least: Binding, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.binding() < at_least {
            return write!(f, "({self})");
        }
        match &self.kind {
            ExpressionKind::Number(value) => f.write_str(&decimal(value)),
            ExpressionKind::Symbol(name) => write!(f, "{name}"),
            ExpressionKind::FieldEntry(field, row, column) => write!(f, "{field}[{row},{column}]"),
            ExpressionKind::Negate(one) => {
                f.write_str("-")?;
                one.write(Binding::Sign, f)
            }
            ExpressionKind::Binary(operator, left, right) => {
                let (sign, _, [before, behind]) = operator.notation();
                left.write(before, f)?;
                f.write_str(sign)?;
                right.write(behind, f)
            }
            ExpressionKind::Call(function, one) => write!(f, "{}({one})", function.name()),
            ExpressionKind::Trace(factors) => {
                let names: Vec<&str> = factors.iter().map(|factor| factor.name()).collect();
                write!(f, "tr({})", names.join("*"))
            }
            ExpressionKind::PolynomialTrace(trace) => write!(f, "tr({})", trace.written),
            ExpressionKind::Matrix(matrix) => f.write_str(matrix.name()),
            ExpressionKind::InverseTrace(matrix) => write!(f, "tr({}^-1)", matrix.name()),
            ExpressionKind::Entry(matrix, row, column) => write!(f, "{}[{row},{column}]", matrix.name()),
            ExpressionKind::Component(index) => write!(f, "x[{index}]"),
            ExpressionKind::Norm => f.write_str("norm(x)"),
            ExpressionKind::Pairs(one) => write!(f, "pairs({one})"),
        }
    }
}

impl fmt::Display for Expression {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.write(Binding::Sum, f)
    }
}

/// A number as a decimal literal, as the user would write it. Only a number that no literal denotes comes out
/// as a fraction, in parentheses.
fn decimal(value: &Rational) -> String {
    // Literals reach down to 1e-308 with a few hundred digits at most.
    const LONGEST: usize = 700;
    // Beyond this a reader counts zeros: an exponent is clearer.
    const ZEROS: usize = 12;
    if value.is_negative() {
        return format!("(-{})", decimal(&-value));
    }
    let ten = Rational::from(10);
    let mut scaled = value.clone();
    let mut places = 0;
    while !scaled.is_integer() {
        if places == LONGEST {
            return format!("({value})");
        }
        scaled = &scaled * &ten;
        places += 1;
    }
    let digits = scaled.to_string();
    if places == 0 {
        let kept = digits.trim_end_matches('0').len().max(1);
        let zeros = digits.len() - kept;
        return if zeros > ZEROS { format!("{}e{zeros}", &digits[..kept]) } else { digits };
    }
    if places > digits.len() + ZEROS {
        return format!("{digits}e-{places}");
    }
    let padded = format!("{digits:0>width$}", width = places + 1);
    let (whole, fraction) = padded.split_at(padded.len() - places);
    format!("{whole}.{fraction}")
}
