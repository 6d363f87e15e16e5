//! What the user wrote, as plain data with its places in the source; nothing is judged here but the notation.

mod custom;
mod entries;
mod expression;
mod expression_parser;
mod grammar;
mod item;
mod keys;
mod matrix_field;
mod momentum_side;
mod named_potentials;
mod names;
mod spanned;
mod statement;
mod symbol;
pub(crate) mod textbook;
mod value;

use proc_macro2::TokenStream;

use crate::diagnostics::{Diagnostics, Reported};
use expression_parser::Language;
pub(crate) use expression_parser::application;

pub use crate::symbol::Capability;
pub use custom::{Custom, Mark, Role, SelfGravity};
pub use expression::{Expression, ExpressionKind, MatrixName, Operator, PolynomialTrace, more_factors};
pub(crate) use item::repeated;
pub use item::{Field, Item};
pub use matrix_field::Storage;
pub use momentum_side::MomentumKind;
pub use named_potentials::{NAMED_POTENTIALS, NamedPotential};
pub use names::{Claim, Named, PlacementGroup, Requirement, nearest};
pub use spanned::Spanned;
pub use statement::{Metric, Potential, Spec, Symmetry, Term, Value};
pub(crate) use symbol::numbered;
pub use symbol::{POTENTIAL_SYMBOLS, SYMBOLS, Symbol};

/// Reads the attribute's arguments and the item below it.
///
/// # Errors
/// [`Reported`] if the notation has mistakes; all of them are in the bag.
pub fn parse(args: TokenStream, item: TokenStream, found: &mut Diagnostics) -> Result<Spec, Reported> {
    let item = item::parse(item, found);
    Ok(grammar::parse(args, item, found)?.with_entries())
}

/// Reads one expression, as a coefficient of the kinetic energy is read.
///
/// # Errors
/// [`Reported`] if it is malformed.
pub fn parse_expression(tokens: TokenStream, found: &mut Diagnostics) -> Result<Expression, Reported> {
    whole(tokens, Language::Coefficient, found)
}

/// Reads one expression, as a potential is read.
///
/// # Errors
/// [`Reported`] if it is malformed.
pub fn parse_potential(tokens: TokenStream, found: &mut Diagnostics) -> Result<Expression, Reported> {
    whole(tokens, Language::Potential(&[]), found)
}

fn whole(
    tokens: TokenStream,
    language: Language<'_>,
    found: &mut Diagnostics,
) -> Result<Expression, Reported> {
    let tokens: Vec<_> = tokens.into_iter().collect();
    let at = entries::region(&tokens).unwrap_or_else(|| proc_macro2::Span::call_site().into());
    expression_parser::parse(tokens, at, language, found)
}
