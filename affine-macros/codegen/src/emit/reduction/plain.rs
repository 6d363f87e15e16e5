//! A reduction that takes nothing out: the reduced state is the plain array.

use proc_macro2::TokenStream;
use quote::quote;

use crate::derive::Trajectory;
use crate::emit::body::Body;
use crate::emit::context::Context;
use crate::emit::dynamics::has_multiplier;

/// Are the reduced equations those of the plain array, and the constants at most their coefficients?
pub(super) fn is_plain(context: &Context, parts: &Trajectory) -> bool {
    let nothing_moves_apart = !parts.origin && !parts.turn && parts.dilatation.is_none();
    let nothing_is_constant = !parts.linear && !parts.conserved && parts.fixed.is_empty();
    context.model.full == context.model.reduced && nothing_moves_apart && nothing_is_constant
}

/// `reduce`, `reduced_equations` and `expand`, by the methods of the plain array.
pub(super) fn methods(context: &Context, parts: &Trajectory) -> TokenStream {
    let (rt, t, constants) = (&context.names.rt, &context.names.scalar, &context.names.constants);
    let Body { lets, results } = context.generic(&context.model.trajectory);
    let fields = match parts.coefficients {
        0 => quote!(scalar: ::core::marker::PhantomData),
        _ => quote!(coefficients: [#(#results),*]),
    };
    let equations = if has_multiplier(context) { quote!(free_equations) } else { quote!(hamilton_equations) };
    let inline = context.inline();
    quote! {
        fn reduce<#t: #rt::Real>(
            &self,
            _t0: #t,
            point: &Self::Point<#t>,
        ) -> (Self::Reduced<#t>, Self::Constants<#t>) {
            #lets
            (#rt::Model::flatten(self, point), #constants { #fields })
        }

        #inline
        fn reduced_equations<#t: #rt::Scalar>(
            &self,
            t: #t,
            _constants: &Self::Constants<#t>,
            reduced: &Self::Reduced<#t>,
        ) -> Self::Reduced<#t> {
            #rt::Model::#equations(self, t, reduced)
        }

        fn expand<#t: #rt::Real>(
            &self,
            _t: #t,
            _constants: &Self::Constants<#t>,
            reduced: &Self::Reduced<#t>,
        ) -> Self::Point<#t> {
            #rt::Model::unflatten(self, reduced)
        }
    }
}
