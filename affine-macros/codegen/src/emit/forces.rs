//! Forces that no potential has.

use proc_macro2::TokenStream;
use quote::quote;

use super::context::{Coefficients, Context};
use super::number::Number;
use super::parametric::Evaluation;
use super::pattern::time;
use super::point::at_point;

/// `power`: nothing where the energy is that of the trait's default, conserved.
pub(super) fn power(context: &Context) -> TokenStream {
    let Some(program) = &context.model.point.power else { return TokenStream::new() };
    let (rt, t) = (&context.names.rt, &context.names.scalar);
    let time = time(program);
    let (body, reads) = at_point(context, program, Number::Generic(t));
    let (lets, power) = (&body.lets, body.result());
    // The power of a potential of the time alone is that at every point.
    let (Evaluation { name, parameter }, point, inward) = match reads {
        false => (Evaluation::of(context, "power", [program]), quote!(_point), TokenStream::new()),
        true => {
            let inward = context.inward(Coefficients::Given);
            (Evaluation::of_points(context, "power", [program]), quote!(point), inward)
        }
    };
    quote! {
        fn #name<#t: #rt::Real>(&self, #parameter #time: #t, #point: &Self::Point<#t>) -> #t {
            #inward
            #lets
            #power
        }
    }
}
