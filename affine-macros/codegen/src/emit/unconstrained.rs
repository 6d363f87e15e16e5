//! The equations of a body without its constraint.

use proc_macro2::TokenStream;
use quote::quote;

use super::body::Body;
use super::context::Context;
use super::groups::groups;
use super::number::number;
use super::pattern::{pattern, time};

/// The implementation of the capability.
pub(super) fn implementation(context: &Context) -> TokenStream {
    let Some(equations) = &context.model.methods.unconstrained else { return TokenStream::new() };
    let (prepared, rt) = (&context.names.prepared, &context.names.rt);
    let (generics, types, clause) = context.generics();
    let (symbols, clock) = (equations.symbols(), time(&equations.program));
    let (size, layout) = (number(symbols.len()), groups(context, &equations.groups));
    let bound = pattern(&symbols, &equations.program.inputs());
    let Body { lets, results } = context.double(&equations.program);
    quote! {
        impl #generics #rt::Unconstrained for #prepared #types #clause {
            type State = [#rt::f64; #size];
            const GROUPS: &'static [#rt::Group] = #layout;

            fn rates(&self, #clock: #rt::f64, state: &Self::State) -> Self::State {
                let #bound = *state;
                #lets
                [#(#results),*]
            }
        }
    }
}
