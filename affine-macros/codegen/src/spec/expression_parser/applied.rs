//! Names with brackets after them: functions, traces, entries and named potentials.

use proc_macro2::{Delimiter, Group, Ident, Span, TokenStream, TokenTree};

use super::{Language, Parser};
use crate::algebra::fault::never_missing;
use crate::algebra::{Function, Rational};
use crate::diagnostics::{ExpressionMistake, PotentialMistake, Region, Reported};
use crate::spec::custom::{self, SELF_GRAVITY};
use crate::spec::entries::{Piece, describe, pieces, placed, shortened, unwrapped};
use crate::spec::named_potentials::{NAMED_POTENTIALS, NamedPotential};
use crate::spec::names::{Named, nearest};
use crate::spec::textbook;
use crate::spec::{Expression, ExpressionKind, MatrixName, Operator};

/// The functions of a potential. `cbrt` is not among them: a power with an exponent of 1/3 is stated through
/// its logarithm, which shows that the base must be positive.
pub(super) const FUNCTIONS: [Function; 10] = [
    Function::Exp,
    Function::Ln,
    Function::Sqrt,
    Function::Abs,
    Function::Sin,
    Function::Cos,
    Function::Tan,
    Function::Sinh,
    Function::Cosh,
    Function::Tanh,
];

/// Functions that stand for an expression in others.
const PHRASES: [&str; 3] = ["log", "log1p", "expm1"];

/// The forms that are applied like functions.
const FORMS: [&str; 3] = ["tr", "norm", "pairs"];

impl Parser<'_> {
    /// `name(...)` or `name[...]`.
    pub(super) fn applied(&mut self, name: &Ident, group: &Group) -> Result<Expression, Reported> {
        let span = Region { start: name.span(), end: group.span_close() };
        let text = name.to_string();
        if group.delimiter() == Delimiter::Bracket {
            let kind = self.indexed(&text, name.span(), group, span)?;
            return Ok(Expression { kind, span });
        }
        if let Some(potential) = NAMED_POTENTIALS.iter().find(|potential| potential.name == text) {
            let kind = self.named_potential(potential, name.span(), group, span)?.kind;
            return Ok(Expression { kind, span });
        }
        let kind = match text.as_str() {
            "tr" => self.trace(group, span)?,
            "norm" => self.norm(group)?,
            "log" => call(Function::Ln, self.argument("log", group, span)?),
            "log1p" => {
                let argument = self.argument("log1p", group, span)?;
                call(Function::Ln, Operator::Add.apply(one(argument.span), argument))
            }
            "expm1" => {
                let argument = self.argument("expm1", group, span)?;
                let exponential = Expression { span: argument.span, kind: call(Function::Exp, argument) };
                Operator::Subtract.apply(exponential, one(span)).kind
            }
            "pairs" => ExpressionKind::Pairs(Box::new(self.argument("pairs", group, span)?)),
            "custom" => {
                let mistake = custom::within_an_expression();
                return Err(self.found.report(name.span(), mistake));
            }
            SELF_GRAVITY => {
                let mistake = PotentialMistake::SummandByItself { name: SELF_GRAVITY };
                return Err(self.found.report(name.span(), mistake));
            }
            _ => match FUNCTIONS.into_iter().find(|function| function.name() == text) {
                Some(function) => call(function, self.argument(function.name(), group, span)?),
                None => return Err(self.found.report(name.span(), unknown(&text))),
            },
        };
        Ok(Expression { kind, span })
    }

    /// The only argument of a function.
    pub(super) fn argument(
        &mut self,
        name: &'static str,
        group: &Group,
        span: Region,
    ) -> Result<Expression, Reported> {
        let parameters = match name {
            "pairs" => &["f(d)"],
            "tr" => &["G"],
            _ => &["a"],
        };
        let mut arguments = self.arguments(name, parameters, group, span)?;
        // There are as many arguments as parameters.
        arguments.pop().ok_or_else(|| self.found.report(span, ExpressionMistake::MissingOperand))
    }

    /// As many arguments as there are parameters.
    fn arguments(
        &mut self,
        name: &'static str,
        parameters: &'static [&'static str],
        group: &Group,
        span: Region,
    ) -> Result<Vec<Expression>, Reported> {
        let pieces = pieces(group.stream(), group.span_close());
        if pieces.len() != parameters.len() {
            let mistake = PotentialMistake::ArgumentCount { name, parameters, found: pieces.len() };
            return Err(self.found.report(span, mistake));
        }
        // All arguments before the first error is looked for, so that all are reported.
        let language = self.language;
        let read: Vec<_> =
            pieces.into_iter().map(|Piece { tokens, at }| self.inner(tokens, at, language)).collect();
        read.into_iter().collect()
    }

    /// The formula of a named potential, with the arguments for its parameters. Its tokens get the place of the
    /// name, where a mistake in what it comes to is shown.
    fn named_potential(
        &mut self,
        potential: &NamedPotential,
        name: Span,
        group: &Group,
        span: Region,
    ) -> Result<Expression, Reported> {
        let arguments = self.arguments(potential.name, potential.parameters, group, span)?;
        let bound: Vec<_> = potential.parameters.iter().copied().zip(arguments).collect();
        let formula = potential.formula.parse().ok();
        let formula = never_missing(formula, "a named potential is a formula", TokenStream::new());
        self.inner(placed(formula, name).into_iter().collect(), span, Language::Potential(&bound))
    }

    /// `norm(x)`.
    fn norm(&mut self, group: &Group) -> Result<ExpressionKind, Reported> {
        match unwrapped(group.stream().into_iter().collect()).as_slice() {
            [TokenTree::Ident(name)] if name == "x" => Ok(ExpressionKind::Norm),
            _ => {
                let found = shortened(&group.stream().to_string());
                let at = Region { start: group.span_open(), end: group.span_close() };
                Err(self.found.report(at, PotentialMistake::Argument { found }))
            }
        }
    }

    /// `G[1,2]`, `x[3]`.
    fn indexed(
        &mut self,
        name: &str,
        at: Span,
        group: &Group,
        span: Region,
    ) -> Result<ExpressionKind, Reported> {
        let indices: Option<Vec<usize>> =
            pieces(group.stream(), group.span_close()).into_iter().map(index).collect();
        match (MatrixName::named(name), name, indices.as_deref()) {
            (Some(matrix), _, Some(&[row, column])) => Ok(ExpressionKind::Entry(matrix, row, column)),
            (None, "x", Some(&[index])) => Ok(ExpressionKind::Component(index)),
            (Some(_), ..) | (None, "x", _) => {
                let written = shortened(&format!("{name}[{}]", group.stream()));
                let (indices, example) = match MatrixName::named(name) {
                    Some(matrix) => ("a row and a column", format!("{}[1,2]", matrix.name())),
                    None => ("one index", "x[1]".to_owned()),
                };
                Err(self.found.report(span, PotentialMistake::Indices { written, indices, example }))
            }
            _ => {
                let is_function = application(name).is_some();
                let familiar = textbook::quantity(name)
                    .or(is_function.then_some("write round brackets, as in `tr(G)` or `ln(a)`"));
                Err(self.found.report(at, PotentialMistake::NotIndexed { name: shortened(name), familiar }))
            }
        }
    }
}

