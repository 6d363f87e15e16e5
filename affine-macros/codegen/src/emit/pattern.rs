//! Names of components, and patterns that bind those of them that are read.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use crate::derive::reads_time;
use crate::ir::Program;

/// Is a name among others?
pub(super) fn contains(names: &[impl AsRef<str>], name: &str) -> bool {
    names.iter().any(|known| known.as_ref() == name)
}

/// Does a program with these inputs read any of some names?
pub(super) fn reads(used: &[impl AsRef<str>], names: &[String]) -> bool {
    names.iter().any(|name| contains(used, name))
}

/// Pattern that binds the components that `used` reads, in order.
pub(super) fn pattern(components: &[String], used: &[impl AsRef<str>]) -> TokenStream {
    let bind = components.iter().map(|name| {
        if contains(used, name) {
            let name = format_ident!("{name}");
            quote!(#name)
        } else {
            quote!(_)
        }
    });
    quote!([#(#bind),*])
}

pub(super) fn identifiers(names: &[String]) -> Vec<Ident> {
    names.iter().map(|name| format_ident!("{name}")).collect()
}

/// Names of the entries of a matrix, row by row.
pub(super) fn components(stem: &str, n: usize) -> Vec<Vec<String>> {
    (1..=n).map(|i| (1..=n).map(|j| format!("{stem}_{i}{j}")).collect()).collect()
}

/// Name of the time as a parameter: an idle one where the program does not read it.
pub(super) fn time(program: &Program) -> TokenStream {
    if reads_time(program) { quote!(t) } else { quote!(_t) }
}
