//! Precedence parser for expressions.
//!
//! ```text
//! sum     = product (("+" | "-") product)*
//! product = sign (("*" | "/") sign)*
//! sign    = "-" sign | power
//! power   = atom ("^" sign)?
//! atom    = number | name | "(" sum ")" | applied
//! ```
//!
//! `applied` is a name with brackets after it; only potentials have it, and a module of its own reads it.
//!
//! Hence `^` binds tightest and to the right, above the minus sign: `-q^2` is `-(q^2)`, `2^-1` is one half.
//! Rust's own precedences are of no use: there `^` is weaker than `+`.

mod applied;
mod rust_notation;
mod trace;

pub(crate) use applied::application;

use proc_macro2::{Delimiter, Group, Ident, Literal, Spacing, TokenTree};

use super::entries::describe;
use super::{Expression, ExpressionKind, Operator};
use crate::algebra::Rational;
use crate::diagnostics::{Diagnostics, ExpressionMistake, Region, Reported};

/// More than a person writes, few enough for recursion over the tree on a small stack.
const MOST_OPERATORS: usize = 256;
/// Brackets, signs and powers within each other; each level costs several stack frames of this parser.
const DEEPEST: usize = 64;
/// The decimal exponents of f64.
const LARGEST_EXPONENT: u32 = 308;
/// Digits of a literal: f64 has 17, a double-double 32; exact arithmetic on a page of digits helps nobody.
const MOST_DIGITS: usize = 320;

/// What an expression may be made of.
#[derive(Clone, Copy)]
pub(super) enum Language<'p> {
    /// Arithmetic over numbers and names.
    Coefficient,
    /// With functions, traces and entries. The names bound here stand for expressions: the parameters of a
    /// named potential.
    Potential(&'p [(&'static str, Expression)]),
}

pub(super) fn parse(
    tokens: Vec<TokenTree>,
    at: Region,
    language: Language<'_>,
    found: &mut Diagnostics,
) -> Result<Expression, Reported> {
    let mut effort = Effort { operators: 0, depth: 0 };
    Parser::new(tokens, at, language, &mut effort, found).whole()
}

/// What an expression has cost so far.
struct Effort {
    operators: usize,
    depth: usize,
}

struct Parser<'p> {
    tokens: std::iter::Peekable<std::vec::IntoIter<TokenTree>>,
    /// The token read last: where something is missing if nothing follows.
    last: Region,
    language: Language<'p>,
    effort: &'p mut Effort,
    found: &'p mut Diagnostics,
}

impl<'p> Parser<'p> {
    fn new(
        tokens: Vec<TokenTree>,
        at: Region,
        language: Language<'p>,
        effort: &'p mut Effort,
        found: &'p mut Diagnostics,
    ) -> Self {
        Self { tokens: tokens.into_iter().peekable(), last: at, language, effort, found }
    }

    fn whole(mut self) -> Result<Expression, Reported> {
        let expression = self.sum()?;
        match self.tokens.next() {
            None => Ok(expression),
            Some(rest) => Err(self.unexpected(&rest, "an operator or a comma")),
        }
    }

    fn sum(&mut self) -> Result<Expression, Reported> {
        let mut left = self.product()?;
        while let Some(operator) = self.operator(&[('+', Operator::Add), ('-', Operator::Subtract)])? {
            left = operator.apply(left, self.product()?);
        }
        Ok(left)
    }

    fn product(&mut self) -> Result<Expression, Reported> {
        let mut left = self.sign()?;
        while let Some(operator) = self.operator(&[('*', Operator::Multiply), ('/', Operator::Divide)])? {
            if operator == Operator::Multiply
                && let Some(star) = self.punct('*')
            {
                return Err(self.found.report(self.last.to(star), ExpressionMistake::DoubleStar));
            }
            left = operator.apply(left, self.sign()?);
        }
        Ok(left)
    }

    fn sign(&mut self) -> Result<Expression, Reported> {
        let Some(minus) = self.punct('-') else { return self.power() };
        self.count(minus)?;
        let operand = self.deeper(Self::sign)?;
        let span = minus.to(operand.span);
        Ok(Expression { kind: ExpressionKind::Negate(Box::new(operand)), span })
    }

