//! Variables of symbols, and patterns that bind those that are read.

use proc_macro2::{Ident, TokenStream};
use quote::{ToTokens, format_ident, quote};

use crate::ir::Program;
use crate::symbol::{Quantity, Symbol};

/// The variable of a symbol.
pub(super) fn ident(symbol: &Symbol) -> Ident {
    format_ident!("{}", symbol.to_string())
}

/// The same as an expression or as a pattern.
pub(super) fn named(symbol: &Symbol) -> TokenStream {
    ident(symbol).into_token_stream()
}

/// The variables of symbols.
pub(super) fn identifiers(symbols: &[Symbol]) -> Vec<Ident> {
    symbols.iter().map(ident).collect()
}

/// Is any of some symbols used?
pub(super) fn reads(used: &[Symbol], symbols: &[Symbol]) -> bool {
    symbols.iter().any(|symbol| used.contains(symbol))
}

/// Pattern that binds the components that are used, in order.
pub(super) fn pattern(components: &[Symbol], used: &[Symbol]) -> TokenStream {
    let bind = components.iter().map(|symbol| bound_if(used.contains(symbol), symbol));
    quote!([#(#bind),*])
}

fn bound_if(is_used: bool, symbol: &Symbol) -> TokenStream {
    if is_used { named(symbol) } else { quote!(_) }
}

/// The same of many components: it ends behind the last that is used.
pub(super) fn leading_pattern(components: &[Symbol], used: &[Symbol]) -> TokenStream {
    let Some(last) = components.iter().rposition(|symbol| used.contains(symbol)) else { return quote!(_) };
    let end = last + 1;
    let bind = components[..end].iter().map(|symbol| bound_if(used.contains(symbol), symbol));
    let rest = (end < components.len()).then(|| quote!(..));
    let parts = bind.chain(rest);
    quote!([#(#parts),*])
}

/// The statement that binds those of some components that are used to what `from` points at, and the name of that parameter,
/// an idle one where none is.
pub(super) fn bound(components: &[Symbol], used: &[Symbol], from: &str) -> (TokenStream, Ident) {
    held(if reads(used, components) { components } else { &[] }, used, from)
}

/// The same of a parameter that is idle only where it holds nothing.
pub(super) fn held(components: &[Symbol], used: &[Symbol], from: &str) -> (TokenStream, Ident) {
    if components.is_empty() {
        return (TokenStream::new(), format_ident!("_{from}"));
    }
    let (bound, from) = (pattern(components, used), format_ident!("{from}"));
    (quote!(let #bound = *#from;), from)
}

/// The same of a matrix, row by row.
pub(super) fn table_pattern(rows: &[Vec<Symbol>], used: &[Symbol]) -> TokenStream {
    let rows = rows.iter().map(|row| pattern(row, used));
    quote!([#(#rows),*])
}

/// The statement that binds the entries that are used of a matrix that stands in a variable of its name.
pub(super) fn bound_entries(name: &Symbol, rows: &[Vec<Symbol>], used: &[Symbol]) -> TokenStream {
    if !reads(used, &rows.concat()) {
        return TokenStream::new();
    }
    let (bound, name) = (table_pattern(rows, used), ident(name));
    quote!(let #bound = #name;)
}

/// A list as an expression, or as a pattern that binds all of it.
pub(super) fn list(symbols: &[Symbol]) -> TokenStream {
    let names = identifiers(symbols);
    quote!([#(#names),*])
}

/// The rows of a matrix as an expression, or as a pattern that binds all its entries.
pub(super) fn table(rows: &[Vec<Symbol>]) -> TokenStream {
    let rows = rows.iter().map(|row| list(row));
    quote!([#(#rows),*])
}

/// Results, so many a row.
pub(super) fn in_rows(results: &[TokenStream], size: usize) -> TokenStream {
    let rows = results.chunks(size).map(|row| quote!([#(#row),*]));
    quote!([#(#rows),*])
}

/// One by itself, several as a tuple.
pub(super) fn together(parts: &[TokenStream]) -> TokenStream {
    match parts {
        [one] => one.clone(),
        several => quote!((#(#several),*)),
    }
}

/// The components of a vector.
pub(super) fn components(of: Quantity, n: usize) -> Vec<Symbol> {
    (1..=n).map(|i| of.at([i])).collect()
}

/// The entries of a matrix, row by row.
pub(super) fn entries(of: Quantity, n: usize) -> Vec<Vec<Symbol>> {
    (1..=n).map(|i| (1..=n).map(|j| of.at([i, j])).collect()).collect()
}

/// Name of the time as a parameter: an idle one where the program does not read it.
pub(super) fn time(program: &Program) -> TokenStream {
    if program.reads_time() { quote!(t) } else { quote!(_t) }
}
