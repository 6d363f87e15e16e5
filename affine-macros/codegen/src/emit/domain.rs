//! Where the potential has a value.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::context::Context;
use super::pattern::time;
use super::point::{at_placement, bind_point};
use crate::mechanics::potential::{Bound, Guard};

/// The functions of the state that keep their sign, in the description of the model.
pub(super) fn guards(context: &Context) -> TokenStream {
    let rt = &context.names.rt;
    let guards = listed(context).filter(|guard| guard.bound != Bound::Angle).map(|guard| {
        let (part, argument) = (&guard.part, &guard.argument);
        let bound = format_ident!("{}", format!("{:?}", guard.bound));
        quote!(#rt::Guard { part: #part, argument: #argument, bound: #rt::Bound::#bound })
    });
    quote!(&[#(#guards),*])
}

/// The parts of the potential with an angle that the time turns.
pub(super) fn angles(context: &Context) -> TokenStream {
    let parts = listed(context).filter(|guard| guard.bound == Bound::Angle).map(|guard| &guard.part);
    quote!(&[#(#parts),*])
}

fn listed<'a>(context: &'a Context) -> impl Iterator<Item = &'a Guard> {
    context.model.domain.iter().flat_map(|domain| &domain.guards)
}

/// `domain`: nothing where the potential has a value at every state.
pub(super) fn values(context: &Context) -> TokenStream {
    let Some(domain) = &context.model.domain else { return TokenStream::new() };
    let rt = &context.names.rt;
    let program = &domain.program;
    let (time, inward) = (time(program), context.inward());
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