fn call(function: Function, argument: Expression) -> ExpressionKind {
    ExpressionKind::Call(function, Box::new(argument))
}

fn one(span: Region) -> Expression {
    Expression { kind: ExpressionKind::Number(Rational::ONE), span }
}

/// A whole number without sign.
fn index(piece: Piece) -> Option<usize> {
    match unwrapped(piece.tokens).as_slice() {
        [one @ TokenTree::Literal(_)] => describe(one).trim_matches('`').parse().ok(),
        _ => None,
    }
}

/// How a name is applied, if it is that of a function or of a potential: `neo_hookean(c)`, `sinh(a)`.
pub(crate) fn application(name: &str) -> Option<String> {
    let potential = NAMED_POTENTIALS.iter().find(|potential| potential.name == name);
    let is_function = PHRASES.contains(&name) || FUNCTIONS.iter().any(|function| function.name() == name);
    potential
        .map(|potential| format!("{name}({})", potential.parameters.join(", ")))
        .or_else(|| is_function.then(|| format!("{name}(a)")))
        .or_else(|| (name == "tr").then(|| "tr(G)".to_owned()))
        .or_else(|| (name == SELF_GRAVITY).then(|| format!("{name}(k)")))
}

fn unknown(name: &str) -> PotentialMistake {
    let known: Vec<&'static str> = FUNCTIONS
        .into_iter()
        .map(Function::name)
        .chain(PHRASES)
        .chain(FORMS)
        .chain(NAMED_POTENTIALS.iter().map(|potential| potential.name))
        .chain([SELF_GRAVITY])
        .collect();
    let nearest = nearest(name, known.iter().copied());
    PotentialMistake::UnknownFunction {
        name: shortened(name),
        nearest,
        familiar: textbook::function(name),
        known,
    }
}
