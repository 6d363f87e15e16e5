//! Where the potential has a value.

use proc_macro2::TokenStream;
use quote::{ToTokens, quote};

use crate::derive::Domain;
use crate::ir::Program;

use super::body::Body;
use super::context::{Coefficients, Context};
use super::names::variant;
use super::number::Number;
use super::pattern::time;
use super::point::{at_point, by_distance};

/// The functions of the state that keep their sign, in the description of the model.
pub(super) fn guards(context: &Context) -> Vec<TokenStream> {
    let rt = &context.names.rt;
    let guards = context.model.point.domain.iter().flat_map(Domain::signed);
    let guards = guards.map(|guard| {
        let (part, argument, bound) = (&guard.part, &guard.argument, variant(guard.bound));
        quote!(#rt::Guard { part: #part, argument: #argument, bound: #rt::Bound::#bound })
    });
    guards.collect()
}

/// A function of the user's is part of the potential.
pub(super) fn is_custom(context: &Context) -> bool {
    context.spec.customs.iter().any(|custom| !custom.role.value.is_force())
}

/// The parts of the potential with an angle that the time turns.
pub(super) fn angles(context: &Context) -> Vec<TokenStream> {
    let parts = context.model.point.domain.iter().flat_map(Domain::angles);
    parts.map(ToTokens::to_token_stream).collect()
}

/// `domain`: nothing where the potential has a value at every state.
pub(super) fn values(context: &Context) -> TokenStream {
    let Some(domain) = &context.model.point.domain else { return TokenStream::new() };
    let rt = &context.names.rt;
    let time = time(&domain.program);
    let values = |program: &Program| {
        let (Body { lets, results }, reads) = at_point(context, program, Number::Double);
        (quote!(#lets #(each(#results);)*), reads)
    };
    let (near, reads) = values(&domain.program);
    let (far_away, _) = domain.far_away.as_ref().map(values).unzip();
    let (point, inward) = match reads || far_away.is_some() {
        true => (quote!(point), context.inward(Coefficients::Own)),
        false => (quote!(_point), TokenStream::new()),
    };
    let values = by_distance(context, near, far_away);
    quote! {
        fn domain(&self, #time: #rt::f64, #point: &Self::Point<#rt::f64>, each: &mut dyn ::core::ops::FnMut(#rt::f64)) {
            #inward
            #values
        }
    }
}
