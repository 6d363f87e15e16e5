//! The hooks by which a simulation finds what a model has beyond the default.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::context::Context;

/// A method for each capability that the model has.
pub(super) fn hooks(context: &Context) -> TokenStream {
    let (rt, n, methods) = (&context.names.rt, context.dim(), &context.model.methods);
    let of_the_reduced_motion = |name: &str| {
        let name = format_ident!("{name}");
        quote!(#name<Self::Reduced<#rt::f64>, Self::Constants<#rt::f64>>)
    };
    let hooks = [
        ("splitting", methods.splitting.is_some(), of_the_reduced_motion("Pieces")),
        ("second_order", methods.second_order.is_some(), of_the_reduced_motion("SecondOrder")),
        ("taylor", methods.taylor.is_some(), of_the_reduced_motion("Series")),
        ("packing", methods.packed.is_some(), of_the_reduced_motion("Packing")),
        ("unconstrained", methods.unconstrained.is_some(), quote!(Unconstrained)),
    ];
    let present = hooks.into_iter().filter(|(_, is_present, _)| *is_present);
    present
        .map(|(name, _, capability)| {
            let name = format_ident!("{name}");
            quote! {
                fn #name(
                    model: impl #rt::Handle<#n, Model = Self>,
                ) -> ::core::option::Option<impl #rt::#capability> {
                    ::core::option::Option::Some(#rt::Emitted(model))
                }
            }
        })
        .collect()
}
