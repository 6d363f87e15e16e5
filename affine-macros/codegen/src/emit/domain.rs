//! Where the potential has a value.

use proc_macro2::TokenStream;
use quote::quote;

use crate::derive::{Domain, Sign, SignedArgument};

use super::context::{Coefficients, Context};
use super::pattern::time;
use super::point::{at_placement, bind_point};

/// The functions of the state that keep their sign, in the description of the model.
pub(super) fn guards(context: &Context) -> TokenStream {
    let rt = &context.names.rt;
    let arguments = context.model.point.domain.iter().flat_map(Domain::arguments);
    let guards = arguments.map(|SignedArgument { part, argument, sign }| {
        let bound = match sign {
            Sign::Positive => quote!(Positive),
            Sign::NotNegative => quote!(NotNegative),
            Sign::NotZero => quote!(NotZero),
        };
        quote!(#rt::Guard { part: #part, argument: #argument, bound: #rt::Bound::#bound })
    });
    quote!(&[#(#guards),*])
}

/// The parts of the potential with an angle that the time turns.
pub(super) fn angles(context: &Context) -> TokenStream {
    let parts = context.model.point.domain.iter().flat_map(Domain::angles);
    quote!(&[#(#parts),*])
}

/// `domain`: nothing where the potential has a value at every state.
pub(super) fn values(context: &Context) -> TokenStream {
    let Some(domain) = &context.model.point.domain else { return TokenStream::new() };
    let rt = &context.names.rt;
    let program = &domain.program;
    let (time, inward) = (time(program), context.inward(Coefficients::Own));
    let (bound, placed) = (bind_point(context, program), at_placement(context, program));
    let body = context.double(program);
    let (lets, values) = (&body.lets, &body.results);
    let (point, inward) = match bound.is_empty() && placed.is_empty() {
        true => (quote!(_point), TokenStream::new()),
        false => (quote!(point), inward),
    };
    quote! {
        fn domain(&self, #time: #rt::f64, #point: &Self::Point<#rt::f64>, each: &mut dyn ::core::ops::FnMut(#rt::f64)) {
            #inward
            #bound
            #placed
            #lets
            #(each(#values);)*
        }
    }
}
