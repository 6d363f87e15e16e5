//! A reduction that takes nothing out: the reduced state is the plain array.

use std::slice;

use proc_macro2::TokenStream;
use quote::quote;

use crate::algebra::passage::Passage;
use crate::emit::body::Body;
use crate::emit::context::{Coefficients, Context};
use crate::emit::parametric::{Evaluation, equations_head};
use crate::emit::trajectory;

/// Are the reduced equations those of the plain array, and the constants at most their coefficients?
pub(super) fn is_plain(context: &Context, passage: &Passage) -> bool {
    context.model.dynamics.full == context.model.dynamics.reduced && passage.constants.is_empty()
}

/// `reduce`: the plain array.
pub(super) fn reduce(context: &Context) -> TokenStream {
    let (rt, t) = (&context.names.rt, &context.names.scalar);
    let program = &context.model.dynamics.trajectory;
    let Body { lets, results } = context.generic(program, Coefficients::Given);
    let constants = trajectory::at_the_start(context, &results);
    let Evaluation { name, parameter } = Evaluation::of_points(context, "reduce", slice::from_ref(program));
    let flat = match context.has_prepared_bases() {
        true => quote!(#rt::Parametric::flatten_with(self, coefficients, point)),
        false => quote!(#rt::Model::flatten(self, point)),
    };
    quote! {
        fn #name<#t: #rt::Real>(
            &self,
            #parameter
            _t0: #t,
            point: &Self::Point<#t>,
        ) -> (Self::Reduced<#t>, Self::Constants<#t>) {
            #lets
            (#flat, #constants)
        }
    }
}

/// `reduced_equations`: Hamilton's equations.
pub(super) fn equations(context: &Context) -> TokenStream {
    let (rt, t, inline) = (&context.names.rt, &context.names.scalar, context.inline());
    let (name, parameter) = equations_head(context);
    let equations = match parameter {
        Some(_) => quote!(#rt::Parametric::hamilton_equations_with(self, coefficients, t, reduced)),
        None => quote!(#rt::Model::hamilton_equations(self, t, reduced)),
    };
    quote! {
        #inline
        fn #name<#t: #rt::Scalar>(
            &self,
            #parameter
            t: #t,
            _constants: &Self::Constants<#t>,
            reduced: &Self::Reduced<#t>,
        ) -> Self::Reduced<#t> {
            #equations
        }
    }
}

/// `expand`: the point of the plain array.
pub(super) fn expand(context: &Context) -> TokenStream {
    let (rt, t) = (&context.names.rt, &context.names.scalar);
    let Evaluation { name, parameter } = Evaluation::of_points(context, "expand", &[]);
    let point = match context.has_prepared_bases() {
        true => quote!(#rt::Parametric::unflatten_with(self, coefficients, reduced)),
        false => quote!(#rt::Model::unflatten(self, reduced)),
    };
    quote! {
        fn #name<#t: #rt::Real>(
            &self,
            #parameter
            _t: #t,
            _constants: &Self::Constants<#t>,
            reduced: &Self::Reduced<#t>,
        ) -> Self::Point<#t> {
            #point
        }
    }
}
