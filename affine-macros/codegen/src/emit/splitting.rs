//! `emit(splitting)`: the exact flows of the pieces.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use crate::algebra::passage::DilatationalMotion;
use crate::derive::splitting::{FlowProgram, Programs};
use crate::ir::{Op, Program, Value};
use crate::symbol::Symbol;

use super::body::Body;
use super::context::{Coefficients, Context};
use super::expression::inner;
use super::number::number;
use super::passage::closed_form;
use super::pattern::{self, identifiers, in_rows, table};
use super::trajectory::{self, coefficients};

/// The implementation of the capability.
pub(super) fn splitting_impl(context: &Context) -> TokenStream {
    let Some(Programs { pieces, nystrom, .. }) = &context.model.methods.splitting else {
        return TokenStream::new();
    };
    let (rt, t, inline) = (&context.names.rt, &context.names.scalar, context.inline());
    let names = pieces.iter().map(|(name, _)| name);
    let bodies: Vec<TokenStream> =
        pieces.iter().map(|(_, flows)| flows.iter().map(|flow| written(context, flow)).collect()).collect();
    let moves = [quote!(h), quote!(state), quote!(carry)];
    let (body, piece, [h, state, carry]) = match bodies.as_slice() {
        // All that moves does so in closed form.
        [] => (TokenStream::new(), quote!(_piece), [quote!(_h), quote!(_state), quote!(_carry)]),
        [only] => (only.clone(), quote!(_piece), moves),
        several => (chosen(several), quote!(piece), moves),
    };
    let programs = || pieces.iter().flat_map(|(_, flows)| flows).map(FlowProgram::program);
    let dilates = context.model.description.dilates.then(|| {
        quote!(
            const DILATES: ::core::primitive::bool = true;
        )
    });
    let is_read = |symbol: &Symbol| programs().any(|program| program.symbols().any(|read| read == symbol));
    let time = if programs().any(Program::reads_time) { quote!(t) } else { quote!(_t) };
    let constants = match trajectory::all(context).iter().any(is_read) {
        true => quote!(constants),
        false => quote!(_constants),
    };
    let items = quote! {
        const PIECES: &'static [&'static ::core::primitive::str] = &[#(#names),*];
        const NYSTROM: ::core::primitive::bool = #nystrom;
        #dilates

        #inline
        fn flow<#t: #rt::Real>(
            &self,
            #piece: #rt::usize,
            #time: #t,
            #h: #t,
            #constants: &Self::Constants<#t>,
            #state: &mut Self::Reduced<#t>,
            #carry: &mut Self::Reduced<#t>,
        ) {
            #body
        }
    };
    context.implementation("Splitting", &items)
}

