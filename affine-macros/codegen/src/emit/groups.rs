//! The layout of a state: what its components are, group after group.

use proc_macro2::TokenStream;
use quote::{ToTokens, format_ident, quote};

use crate::symbol::Quantity;

use super::context::Context;
use super::number::number;

/// A group of so many components.
pub(super) fn group(context: &Context, quantity: Quantity, len: &impl ToTokens) -> TokenStream {
    let (rt, quantity) = (&context.names.rt, format_ident!("{}", format!("{quantity:?}")));
    quote!(#rt::Group::new(#rt::Quantity::#quantity, #len))
}

/// The groups of a state.
pub(super) fn groups<C>(context: &Context, groups: &[(Quantity, Vec<C>)]) -> TokenStream {
    let entries = groups.iter().map(|(quantity, names)| group(context, *quantity, &number(names.len())));
    quote!(&[#(#entries),*])
}
