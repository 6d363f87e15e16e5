//! Traces: a polynomial in matrices is read as an expression and becomes a sum of traces of products.

mod words;

use proc_macro2::Group;

use self::words::{Letter, Scalars, Words};
use super::Parser;
use crate::algebra::Rational;
use crate::diagnostics::{ExpressionMistake, PotentialMistake, Region, Reported, TracedPart};
use crate::spec::entries::shortened;
use crate::spec::names::Named;
use crate::spec::{Expression, ExpressionKind, MatrixName, Operator, PolynomialTrace, textbook};

/// The highest power of a matrix in a trace: that of a number in a potential.
const LARGEST_POWER: u32 = 16;
/// Products that are longer together are not told apart.
const MOST_FACTORS: usize = 32;
/// The largest degree of a potential.
const LARGEST_DEGREE: u64 = 64;

impl Parser<'_> {
    /// `tr(A)`, the sum of the traces of the products that `A` is a sum of.
    pub(super) fn trace(&mut self, group: &Group, span: Region) -> Result<ExpressionKind, Reported> {
        let before = self.effort.operators;
        let inside = self.argument("tr", group, span)?;
        let written = self.effort.operators - before;
        let mut scalars = Scalars::default();
        let words = self.words(&inside, &mut scalars)?;
        if words.is_long && words.inverts {
            let limit = "64 summands beside an inverse";
            return Err(self.found.report(span, ExpressionMistake::ExpressionSize { limit }));
        }
        let sum = words.trace(&scalars, span);
        if words.is_long || !words.inverts && !words.is_of_invariants() {
            let products = sum.filter(|_| words.factors() <= MOST_FACTORS).map(Box::new);
            let written = Box::new(of_matrices(&inside));
            return Ok(ExpressionKind::PolynomialTrace(PolynomialTrace { written, products }));
        }
        let Some(sum) = sum else {
            return Err(self.refused(&inside, inside.span, TracedPart::Inverse));
        };
        // What the brackets come to counts where it is longer than what was written.
        for _ in written..operators(&sum) {
            self.count(span)?;
        }
        Ok(sum.kind)
    }

    /// A part of a trace as a sum of words.
    fn words(&mut self, part: &Expression, scalars: &mut Scalars) -> Result<Words, Reported> {
        let words = match &part.kind {
            _ if !has_matrix(part) => scalar(part, scalars),
            ExpressionKind::Negate(one) => self.words(one, scalars)?.negated(),
            ExpressionKind::Binary(operator, left, right) => match operator {
                Operator::Power => self.matrix_power(left, right, part, scalars)?,
                Operator::Divide => self.words(left, scalars)?.product(&self.inverse(right, scalars)?),
                Operator::Multiply => self.words(left, scalars)?.product(&self.words(right, scalars)?),
                Operator::Add => self.words(left, scalars)?.sum(self.words(right, scalars)?),
                Operator::Subtract => self.words(left, scalars)?.sum(self.words(right, scalars)?.negated()),
            },
            _ => match matrix(part) {
                Some(matrix) => Words::letter(Letter { matrix, is_inverse: false }),
                None => return Err(self.refused(part, part.span, TracedPart::Function)),
            },
        };
        if words.degree > LARGEST_DEGREE {
            let mistake =
                ExpressionMistake::Degree { degree: words.degree.to_string(), limit: LARGEST_DEGREE };
            return Err(self.found.report(part.span, mistake));
        }
        Ok(words)
    }

    /// A divisor that is a number or another scalar, inverted.
    fn inverse(&mut self, divisor: &Expression, scalars: &mut Scalars) -> Result<Words, Reported> {
        if has_matrix(divisor) {
            return Err(self.refused(divisor, divisor.span, TracedPart::Divisor));
        }
        let one = Expression { kind: ExpressionKind::Number(Rational::ONE), span: divisor.span };
        Ok(scalar(&Operator::Divide.apply(one, divisor.clone()), scalars))
    }

    /// A matrix to a whole power, or its inverse.
    fn matrix_power(
        &mut self,
        base: &Expression,
        exponent: &Expression,
        part: &Expression,
        scalars: &mut Scalars,
    ) -> Result<Words, Reported> {
        let power = whole(exponent).filter(|power| power.unsigned_abs() <= LARGEST_POWER);
        let Some(power) = power else {
            return Err(self.refused(part, exponent.span, TracedPart::Exponent));
        };
        let words = self.words(base, scalars)?;
        match (u32::try_from(power), words.as_letter()) {
            (Ok(power), _) => Ok(words.power(power)),
            (Err(_), Some(Letter { matrix: MatrixName::Placement, .. })) => {
                Err(self.refused(part, part.span, TracedPart::InversePlacement))
            }
            (Err(_), Some(Letter { matrix, is_inverse: false })) if power == -1 => {
                Ok(Words::letter(Letter { matrix, is_inverse: true }))
            }
            _ => Err(self.refused(part, part.span, TracedPart::Inverse)),
        }
    }

    /// `phi^T`, also of a name of textbooks; of no base may an exponent be a name.
    pub(super) fn no_transpose(&mut self, base: &Expression, exponent: &Expression) -> Result<(), Reported> {
        let ExpressionKind::Symbol(name) = &base.kind else { return Ok(()) };
        let is_tensor = matrix(base).is_some() || textbook::quantity(&name.to_string()).is_some();
        match &exponent.kind {
            ExpressionKind::Symbol(t) if t == "T" && is_tensor => {
                let written = format!("{name}^T");
                let mistake = PotentialMistake::Traced { written, part: TracedPart::Transpose };
                Err(self.found.report(exponent.span, mistake))
            }
            _ => Ok(()),
        }
    }

    fn refused(&mut self, part: &Expression, at: Region, kind: TracedPart) -> Reported {
        let written = shortened(&part.to_string());
        self.found.report(at, PotentialMistake::Traced { written, part: kind })
    }
}

