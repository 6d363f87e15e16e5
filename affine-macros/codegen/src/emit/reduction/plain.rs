//! A reduction that takes nothing out: the reduced state is the plain array.

use std::slice;

use proc_macro2::TokenStream;
use quote::quote;

use crate::algebra::passage::Passage;
use crate::emit::body::Body;
use crate::emit::context::{Coefficients, Context};
use crate::emit::parametric::asks_again;
use crate::emit::trajectory;

use super::methods;

/// Are the reduced equations those of the plain array, and the constants at most their coefficients?
pub(super) fn is_plain(context: &Context, passage: &Passage) -> bool {
    context.model.dynamics.full == context.model.dynamics.reduced && passage.constants.is_empty()
}

/// `reduce`: the plain array.
pub(super) fn reduce(context: &Context) -> TokenStream {
    let rt = &context.names.rt;
    let program = &context.model.dynamics.trajectory;
    let Body { lets, results } = context.generic(program, Coefficients::Given);
    let constants = trajectory::at_the_start(context, &results);
    let flat = match context.has_prepared_bases() {
        true => quote!(#rt::Parametric::flatten_with(self, coefficients, point)),
        false => quote!(#rt::Model::flatten(self, point)),
    };
    let body = quote!(#lets (#flat, #constants));
    methods::reduce(context, slice::from_ref(program), &quote!(_t0), &body)
}

/// `reduced_equations`: Hamilton's equations.
pub(super) fn equations(context: &Context) -> TokenStream {
    let rt = &context.names.rt;
    let equations = match asks_again(context) {
        true => quote!(#rt::Parametric::hamilton_equations_with(self, coefficients, t, reduced)),
        false => quote!(#rt::Model::hamilton_equations(self, t, reduced)),
    };
    methods::equations(context, [quote!(t), quote!(_constants), quote!(reduced)], &equations)
}

/// `expand`: the point of the plain array.
pub(super) fn expand(context: &Context) -> TokenStream {
    let rt = &context.names.rt;
    let point = match context.has_prepared_bases() {
        true => quote!(#rt::Parametric::unflatten_with(self, coefficients, reduced)),
        false => quote!(#rt::Model::unflatten(self, reduced)),
    };
    methods::expand(context, &[], [quote!(_t), quote!(_constants)], &point)
}
