//! What is integrated beside the placement though it is a function of it.

use proc_macro2::TokenStream;
use quote::quote;

use crate::derive::VolumeMeasure;
use crate::emit::context::Context;
use crate::emit::pattern::{components, identifiers, pattern};
use crate::emit::point::bind_measure;

/// The state with `1/D` and `q` from its placement.
pub(super) fn renewed(context: &Context, list: &[VolumeMeasure]) -> TokenStream {
    let (rt, t, n) = (&context.names.rt, &context.names.scalar, context.model.dim);
    let all: Vec<String> = context.model.reduced.names();
    let names = identifiers(&all);
    let rows = components("phi", n).into_iter().map(|row| {
        let row = identifiers(&row);
        quote!([#(#row),*])
    });
    let is_carried = |name: &str| list.iter().any(|carried| carried.quantity().stem() == name);
    let kept: Vec<&str> = all.iter().map(String::as_str).filter(|name| !is_carried(name)).collect();
    let bound = pattern(&all, &kept);
    let carried = computed(context, list, &quote!(&phi));
    quote! {
        fn renewed<#t: #rt::Real>(&self, reduced: &Self::Reduced<#t>) -> Self::Reduced<#t> {
            let #bound = *reduced;
            let phi = #rt::matrix([#(#rows),*]);
            #carried
            [#(#names),*]
        }
    }
}

/// What is carried along, as a function of the placement.
pub(super) fn computed(context: &Context, list: &[VolumeMeasure], phi: &TokenStream) -> TokenStream {
    list.iter().map(|measure| bind_measure(context, *measure, phi)).collect()
}