/// The matrix that a name stands for.
fn matrix(part: &Expression) -> Option<MatrixName> {
    match &part.kind {
        ExpressionKind::Symbol(name) => MatrixName::named(&name.to_string()),
        _ => None,
    }
}

fn has_matrix(part: &Expression) -> bool {
    matrix(part).is_some() || part.operands().into_iter().any(has_matrix)
}

/// The polynomial with its matrices as such; other names are those of scalars.
fn of_matrices(part: &Expression) -> Expression {
    let of = |part: &Expression| Box::new(of_matrices(part));
    let kind = match (&part.kind, matrix(part)) {
        (_, Some(matrix)) => ExpressionKind::Matrix(matrix),
        (ExpressionKind::Negate(one), _) => ExpressionKind::Negate(of(one)),
        (ExpressionKind::Binary(operator, left, right), _) => {
            ExpressionKind::Binary(*operator, of(left), of(right))
        }
        (other, _) => other.clone(),
    };
    Expression { kind, span: part.span }
}

/// A part without matrices: numbers are merged where they meet, and the rest stands as it is written.
fn scalar(part: &Expression, scalars: &mut Scalars) -> Words {
    let fraction = match &part.kind {
        ExpressionKind::Binary(Operator::Divide, dividend, divisor) => literal(dividend)
            .zip(literal(divisor))
            .and_then(|(dividend, divisor)| dividend.checked_div(&divisor)),
        _ => literal(part),
    };
    fraction.map_or_else(|| scalars.words(part), Words::number)
}

/// A number in digits, with its sign.
fn literal(part: &Expression) -> Option<Rational> {
    match &part.kind {
        ExpressionKind::Number(number) => Some(number.clone()),
        ExpressionKind::Negate(one) => Some(-&literal(one)?),
        _ => None,
    }
}

/// An exponent in digits, with its sign.
fn whole(exponent: &Expression) -> Option<i32> {
    literal(exponent)?.to_i64()?.try_into().ok()
}

/// The operators of an expression, with those between the factors of its traces.
fn operators(part: &Expression) -> usize {
    let own = match &part.kind {
        ExpressionKind::Trace(factors) => factors.len().saturating_sub(1),
        _ if part.operands().is_empty() => 0,
        _ => 1,
    };
    part.operands().into_iter().map(operators).fold(own, usize::saturating_add)
}
