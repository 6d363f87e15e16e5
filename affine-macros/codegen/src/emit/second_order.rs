//! `emit(nystrom)`: the equations as `q' = V(p)`, `p' = F(t, q)`.

use proc_macro2::TokenStream;
use quote::quote;

use crate::derive::second_order::Halves;
use crate::ir::Program;
use crate::symbol::Symbol;

use super::body::Body;
use super::context::{Coefficients, Context};
use super::number::number;
use super::pattern::{pattern, reads, time};
use super::trajectory::coefficients;

/// The implementation of the capability.
pub(super) fn implementation(context: &Context) -> TokenStream {
    let Some(Halves { positions, momenta, velocity, force }) = &context.model.methods.second_order else {
        return TokenStream::new();
    };
    let rt = &context.names.rt;
    let (t, size, clock) = (&context.names.scalar, number(positions.len()), time(force));
    let (velocity_constants, velocity) = written(context, velocity, (momenta, quote!(momenta)));
    let (force_constants, force) = written(context, force, (positions, quote!(positions)));
    let items = quote! {
        type Half<#t: #rt::Scalar> = [#t; #size];

        #[inline(always)]
        fn drift<#t: #rt::Scalar>(
            &self,
            #velocity_constants: &Self::Constants<#t>,
            momenta: &Self::Half<#t>,
        ) -> Self::Half<#t> {
            #velocity
        }

        #[inline(always)]
        fn force<#t: #rt::Scalar>(
            &self,
            #clock: #t,
            #force_constants: &Self::Constants<#t>,
            positions: &Self::Half<#t>,
        ) -> Self::Half<#t> {
            #force
        }
    };
    context.implementation("SecondOrderEquations", &items)
}

/// A program over one half, and the name of the constants that it reads.
fn written(
    context: &Context,
    program: &Program,
    (names, half): (&[Symbol], TokenStream),
) -> (TokenStream, TokenStream) {
    let used = program.inputs();
    let (read, constants) = coefficients(context, &used);
    let bind = match reads(&used, names) {
        true => {
            let bound = pattern(names, &used);
            quote!(let #bound = *#half;)
        }
        false => quote!(let _ = #half;),
    };
    let Body { lets, results } = context.generic(program, Coefficients::Own);
    (constants, quote!(#read #bind #lets [#(#results),*]))
}
