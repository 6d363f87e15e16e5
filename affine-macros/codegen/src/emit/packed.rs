//! The reduced equations in vectors of four.

mod names;
mod writer;

use proc_macro2::TokenStream;
use quote::quote;

use crate::ir::packed::Packed;

use super::context::Context;
use super::number::number;
use super::pattern::{identifiers, time};
use super::trajectory;

/// The implementation of the capability.
pub(super) fn implementation(context: &Context) -> TokenStream {
    let Some(packed) = &context.model.methods.packed else { return TokenStream::new() };
    let rt = &context.names.rt;
    let size = number(4 * packed.state.len());
    let change = change_of_storage(context, packed);
    let equations = equations(context, packed);
    let items = quote! {
        type Packed = #rt::Packed<#size>;
        #change
        #equations
    };
    context.implementation("PackedEquations", &items)
}

/// `packed` and `unpacked`.
fn change_of_storage(context: &Context, packed: &Packed) -> TokenStream {
    let rt = &context.names.rt;
    let all = identifiers(&context.model.dynamics.reduced.symbols());
    let lanes: Vec<Option<usize>> = packed.state.iter().flatten().copied().collect();
    let filled = lanes.iter().map(|lane| match lane {
        Some(component) => {
            let name = &all[*component];
            quote!(#name)
        }
        None => quote!(0.0),
    });
    // A component that stands in several lanes is read from the first.
    let bound = lanes.iter().enumerate().map(|(k, lane)| match lane {
        Some(component) if !lanes[..k].contains(lane) => {
            let name = &all[*component];
            quote!(#name)
        }
        _ => quote!(_),
    });
    quote! {
        #[inline(always)]
        fn packed(state: &Self::Reduced<#rt::f64>) -> Self::Packed {
            let [#(#all),*] = *state;
            #rt::Packed([#(#filled),*])
        }

        #[inline(always)]
        fn unpacked(packed: &Self::Packed) -> Self::Reduced<#rt::f64> {
            let [#(#bound),*] = packed.0;
            [#(#all),*]
        }
    }
}

fn equations(context: &Context, packed: &Packed) -> TokenStream {
    let rt = &context.names.rt;
    let program = packed.read();
    let used = program.inputs();
    let (read, constants) = trajectory::coefficients(context, &used);
    let clock = time(&program);
    let written = writer::written(context, packed);
    let (state, lets, rates) = (&written.state, &written.lets, &written.rates);
    let all = written.broadcasts.then(|| quote!(let all = |value| #rt::Four::of(vectors, [value; 4]);));
    let four = written.gathers.then(|| quote!(let four = |lanes| #rt::Four::of(vectors, lanes);));
    quote! {
        #[inline(always)]
        fn packed_equations(
            &self,
            vectors: impl #rt::Vectors,
            #clock: #rt::f64,
            #constants: &Self::Constants<#rt::f64>,
            packed: &Self::Packed,
        ) -> Self::Packed {
            #all
            #four
            #read
            let [#(#state),*] = packed.vectors(vectors);
            #lets
            #rt::Packed::of([#(#rates),*])
        }
    }
}
