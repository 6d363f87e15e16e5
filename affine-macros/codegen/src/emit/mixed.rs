//! What a mass matrix that depends on the placement asks for.

use proc_macro2::TokenStream;
use quote::quote;

use crate::symbol::Quantity;

use super::body::Body;
use super::context::{Coefficients, Context};
use super::number::number;
use super::pattern::{components, pattern};
use super::point::placement;

/// `x_dot` of a point from `phi` and `p`: statements, and the vector.
pub(super) fn velocity_of_centre(context: &Context) -> (TokenStream, TokenStream) {
    let Some(masses) = &context.model.point.mixed_masses else { return Default::default() };
    let (rt, program) = (&context.names.rt, &masses.velocity);
    let placement = placement(context, program, &quote!(#rt::Phase::phi(point)));
    let p = pattern(&components(Quantity::LinearMomentum, context.model.dim), &program.inputs());
    let Body { lets, results } = context.generic(program, Coefficients::Given);
    let lets = quote!(#placement let #p = #rt::components(&#rt::Phase::p(point)); #lets);
    (lets, quote!(#rt::vector([#(#results),*])))
}

/// `p` of what moves.
pub(super) fn momentum_of_centre(context: &Context) -> TokenStream {
    let Some(masses) = &context.model.point.mixed_masses else { return TokenStream::new() };
    let rt = &context.names.rt;
    let Body { lets, results } = context.double(&masses.momentum);
    quote!(#lets let p = #rt::vector([#(#results),*]);)
}

/// `regularity`: signs and weakest pivot of the mass matrix, where they are not known for all placements.
pub(super) fn regularity(context: &Context) -> TokenStream {
    let Some(regularity) = &context.model.regularity else { return TokenStream::new() };
    let (rt, n) = (&context.names.rt, context.dim());
    let blocks = regularity.blocks.iter().map(|(program, size)| {
        let placement = placement(context, program, &quote!(phi));
        let Body { lets, results } = context.double(program);
        let (upper, sizes) = results.split_at(results.len() - size);
        let (size, count) = (number(*size), number(upper.len()));
        quote!({ #placement #lets #rt::Regularity::of::<#size, #count>([#(#upper),*], [#(#sizes),*]) })
    });
    let all = blocks.reduce(|all, block| quote!(#all.and(#block)));
    quote! {
        fn regularity(&self, phi: &#rt::Matrix<#n>) -> ::core::option::Option<#rt::Regularity> {
            ::core::option::Option::Some(#all)
        }
    }
}

/// A phase point or the error that it is none, refused also where the mass matrix is degenerate, or not positive where
/// that is required.
pub(super) fn regular(context: &Context, point: TokenStream) -> TokenStream {
    let Some(regularity) = &context.model.regularity else { return point };
    let (rt, positive) = (&context.names.rt, regularity.positive);
    quote! {
        let point = #point?;
        #rt::regular(#rt::Model::regularity(self, &phi), #positive)?;
        ::core::result::Result::Ok(point)
    }
}

/// That refusal in words, as the end of a sentence.
pub(super) fn refusal(context: &Context) -> &'static str {
    match &context.model.regularity {
        None => "",
        Some(r) if r.positive => ", `IllPosed` where the kinetic metric is not positive definite at `phi`",
        Some(_) => ", `IllPosed` where the kinetic metric is degenerate at `phi`",
    }
}
