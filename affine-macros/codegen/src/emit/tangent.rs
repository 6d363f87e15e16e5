//! `emit(tangent)`: the variational equations.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use crate::ir::Program;
use crate::symbol::{Aspect, Quantity, Symbol};

use super::body::Body;
use super::context::{Coefficients, Context};
use super::groups::each;
use super::number::number;
use super::pattern::{pattern, reads, time};
use super::trajectory;

/// The implementation of the capability.
pub(super) fn implementation(context: &Context) -> TokenStream {
    let Some(variational) = &context.model.methods.tangent else { return TokenStream::new() };
    let rt = &context.names.rt;
    let t = &context.names.scalar;
    let reduced = &context.model.dynamics.reduced;
    let (groups, states) = (each(context, &reduced.groups), reduced.symbols());
    let (len, both) = (number(states.len()), number(2 * states.len()));
    // Nothing depends on the work, which stands last: its change is not measured, as it is not itself.
    let work = reduced.groups.iter().filter(|(quantity, _)| *quantity == Quantity::Work);
    let work: Vec<_> = work.cloned().collect();
    let unmeasured = each(context, &work);
    let measured = number(states.len() - work.iter().map(|(_, symbols)| symbols.len()).sum::<usize>());
    let equations = match &variational.program {
        Some(program) => by_program(context, program, states),
        None => by_duals(context, &len),
    };
    let items = quote! {
        type Varied<#t: #rt::Scalar> = [#t; #both];
        const VARIED: &'static [#rt::Group] =
            &[#(#groups,)* #rt::Group::new(#rt::Quantity::TangentVector, #measured), #(#unmeasured),*];

        #[inline]
        #equations
    };
    context.implementation("Tangent", &items)
}

/// The equations over dual numbers.
fn by_duals(context: &Context, len: &Literal) -> TokenStream {
    let (rt, n, t) = (&context.names.rt, context.dim(), &context.names.scalar);
    quote! {
        fn variational_equations<#t: #rt::Scalar>(
            &self,
            t: #t,
            constants: &Self::Constants<#rt::Dual<#t>>,
            varied: &Self::Varied<#t>,
        ) -> Self::Varied<#t> {
            let state = ::core::array::from_fn(|k| #rt::Dual { value: varied[k], slope: varied[#len + k] });
            let rates =
                <Self as #rt::Model<#n>>::reduced_equations(self, #rt::Dual::fixed(t), constants, &state);
            ::core::array::from_fn(|k| if k < #len { rates[k].value } else { rates[k - #len].slope })
        }
    }
}

/// The derivative of the equations, operation by operation.
fn by_program(context: &Context, program: &Program, mut states: Vec<Symbol>) -> TokenStream {
    let (rt, t) = (&context.names.rt, &context.names.scalar);
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