    fn power(&mut self) -> Result<Expression, Reported> {
        let base = self.atom()?;
        if let Some(dot) = self.punct('.') {
            return Err(self.behind_a_dot(&base, dot));
        }
        match self.operator(&[('^', Operator::Power)])? {
            None => Ok(base),
            Some(power) => {
                let exponent = self.deeper(Self::sign)?;
                if matches!(self.language, Language::Potential(_)) {
                    self.no_transpose(&base, &exponent)?;
                }
                Ok(power.apply(base, exponent))
            }
        }
    }

    fn atom(&mut self) -> Result<Expression, Reported> {
        let Some(token) = self.tokens.next() else {
            return Err(self.found.report(self.last, ExpressionMistake::MissingOperand));
        };
        self.last = token.span().into();
        match token {
            TokenTree::Literal(literal) => self.number(&literal),
            TokenTree::Ident(word) if word == "if" || word == "match" => {
                Err(self.found.report(self.last, ExpressionMistake::Branch { word: word.to_string() }))
            }
            TokenTree::Ident(name) => self.symbol(name),
            // A fragment of `macro_rules!` arrives in an invisible group and is one operand, as in Rust.
            TokenTree::Group(group)
                if matches!(group.delimiter(), Delimiter::Parenthesis | Delimiter::None) =>
            {
                self.group(&group)
            }
            TokenTree::Punct(colon) if colon.as_char() == ':' => Err(self.path(self.last, ":".to_owned())),
            other => Err(self.unexpected(&other, "a number, a field or `(`")),
        }
    }

    fn group(&mut self, group: &Group) -> Result<Expression, Reported> {
        let at = Region { start: group.span_open(), end: group.span_close() };
        let inner = self.inner(group.stream().into_iter().collect(), at, self.language)?;
        Ok(Expression { kind: inner.kind, span: at })
    }

    /// A whole expression one level deeper.
    fn inner(
        &mut self,
        tokens: Vec<TokenTree>,
        at: Region,
        language: Language<'_>,
    ) -> Result<Expression, Reported> {
        self.deeper(|parser| Parser::new(tokens, at, language, parser.effort, parser.found).whole())
    }

    /// A name; brackets directly after it apply a function or an index.
    fn symbol(&mut self, name: Ident) -> Result<Expression, Reported> {
        let span = Region::from(name.span());
        if matches!(self.tokens.peek(), Some(TokenTree::Punct(colon))
            if colon.as_char() == ':' && colon.spacing() == Spacing::Joint)
        {
            return Err(self.path(span, name.to_string()));
        }
        let brackets = self.tokens.next_if(|token| {
            matches!(token, TokenTree::Group(group)
                if matches!(group.delimiter(), Delimiter::Parenthesis | Delimiter::Bracket))
        });
        let bound = match (self.language, brackets) {
            (Language::Potential(_), Some(TokenTree::Group(group))) => {
                self.last = group.span_close().into();
                return self.applied(&name, &group);
            }
            (_, Some(_)) => {
                return Err(self
                    .found
                    .report(span, ExpressionMistake::FunctionCall { name: name.to_string() }));
            }
            (Language::Potential(bound), None) => {
                self.has_brackets(&name)?;
                bound.iter().find(|(parameter, _)| name == parameter)
            }
            (Language::Coefficient, None) => None,
        };
        Ok(bound.map_or_else(
            || Expression { kind: ExpressionKind::Symbol(name.clone()), span },
            |(_, value)| value.clone(),
        ))
    }

    /// The argument of a function stands in brackets, and not behind a space, as in `tr G`.
    fn has_brackets(&mut self, name: &Ident) -> Result<(), Reported> {
        let is_argument = |token: &TokenTree| matches!(token, TokenTree::Ident(_) | TokenTree::Literal(_));
        if application(&name.to_string()).is_none() {
            return Ok(());
        }
        match self.tokens.next_if(is_argument) {
            Some(argument) => Err(self.unexpected(&argument, "`(`")),
            None => Ok(()),
        }
    }

