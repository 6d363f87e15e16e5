//! `emit(lanes)`: the constants of several trajectories as those of one in lanes, and back.

use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;

use super::context::Context;
use crate::derive::Trajectory;
use crate::spec::Capability;

/// The implementation of the capability.
pub(super) fn implementation(context: &Context) -> TokenStream {
    if !context.spec.emit.iter().any(|capability| capability.value == Capability::Lanes) {
        return TokenStream::new();
    }
    let (prepared, rt, n) = (&context.names.prepared, &context.names.rt, context.dim());
    let (generics, types, clause) = context.generics();
    let (t, constants) = (&context.names.scalar, &context.names.constants);
    let parts = Trajectory::of(context.model);
    let stored: Vec<Stored> = [
        (parts.origin, "t0", Shape::Number),
        (parts.turn, "turn", Shape::Matrix),
        (parts.linear, "p", Shape::Vector),
        (parts.drift, "x0", Shape::Vector),
        (parts.drift, "drift", Shape::Vector),
        (parts.conserved, "momentum", Shape::Matrix),
        (!parts.fixed.is_empty(), "fixed", Shape::List),
        (parts.rotation.is_some(), "whirl", Shape::Matrix),
        (parts.dilatation.is_some(), "dilatation", Shape::Dilatation),
        (parts.coefficients > 0, "coefficients", Shape::List),
    ]
    .into_iter()
    .filter_map(|(wanted, name, shape)| {
        wanted.then(|| Stored { name: Ident::new(name, Span::call_site()), shape })
    })
    .collect();
    let (argument, lane, marker) = if stored.is_empty() {
        (quote!(_constants), quote!(_lane), Some(quote!(scalar: ::core::marker::PhantomData)))
    } else {
        (quote!(constants), quote!(lane), None)
    };
    let gathered = stored
        .iter()
        .map(|field| field.with(context, |entry| quote!(#rt::gathered(constants, |lane| lane.#entry))));
    let of_lane =
        stored.iter().map(|field| field.with(context, |entry| quote!(#rt::in_lane(&constants.#entry, lane))));
    quote! {
        impl #generics #rt::InLanes<#n> for #prepared #types #clause {
            fn constants_in_lanes<#t: #rt::Lanes>(
                #argument: &[Self::Constants<#rt::f64>],
            ) -> Self::Constants<#t> {
                #constants { #(#gathered,)* #marker }
            }

            #[inline(always)]
            fn constants_of_lane<#t: #rt::Lanes>(
                #argument: &Self::Constants<#t>,
                #lane: #rt::usize,
            ) -> Self::Constants<#t::Lane> {
                #constants { #(#of_lane,)* #marker }
            }
        }
    }
}

/// What is stored of a trajectory.
struct Stored {
    name: Ident,
    shape: Shape,
}

enum Shape {
    Number,
    Vector,
    Matrix,
    List,
    /// A motion that no equation reads.
    Dilatation,
}

impl Stored {
    /// The field, entry by entry a function of the entry it comes from.
    fn with(&self, context: &Context, from: impl Fn(TokenStream) -> TokenStream) -> TokenStream {
        let (rt, name) = (&context.names.rt, &self.name);
        let value = match self.shape {
            Shape::Number => from(quote!(#name)),
            Shape::Vector => {
                let entry = from(quote!(#name[row]));
                quote!(#rt::Vector::from_fn(|row, _| #entry))
            }
            Shape::Matrix => {
                let entry = from(quote!(#name[(row, column)]));
                quote!(#rt::Matrix::from_fn(|row, column| #entry))
            }
            Shape::List => {
                let entry = from(quote!(#name[k]));
                quote!(::core::array::from_fn(|k| #entry))
            }
            Shape::Dilatation => quote!(#rt::Breathing::none()),
        };
        quote!(#name: #value)
    }
}
