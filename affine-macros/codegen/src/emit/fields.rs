//! Programs over the fields of the user's struct.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use crate::ir::Program;
use crate::spec::FIELD;

use super::body::{Body, body};
use super::number::{Number, number};
use super::scope::Scope;

/// The local variable of a field of matrix type.
pub(super) fn matrix_name(field: impl std::fmt::Display) -> Ident {
    format_ident!("matrix_{}", field.to_string().trim_start_matches("r#"))
}

/// What reads a field, or an entry `j[1,2]` of one.
fn read_field(name: &str) -> TokenStream {
    let entry = name.strip_suffix(']').and_then(|entry| entry.split_once('['));
    let places = entry.and_then(|(field, places)| {
        let (row, column) = places.split_once(',')?;
        let place = |index: &str| Some(number(index.parse::<usize>().ok()?.checked_sub(1)?));
        Some((matrix_name(field), place(row)?, place(column)?))
    });
    match places {
        Some((matrix, row, column)) => quote!(#matrix[#row][#column]),
        None => {
            let field = format_ident!("{name}");
            quote!(self.#field)
        }
    }
}

/// A program over the fields, and over inverse blocks computed before.
pub(super) fn over_fields(rt: &Ident, program: &Program) -> Body {
    let input = |name: &str| match name.strip_prefix(FIELD) {
        Some(field) => read_field(field),
        None => {
            let name = format_ident!("{name}");
            quote!(#name)
        }
    };
    body(program, &Scope { number: Number::Double, input: &input, rebased: false, places: &[], rt })
}
