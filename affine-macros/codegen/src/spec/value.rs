//! Coefficients: a scalar, `diag(...)` or a nested matrix.

use proc_macro2::{Delimiter, Group, TokenTree};

use super::entries::{Piece, pieces, unwrapped};
use super::expression::Expression;
use super::expression_parser::{self, Language};
use super::statement::Value;
use crate::diagnostics::{Diagnostics, ExpressionMistake, Reported};

pub(super) fn parse(piece: Piece, found: &mut Diagnostics) -> Result<Value, Reported> {
    let Piece { tokens, at } = piece;
    let tokens = unwrapped(tokens);
    match tokens.as_slice() {
        [TokenTree::Group(group)] if group.delimiter() == Delimiter::Bracket => {
            all(group, row, found).map(Value::Matrix)
        }
        [TokenTree::Ident(name), TokenTree::Group(group)]
            if name == "diag" && group.delimiter() == Delimiter::Parenthesis =>
        {
            all(group, entry, found).map(Value::Diagonal)
        }
        _ => expression_parser::parse(tokens, at, Language::Coefficient, found).map(Value::Scalar),
    }
}

fn row(piece: Piece, found: &mut Diagnostics) -> Result<Vec<Expression>, Reported> {
    let is_row = |token: &TokenTree| matches!(token, TokenTree::Group(group) if group.delimiter() == Delimiter::Bracket);
    match unwrapped(piece.tokens).as_slice() {
        [first, second, ..] if is_row(first) && is_row(second) => {
            Err(found.report(second.span(), ExpressionMistake::MissingComma))
        }
        [TokenTree::Group(group)] if group.delimiter() == Delimiter::Bracket => all(group, entry, found),
        _ => Err(found.report(piece.at, ExpressionMistake::FlatMatrix)),
    }
}

fn entry(piece: Piece, found: &mut Diagnostics) -> Result<Expression, Reported> {
    expression_parser::parse(piece.tokens, piece.at, Language::Coefficient, found)
}

/// Everything between brackets, or an error; the results are made before the first error is looked for, so that all are reported.
fn all<T>(
    group: &Group,
    one: fn(Piece, &mut Diagnostics) -> Result<T, Reported>,
    found: &mut Diagnostics,
) -> Result<Vec<T>, Reported> {
    let results: Vec<_> =
        pieces(group.stream(), group.span_close()).into_iter().map(|piece| one(piece, found)).collect();
    results.into_iter().collect()
}
