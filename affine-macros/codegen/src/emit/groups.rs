//! The layout of a state: what its components are, group after group.

use proc_macro2::TokenStream;
use quote::{ToTokens, quote};

use crate::symbol::Quantity;

use super::context::Context;
use super::names::variant;
use super::number::number;

/// A group of so many components.
fn group(context: &Context, quantity: Quantity, len: &impl ToTokens) -> TokenStream {
    let (rt, quantity) = (&context.names.rt, variant(quantity));
    quote!(#rt::Group::new(#rt::Quantity::#quantity, #len))
}

/// The groups of a state, one by one.
pub(super) fn each<C>(context: &Context, groups: &[(Quantity, Vec<C>)]) -> impl Iterator<Item = TokenStream> {
    groups.iter().map(|(quantity, names)| group(context, *quantity, &number(names.len())))
}

/// The groups of a state.
pub(super) fn groups<C>(context: &Context, groups: &[(Quantity, Vec<C>)]) -> TokenStream {
    let entries = each(context, groups);
    quote!(&[#(#entries),*])
}
