//! Forces that no potential has.

use proc_macro2::TokenStream;
use quote::quote;

use super::context::Context;
use super::pattern::time;
use super::point::bind_point;

/// `power`: nothing where the energy is that of the trait's default, conserved.
pub(super) fn power(context: &Context) -> TokenStream {
    let Some(program) = &context.model.power else { return TokenStream::new() };
    let (rt, t) = (&context.names.rt, &context.names.scalar);
    let bound = bind_point(context, program);
    let time = time(program);
    let body = context.generic(program);
    let (lets, power) = (&body.lets, body.result());
    // The power of a potential of the time alone is that at every point.
    let (point, inward) = match bound.is_empty() {
        true => (quote!(_point), TokenStream::new()),
        false => (quote!(point), context.inward()),
    };
    quote! {
        fn power<#t: #rt::Real>(&self, #time: #t, #point: &Self::Point<#t>) -> #t {
            #inward
            #bound
            #lets
            #power
        }
    }
}
