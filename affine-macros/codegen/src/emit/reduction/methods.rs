//! The methods of a reduction around their bodies.

use proc_macro2::TokenStream;
use quote::quote;

use crate::emit::context::Context;
use crate::emit::parametric::{Evaluation, equations_head};
use crate::ir::Program;

/// `reduce`, which evaluates these programs, with the name of its time.
pub(super) fn reduce(
    context: &Context,
    evaluated: &[Program],
    origin: &TokenStream,
    body: &TokenStream,
) -> TokenStream {
    let (rt, t) = (&context.names.rt, &context.names.scalar);
    let Evaluation { name, parameter } = Evaluation::of_points(context, "reduce", evaluated);
    quote! {
        fn #name<#t: #rt::Real>(
            &self,
            #parameter
            #origin: #t,
            point: &Self::Point<#t>,
        ) -> (Self::Reduced<#t>, Self::Constants<#t>) {
            #body
        }
    }
}

/// `reduced_equations`, with the names of its time, constants and state.
pub(super) fn equations(
    context: &Context,
    [time, constants, state]: [TokenStream; 3],
    body: &TokenStream,
) -> TokenStream {
    let (rt, t, inline) = (&context.names.rt, &context.names.scalar, context.inline());
    let (name, parameter) = equations_head(context);
    quote! {
        #inline
        fn #name<#t: #rt::Scalar>(
            &self,
            #parameter
            #time: #t,
            #constants: &Self::Constants<#t>,
            #state: &Self::Reduced<#t>,
        ) -> Self::Reduced<#t> {
            #body
        }
    }
}

/// `expand`, which evaluates these programs, with the names of its time and constants.
pub(super) fn expand(
    context: &Context,
    evaluated: &[Program],
    [time, constants]: [TokenStream; 2],
    body: &TokenStream,
) -> TokenStream {
    let (rt, t) = (&context.names.rt, &context.names.scalar);
    let Evaluation { name, parameter } = Evaluation::of_points(context, "expand", evaluated);
    quote! {
        fn #name<#t: #rt::Real>(
            &self,
            #parameter
            #time: #t,
            #constants: &Self::Constants<#t>,
            reduced: &Self::Reduced<#t>,
        ) -> Self::Point<#t> {
            #body
        }
    }
}
