//! Programs over the fields of the user's struct.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use crate::ir::Program;
use crate::symbol::Symbol;

use super::body::{Body, body};
use super::names::Names;
use super::number::{Number, number};
use super::pattern::named;
use super::scope::Scope;

/// The local variable of a field of matrix type.
pub(super) fn matrix_name(field: impl std::fmt::Display) -> Ident {
    format_ident!("matrix_{}", bare(field))
}

/// The name of a field without the mark of a raw identifier.
pub(super) fn bare(field: impl std::fmt::Display) -> String {
    field.to_string().trim_start_matches("r#").to_owned()
}

/// The local variable of a field that is a number.
pub(super) fn number_name(field: impl std::fmt::Display) -> Ident {
    format_ident!("field_{}", bare(field))
}

/// What reads a field, an entry of one, or what was computed before.
fn read(symbol: &Symbol) -> TokenStream {
    let entry = |matrix: Ident, row: usize, column: usize| {
        let [row, column] = [row, column].map(|place| number(place.saturating_sub(1)));
        quote!(#matrix[#row][#column])
    };
    match symbol {
        Symbol::Field(field) => {
            let field = number_name(field);
            quote!(#field)
        }
        Symbol::Entry(field, row, column) => entry(matrix_name(field), *row, *column),
        Symbol::Prepared(matrix, row, column) => entry(matrix_name(matrix), *row, *column),
        known => named(known),
    }
}

/// A program over the fields, and over inverse blocks computed before.
pub(super) fn over_fields(names: &Names, program: &Program) -> Body {
    let (number, rt) = (Number::Generic(&names.scalar), &names.rt);
    body(program, &Scope { number, input: &read, rebased: false, places: &[], rt })
}
