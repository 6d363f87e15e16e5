//! Expressions with the strength of their outermost operator: brackets stand where they are needed.

use proc_macro2::{Span, TokenStream, TokenTree};
use quote::quote;

/// Binding strength of an expression's outermost operator.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Strength {
    Sum,
    Product,
    Sign,
    Atom,
}

/// An expression and its strength.
pub(super) type Expression = (TokenStream, Strength);

/// The expression where anything weaker takes brackets.
pub(super) fn at_least((tokens, strength): Expression, least: Strength) -> TokenStream {
    if strength < least { quote!((#tokens)) } else { tokens }
}

pub(super) fn negative(operand: Expression) -> Expression {
    let (minus, operand) = (inner(quote!(-)), at_least(operand, Strength::Sign));
    (quote!(#minus #operand), Strength::Sign)
}

pub(super) fn sum(a: Expression, b: Expression) -> Expression {
    infix(a, quote!(+), b, (Strength::Sum, Strength::Sum))
}

pub(super) fn difference(a: Expression, b: Expression) -> Expression {
    infix(a, inner(quote!(-)), b, (Strength::Sum, Strength::Product))
}

pub(super) fn product(a: Expression, b: Expression) -> Expression {
    infix(a, inner(quote!(*)), b, (Strength::Product, Strength::Product))
}

pub(super) fn quotient(a: Expression, b: Expression) -> Expression {
    infix(a, quote!(/), b, (Strength::Product, Strength::Sign))
}

/// An expression of strength `own`, whose right side is `right` at least.
fn infix(a: Expression, sign: TokenStream, b: Expression, (own, right): (Strength, Strength)) -> Expression {
    let (a, b) = (at_least(a, own), at_least(b, right));
    (quote!(#a #sign #b), own)
}

/// An operator that stands inside the macro. Where all tokens of an array have the place of the attribute, linters look for
/// the missing comma of `[a -b]` between the lines of the attribute.
pub(super) fn inner(operator: TokenStream) -> TokenStream {
    let placed = |token: TokenTree| {
        let mut token = token;
        token.set_span(Span::mixed_site());
        token
    };
    operator.into_iter().map(placed).collect()
}
