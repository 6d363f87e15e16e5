//! `emit(lanes)`: the constants of several trajectories as those of one in lanes, and back.

use proc_macro2::TokenStream;
use quote::quote;

use super::context::Context;
use super::trajectory::{self, Kept};
use crate::algebra::passage::Extent;
use crate::spec::Capability;

/// The implementation of the capability.
pub(super) fn implementation(context: &Context) -> TokenStream {
    if !context.spec.asked().has(Capability::Lanes) {
        return TokenStream::new();
    }
    let rt = &context.names.rt;
    let (t, constants) = (&context.names.scalar, &context.names.constants);
    let stored = trajectory::kept(context, &[]);
    let (argument, lane, own) = match stored.is_empty() {
        true => (quote!(_constants), quote!(_lane), quote!(_own)),
        false => (quote!(constants), quote!(lane), quote!(own)),
    };
    // Where there are no constants, there is nothing to say.
    let of = |entry: &dyn Fn(TokenStream) -> TokenStream| {
        let fields = stored.iter().map(|field| field.with(context, entry));
        (!stored.is_empty()).then(|| quote!(#constants { #(#fields),* }))
    };
    let gathered = of(&|entry| quote!(#rt::gathered(constants, |lane| lane.#entry)));
    let of_lane = of(&|entry| quote!(#rt::in_lane(&constants.#entry, lane)));
    let set = stored.iter().map(|field| field.set(context));
    let items = quote! {
        fn constants_in_lanes<#t: #rt::Lanes>(
            #argument: &[Self::Constants<#rt::f64>],
        ) -> Self::Constants<#t> {
            #gathered
        }

        fn put_constants<#t: #rt::Lanes>(
            #argument: &mut Self::Constants<#t>,
            #lane: #rt::usize,
            #own: &Self::Constants<#rt::f64>,
        ) {
            #(#set)*
        }

        #[inline(always)]
        fn constants_of_lane<#t: #rt::Lanes>(
            #argument: &Self::Constants<#t>,
            #lane: #rt::usize,
        ) -> Self::Constants<#t::Lane> {
            #of_lane
        }
    };
    context.implementation("InLanes", &items)
}

impl Kept {
    /// The field, entry by entry a function of the entry it comes from.
    fn with(&self, context: &Context, from: impl Fn(TokenStream) -> TokenStream) -> TokenStream {
        let (rt, name) = (&context.names.rt, &self.name);
        let value = match self.extent {
            Extent::Number => from(quote!(#name)),
            Extent::Vector => {
                let entry = from(quote!(#name[row]));
                quote!(#rt::Vector::from_fn(|row, _| #entry))
            }
            Extent::Matrix => {
                let entry = from(quote!(#name[(row, column)]));
                quote!(#rt::Matrix::from_fn(|row, column| #entry))
            }
            Extent::List(_) => {
                let entry = from(quote!(#name[k]));
                quote!(::core::array::from_fn(|k| #entry))
            }
            Extent::Dilatation => quote!(#rt::Breathing::none()),
        };
        quote!(#name: #value)
    }

    /// The field of one trajectory put into its lane.
    fn set(&self, context: &Context) -> TokenStream {
        let (rt, name) = (&context.names.rt, &self.name);
        match self.extent {
            Extent::Number => quote!(#rt::Lanes::set_lane(&mut constants.#name, lane, own.#name);),
            Extent::Vector | Extent::Matrix | Extent::List(_) => {
                quote!(#rt::set_entries(constants.#name.as_mut_slice(), lane, own.#name.as_slice());)
            }
            Extent::Dilatation => TokenStream::new(),
        }
    }
}
