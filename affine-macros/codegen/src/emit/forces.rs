//! Forces that no potential has.

use std::slice;

use proc_macro2::TokenStream;
use quote::quote;

use super::context::{Coefficients, Context};
use super::parametric::Evaluation;
use super::pattern::time;
use super::point::bind_point;

/// `power`: nothing where the energy is that of the trait's default, conserved.
pub(super) fn power(context: &Context) -> TokenStream {
    let Some(program) = &context.model.point.power else { return TokenStream::new() };
    let (rt, t) = (&context.names.rt, &context.names.scalar);
    let bound = bind_point(context, program);
    let time = time(program);
    let body = context.generic(program, Coefficients::Given);
    let (lets, power) = (&body.lets, body.result());
    let programs = slice::from_ref(program);
    // The power of a potential of the time alone is that at every point.
    let (Evaluation { name, parameter }, point, inward) = match bound.is_empty() {
        true => (Evaluation::of(context, "power", programs), quote!(_point), TokenStream::new()),
        false => {
            let inward = context.inward(Coefficients::Given);
            (Evaluation::of_points(context, "power", programs), quote!(point), inward)
        }
    };
    quote! {
        fn #name<#t: #rt::Real>(&self, #parameter #time: #t, #point: &Self::Point<#t>) -> #t {
            #inward
            #bound
            #lets
            #power
        }
    }
}