/// The flow of the piece that is asked for. There is no other than those that are counted.
pub(super) fn chosen(flows: &[TokenStream]) -> TokenStream {
    let arms = flows.iter().enumerate().map(|(k, flow)| {
        let piece = number(k);
        let place = if k + 1 == flows.len() { quote!(_) } else { quote!(#piece) };
        quote!(#place => { #flow })
    });
    quote!(match piece { #(#arms)* })
}

/// Results that stand in products: several are names or numbers, a single one may be a sum and gets a name.
pub(super) fn as_factors(results: Vec<TokenStream>) -> (TokenStream, Vec<TokenStream>) {
    match results.as_slice() {
        [one] => (quote!(let rate = #one;), vec![quote!(rate)]),
        _ => (TokenStream::new(), results),
    }
}

/// What a flow reads: components of the state, besides `more`, and coefficients of the trajectory.
fn bound(context: &Context, program: &Program, more: &[Symbol]) -> TokenStream {
    let mut used = program.inputs();
    let (read, _) = coefficients(context, &used);
    used.extend(more.iter().cloned());
    let states = context.model.dynamics.reduced.symbols();
    let (bind, _) = pattern::bound(&states, &used, "state");
    quote!(#read #bind)
}

/// Adds to a component of the state.
fn accumulated(context: &Context, component: &Symbol, rise: TokenStream) -> TokenStream {
    let at = place(&context.model.dynamics.reduced.symbols(), component);
    added_at(context, &at, rise)
}

/// The place of a component in a state.
pub(super) fn place(state: &[Symbol], component: &Symbol) -> Literal {
    number(state.iter().position(|name| name == component).unwrap_or(0))
}

/// Adds to what stands at a place.
pub(super) fn added_at(context: &Context, at: &Literal, rise: TokenStream) -> TokenStream {
    let rt = &context.names.rt;
    quote!(#rt::accumulate(&mut state[#at], &mut carry[#at], #rise);)
}

fn written(context: &Context, flow: &FlowProgram) -> TokenStream {
    match flow {
        FlowProgram::Shift { moved, program } | FlowProgram::Rise { moved, program } => {
            let over_time = matches!(flow, FlowProgram::Shift { .. }).then(|| quote!(h *));
            let bind = bound(context, program, &[]);
            let Body { lets, results } = context.generic(program, Coefficients::Own);
            let (only, results) = as_factors(results);
            let rises = moved
                .iter()
                .zip(&results)
                .map(|(name, rate)| accumulated(context, name, quote!(#over_time #rate)));
            quote!({ #bind #lets #only #(#rises)* })
        }
        FlowProgram::Dilatation { placement, momentum, motion, program } => {
            dilated(context, [placement, momentum], *motion, program)
        }
        FlowProgram::Exponential { placement, momentum, right, program } => {
            let rt = &context.names.rt;
            let bind = bound(context, program, &placement.concat());
            let Body { lets, results } = context.generic(program, Coefficients::Own);
            let (generator, turning) = results.split_at(context.model.dim.pow(2).min(results.len()));
            let zero = |v: Value| matches!(&program.steps[v], Op::Constant(c) if c.is_zero());
            let times = |sign: TokenStream| {
                let by = inner(quote!(*));
                let entries = generator.iter().zip(&program.outputs).map(|(entry, (_, v))| match zero(*v) {
                    true => entry.clone(),
                    false => quote!(#sign h #by #entry),
                });
                let rows = in_rows(&entries.collect::<Vec<_>>(), context.model.dim);
                quote!(#rt::growth(#rows))
            };
            let growth = times(quote!());
            let product = if *right { quote!(right_product) } else { quote!(left_product) };
            let matrix = table(placement);
            let placed = added(context, placement, "rise");
            let turned = momentum.as_ref().map(|momentum| {
                let inverse = times(quote!(-));
                let matrix = in_rows(turning, context.model.dim);
                let sides = match right {
                    true => quote!(&inverse, &growth),
                    false => quote!(&growth, &inverse),
                };
                let turned = added(context, momentum, "turned");
                quote! {
                    let inverse = #inverse;
                    let turned = #rt::conjugated(#matrix, #sides);
                    #turned
                }
            });
            quote!({
                #bind
                #lets
                let growth = #growth;
                let rise = #rt::#product(#matrix, &growth);
                #placed
                #turned
            })
        }
    }
}

/// `phi` grows by a factor, the trace of the momentum by what all entries of the diagonal share.
fn dilated(
    context: &Context,
    [placement, momentum]: [&[Vec<Symbol>]; 2],
    motion: DilatationalMotion,
    program: &Program,
) -> TokenStream {
    let rt = &context.names.rt;
    let diagonal: Vec<Symbol> =
        momentum.iter().enumerate().filter_map(|(a, row)| row.get(a).cloned()).collect();
    let bind = bound(context, program, &placement.concat());
    let Body { lets, results } = context.generic(program, Coefficients::Own);
    let (results, spin) = results.split_at(results.len().saturating_sub(context.model.dim));
    let path = closed_form(motion);
    let matrix = table(placement);
    let grown = placement.iter().flatten().zip(identifiers(&placement.concat()));
    let grown = grown.map(|(name, entry)| accumulated(context, name, quote!(#entry * growth)));
    let risen = diagonal.iter().map(|name| accumulated(context, name, quote!(rise)));
    quote!({
        #bind
        #lets
        let (growth, rise) = #rt::dilated(#matrix, [#(#spin),*], h, |t_start, q_start, p_start| {
            #rt::Breathing::#path(t_start, q_start, p_start, #(#results),*)
        });
        #(#grown)*
        #(#risen)*
    })
}

/// Adds the entries of a matrix to those components that the state has.
fn added(context: &Context, names: &[Vec<Symbol>], rise: &str) -> TokenStream {
    let rise = quote::format_ident!("{rise}");
    let entries =
        names.iter().enumerate().flat_map(|(i, row)| row.iter().enumerate().map(move |(j, n)| (i, j, n)));
    let states = context.model.dynamics.reduced.symbols();
    entries
        .filter(|(.., name)| states.contains(name))
        .map(|(i, j, name)| {
            let [i, j]: [Literal; 2] = [i, j].map(number);
            accumulated(context, name, quote!(#rise[#i][#j]))
        })
        .collect()
}
