//! `emit(lanes)`: the constants of several trajectories as those of one in lanes.

use proc_macro2::TokenStream;
use quote::quote;

use super::{Context, Parts};
use crate::spec::Capability;

/// The implementation of the capability.
pub(in crate::emit) fn implementation(context: &Context) -> TokenStream {
    if !context.spec.emit.iter().any(|capability| capability.value == Capability::Lanes) {
        return TokenStream::new();
    }
    let (prepared, rt, n) = (&context.names.prepared, &context.names.rt, context.dim());
    let (generics, types, clause) = context.generics();
    let (t, constants) = (&context.names.scalar, &context.names.constants);
    let parts = Parts::of(context);
    let scalar = |name: TokenStream| quote!(#rt::gathered(constants, |lane| lane.#name));
    let vector = |name: TokenStream| quote!(#rt::Vector::<#n, #t>::from_fn(|row, _| #rt::gathered(constants, |lane| lane.#name[row])));
    let matrix = |name: TokenStream| {
        quote! {
            #rt::Matrix::<#n, #t>::from_fn(|row, column| {
                #rt::gathered(constants, |lane| lane.#name[(row, column)])
            })
        }
    };
    let list = |name: TokenStream| quote!(::core::array::from_fn(|k| #rt::gathered(constants, |lane| lane.#name[k])));
    let fields = [
        (parts.origin, quote!(t0), scalar(quote!(t0))),
        (parts.turn, quote!(turn), matrix(quote!(turn))),
        (parts.linear, quote!(p), vector(quote!(p))),
        (parts.drift, quote!(x0), vector(quote!(x0))),
        (parts.drift, quote!(drift), vector(quote!(drift))),
        (parts.momentum, quote!(momentum), matrix(quote!(momentum))),
        (!parts.fixed.is_empty(), quote!(fixed), list(quote!(fixed))),
        (parts.whirl.is_some(), quote!(whirl), matrix(quote!(whirl))),
        (parts.dilatation, quote!(dilatation), quote!(#rt::Breathing::none())),
        (parts.coefficients > 0, quote!(coefficients), list(quote!(coefficients))),
    ];
    let stored: Vec<_> = fields.iter().filter(|(wanted, ..)| *wanted).collect();
    let (parameter, marker) = if stored.is_empty() {
        (quote!(_constants), Some(quote!(scalar: ::core::marker::PhantomData)))
    } else {
        (quote!(constants), None)
    };
    let stored = stored.iter().map(|(_, name, value)| quote!(#name: #value,));
    quote! {
        impl #generics #rt::InLanes<#n> for #prepared #types #clause {
            fn constants_in_lanes<#t: #rt::Lanes>(
                #parameter: &[Self::Constants<#rt::f64>],
            ) -> Self::Constants<#t> {
                #constants { #(#stored)* #marker }
            }
        }
    }
}
