//! What is integrated beside the placement though it is a function of it.

use proc_macro2::TokenStream;
use quote::quote;

use crate::derive::VolumeMeasure;
use crate::emit::context::Context;
use crate::emit::pattern::{entries, identifiers, pattern, table};
use crate::emit::point::bind_measure;
use crate::symbol::{Quantity, Symbol};

/// The state with `1/D` and `q` from its placement.
pub(super) fn renewed(context: &Context, list: &[VolumeMeasure]) -> TokenStream {
    let (rt, t, n) = (&context.names.rt, &context.names.scalar, context.model.dim);
    let all = context.model.dynamics.reduced.symbols();
    let names = identifiers(&all);
    let rows = table(&entries(Quantity::Placement, n));
    let is_carried = |symbol: &Symbol| list.iter().any(|carried| *symbol == carried.quantity().into());
    let kept: Vec<Symbol> = all.iter().filter(|symbol| !is_carried(symbol)).cloned().collect();
    let bound = pattern(&all, &kept);
    let carried = computed(context, list, &quote!(&phi));
    quote! {
        fn renewed<#t: #rt::Real>(&self, reduced: &Self::Reduced<#t>) -> Self::Reduced<#t> {
            let #bound = *reduced;
            let phi = #rt::matrix(#rows);
            #carried
            [#(#names),*]
        }
    }
}

/// What is carried along, as a function of the placement.
pub(super) fn computed(context: &Context, list: &[VolumeMeasure], phi: &TokenStream) -> TokenStream {
    list.iter().map(|measure| bind_measure(context, *measure, phi)).collect()
}
