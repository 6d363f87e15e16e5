//! `emit(two_polar, ratios)`: the lattice without exponentials.

use proc_macro2::TokenStream;
use quote::quote;

use crate::derive::TwoPolar;
use crate::emit::body::Body;
use crate::emit::context::{Coefficients, Context};
use crate::emit::description;
use crate::emit::number::number;
use crate::emit::pattern::{held, pattern};

/// The implementation of the capability.
pub(super) fn implementation(context: &Context, form: &TwoPolar) -> TokenStream {
    let Some(ratios) = &form.ratios else { return TokenStream::new() };
    let (rt, t) = (&context.names.rt, &context.names.scalar);
    let size = number(ratios.state.len());
    let used = ratios.program.inputs();
    let bound = pattern(&ratios.state, &used);
    let (read, couplings) = held(&ratios.couplings, &used, "couplings");
    let Body { lets, results } = context.generic(&ratios.program, Coefficients::Own);
    let operations = description::operations(context, ratios.program.operations());
    let items = quote! {
        const RATIO_OPERATIONS: #rt::Operations = #operations;
        type Ratios<#t: #rt::Scalar> = [#t; #size];

        #[inline]
        fn ratio_equations<#t: #rt::Scalar>(
            &self,
            #couplings: &Self::Couplings<#t>,
            state: &Self::Ratios<#t>,
        ) -> Self::Ratios<#t> {
            #read
            let #bound = *state;
            #lets
            [#(#results),*]
        }
    };
    context.implementation("RatioForm", &items)
}
