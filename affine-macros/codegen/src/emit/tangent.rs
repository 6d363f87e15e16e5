//! `emit(tangent)`: the variational equations.

use proc_macro2::TokenStream;
use quote::quote;

use crate::symbol::{Aspect, Symbol};

use super::body::Body;
use super::context::{Coefficients, Context};
use super::groups::group;
use super::number::number;
use super::pattern::{pattern, reads, time};
use super::trajectory;

/// The implementation of the capability.
pub(super) fn implementation(context: &Context) -> TokenStream {
    let Some(program) = &context.model.methods.tangent else { return TokenStream::new() };
    let (prepared, rt, n) = (&context.names.prepared, &context.names.rt, context.dim());
    let (generics, types, clause) = context.generics();
    let t = &context.names.scalar;
    let groups = context.model.dynamics.reduced.groups.iter().map(|(quantity, components)| {
        let len = number(components.len());
        group(context, *quantity, &len)
    });
    let groups: Vec<TokenStream> = groups.collect();
    let mut states = context.model.dynamics.reduced.symbols();
    let (len, both) = (number(states.len()), number(2 * states.len()));
    let changes = |of: &[Symbol]| of.iter().map(|s| s.clone().seen(Aspect::Change)).collect::<Vec<_>>();
    states.extend(changes(&states));
    let used = program.inputs();
    let coefficients = trajectory::all(context);
    let part = |names: &[Symbol], part: TokenStream| {
        reads(&used, names).then(|| {
            let bound = pattern(names, &used);
            quote!(let #bound = constants.coefficients.map(|coefficient| coefficient.#part);)
        })
    };
    let (values, slopes) = (part(&coefficients, quote!(value)), part(&changes(&coefficients), quote!(slope)));
    let constants = if values.is_some() || slopes.is_some() { quote!(constants) } else { quote!(_constants) };
    let bound = pattern(&states, &used);
    let clock = time(program);
    let Body { lets, results } = context.generic(program, Coefficients::Own);
    quote! {
        impl #generics #rt::Tangent<#n> for #prepared #types #clause {
            type Varied<#t: #rt::Scalar> = [#t; #both];
            const VARIED: &'static [#rt::Group] =
                &[#(#groups,)* #rt::Group::new(#rt::Quantity::TangentVector, #len)];

            #[inline]
            fn variational_equations<#t: #rt::Scalar>(
                &self,
                #clock: #t,
                #constants: &Self::Constants<#rt::Dual<#t>>,
                varied: &Self::Varied<#t>,
            ) -> Self::Varied<#t> {
                let #bound = *varied;
                #values
                #slopes
                #lets
                [#(#results),*]
            }
        }
    }
}