    fn number(&mut self, literal: &Literal) -> Result<Expression, Reported> {
        let span = Region::from(literal.span());
        let text = literal.to_string();
        let read = syn::Lit::new(literal.clone());
        if let syn::Lit::Str(_) = read {
            let mistake = ExpressionMistake::Quoted { literal: super::entries::shortened(&text) };
            return Err(self.found.report(span, mistake));
        }
        // A macro can make the one token `-1`.
        let (negative, digits) = text.strip_prefix('-').map_or((false, text.as_str()), |rest| (true, rest));
        let value = exact(&read, digits).map_err(|mistake| self.found.report(span, mistake))?;
        let number = Expression { kind: ExpressionKind::Number(value), span };
        Ok(match negative {
            true => Expression { kind: ExpressionKind::Negate(Box::new(number)), span },
            false => number,
        })
    }

    /// The operator that stands next, if it is one of these.
    fn operator(&mut self, any: &[(char, Operator)]) -> Result<Option<Operator>, Reported> {
        for (symbol, operator) in any {
            if let Some(at) = self.punct(*symbol) {
                self.last = at;
                self.count(at)?;
                return Ok(Some(*operator));
            }
        }
        Ok(None)
    }

    fn punct(&mut self, symbol: char) -> Option<Region> {
        let next =
            self.tokens.next_if(|token| matches!(token, TokenTree::Punct(p) if p.as_char() == symbol))?;
        Some(next.span().into())
    }

    fn count(&mut self, at: Region) -> Result<(), Reported> {
        self.effort.operators += 1;
        if self.effort.operators > MOST_OPERATORS {
            return Err(self.found.report(at, ExpressionMistake::ExpressionSize { limit: "256 operators" }));
        }
        Ok(())
    }

    fn deeper<T>(&mut self, inner: impl FnOnce(&mut Self) -> Result<T, Reported>) -> Result<T, Reported> {
        if self.effort.depth == DEEPEST {
            let mistake =
                ExpressionMistake::ExpressionSize { limit: "64 levels of brackets, signs and powers" };
            return Err(self.found.report(self.last, mistake));
        }
        self.effort.depth += 1;
        let result = inner(self);
        self.effort.depth -= 1;
        result
    }

    fn unexpected(&mut self, token: &TokenTree, expected: &'static str) -> Reported {
        self.found
            .report(token.span(), ExpressionMistake::UnexpectedToken { found: describe(token), expected })
    }
}

/// The rational that a literal denotes. Hexadecimal and the like have no fractions and no place here; a suffix
/// would promise a machine type that exact numbers do not have.
fn exact(read: &syn::Lit, literal: &str) -> Result<Rational, ExpressionMistake> {
    let not_a_number = || ExpressionMistake::NotANumber { literal: super::entries::shortened(literal) };
    let suffix = match read {
        syn::Lit::Int(_) if ["0x", "0o", "0b"].iter().any(|radix| literal.starts_with(radix)) => None,
        syn::Lit::Int(integer) => Some(integer.suffix()),
        syn::Lit::Float(number) => Some(number.suffix()),
        _ => None,
    };
    let Some((suffix, number)) = suffix.and_then(|suffix| Some((suffix, literal.strip_suffix(suffix)?)))
    else {
        return Err(not_a_number());
    };
    if !suffix.is_empty() {
        let number = number.trim_end_matches('_').to_owned();
        return Err(ExpressionMistake::NumberSuffix { number, suffix: suffix.to_owned() });
    }
    let exponent = number.find(['e', 'E']).map_or("0", |at| &number[at + 1..]).replace('_', "");
    let small = exponent.parse::<i32>().is_ok_and(|exponent| exponent.unsigned_abs() <= LARGEST_EXPONENT);
    if !small {
        return Err(ExpressionMistake::NumberRange { literal: super::entries::shortened(literal) });
    }
    if number.len() > MOST_DIGITS {
        return Err(ExpressionMistake::ExpressionSize { limit: "320 digits in a number" });
    }
    Rational::parse_decimal(number).ok_or_else(not_a_number)
}
