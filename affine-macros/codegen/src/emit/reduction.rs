//! Reduction, reduced equations and expansion.

mod methods;
mod plain;

use proc_macro2::TokenStream;
use quote::quote;

use crate::algebra::passage::{Passage, Statement, Tensor, Word};
use crate::symbol::{Quantity, Symbol};

use super::body::Body;
use super::context::{Coefficients, Context};
use super::parametric::{Method, asks_again};
use super::passage::{any, frame_of, programs, statements, value, variable};
use super::pattern::{bound, identifiers, pattern, time};
use super::point::wrapper;
use super::trajectory;

/// The constants of a trajectory as a struct, where there are any.
pub(super) fn constants_type(context: &Context) -> TokenStream {
    let (name, t) = (&context.names.constants, &context.names.scalar);
    let kept = trajectory::kept(context, &[]);
    if kept.is_empty() {
        return TokenStream::new();
    }
    let fields = kept.iter().map(|kept| kept.field(context));
    let visibility = &context.spec.item.visibility;
    let doc = format!(" What one trajectory of [`{}`] conserves.", context.names.model);
    quote! {
        #[doc = #doc]
        #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]
        #visibility struct #name<#t> { #(#fields)* }
    }
}

/// `reduce`, `reduced_equations`, `expand`, `renewed`.
pub(super) fn methods(context: &Context) -> [Method; 4] {
    let passage = &context.model.dynamics.passage;
    let is_plain = plain::is_plain(context, passage);
    let (reduce, equations, expand) = match is_plain {
        true => (plain::reduce(context), plain::equations(context), plain::expand(context)),
        false => (reduce(context, passage), reduced_equations(context), expand(context, passage)),
    };
    let renewed = (!is_plain && !passage.renewed.is_empty()).then(|| renewed(context, &passage.renewed));
    let equations =
        if asks_again(context) { Method::Evaluation(equations) } else { Method::Other(equations) };
    let renewed = Method::Other(renewed.unwrap_or_default());
    [Method::Evaluation(reduce), equations, Method::Evaluation(expand), renewed]
}

/// `reduce`: what moves in closed form is taken out, and space is turned.
fn reduce(context: &Context, passage: &Passage) -> TokenStream {
    let t = &context.names.scalar;
    let reduced = &context.model.dynamics.reduced;
    let program = &context.model.dynamics.trajectory;
    let used = [reduced.symbols(), program.inputs(), passage.fixed()].concat();
    let lets = statements(context, &passage.inward, &used);
    let Body { lets: coefficients, results } = context.generic(program, Coefficients::Given);
    let work = reduced.has(Quantity::Work).then(|| quote!(let work = #t::zero();));
    let state = identifiers(&reduced.symbols());
    let constants = trajectory::at_the_start(context, &results);
    let starts = passage.constants.iter().any(|constant| constant.name == Word::Start)
        || any(&passage.inward, |part| *part == Tensor::Variable(Word::Start));
    let origin = if starts { quote!(t0) } else { quote!(_t0) };
    let inward = context.inward(Coefficients::Given);
    let evaluated = [vec![program.clone()], programs(context, &passage.inward)].concat();
    let body = quote!(#inward #lets #coefficients #work ([#(#state),*], #constants));
    methods::reduce(context, &evaluated, &origin, &body)
}

fn reduced_equations(context: &Context) -> TokenStream {
    let program = &context.model.dynamics.reduced.program;
    let used = program.inputs();
    let all = context.model.dynamics.reduced.symbols();
    let (bind, state) = bound(&all, &used, "reduced");
    let kept = trajectory::all(context);
    let coefficients = pattern(&kept, &used);
    let read = (!kept.is_empty()).then(|| quote!(let #coefficients = constants.coefficients;));
    let constants = if kept.is_empty() { quote!(_constants) } else { quote!(constants) };
    let Body { lets, results } = context.generic(program, Coefficients::Given);
    let body = quote!(#read #bind #lets [#(#results),*]);
    methods::equations(context, [time(program), constants, quote!(#state)], &body)
}

/// `expand`: what moves in closed form is put back, and space turned back.
fn expand(context: &Context, passage: &Passage) -> TokenStream {
    let (rt, t) = (&context.names.rt, &context.names.scalar);
    let all = context.model.dynamics.reduced.symbols();
    // No phase point holds the work, and what is carried along follows from phi.
    let follows = |symbol: &Symbol| {
        *symbol == Quantity::Work.into()
            || passage.renewed.iter().any(|one| matches!(one, Statement::Symbol(known, _) if known == symbol))
    };
    let needed: Vec<Symbol> = all.iter().filter(|symbol| !follows(symbol)).cloned().collect();
    let bound = pattern(&all, &needed);
    let lets = statements(context, &passage.outward, &all);
    let spin = passage.momentum.as_ref().map(|(quantity, momentum)| {
        let (wrapper, momentum) = (wrapper(context, frame_of(*quantity)), value(context, momentum));
        quote!(#wrapper(#momentum))
    });
    let centre = match &passage.centre {
        Some(both) => {
            let fields = [Word::Position, Word::LinearMomentum].into_iter().zip(both);
            let fields = fields.map(|(word, of)| field(context, word, of));
            quote!(#rt::Centre { #(#fields),* })
        }
        None => quote!(#rt::Pinned),
    };
    let of_point =
        passage.momentum.iter().map(|(_, momentum)| momentum).chain(passage.centre.iter().flatten());
    let outside = of_point.map(|value| Statement::Named(Word::Momentum, value.clone()));
    let read: Vec<Statement> = passage.outward.iter().cloned().chain(outside).collect();
    let time = if any(&read, |part| *part == Tensor::Time) { quote!(t) } else { quote!(_t) };
    let constants = match any(&read, |part| matches!(part, Tensor::Constant(_))) {
        true => quote!(constants),
        false => quote!(_constants),
    };
    let point = quote!(#rt::point(phi, #spin, #centre));
    let point = context.outward(&quote!(#t), point, Coefficients::Given);
    let evaluated = programs(context, &passage.outward);
    methods::expand(context, &evaluated, [time, constants], &quote!(let #bound = *reduced; #lets #point))
}

/// A field of a struct, whose name stands alone where the value is a variable of that name.
fn field(context: &Context, word: Word, of: &Tensor) -> TokenStream {
    let name = variable(word);
    if *of == Tensor::Variable(word) {
        return quote!(#name);
    }
    let value = value(context, of);
    quote!(#name: #value)
}

/// The state with what it carries along from the rest of it.
fn renewed(context: &Context, carried: &[Statement]) -> TokenStream {
    let (rt, t) = (&context.names.rt, &context.names.scalar);
    let all = context.model.dynamics.reduced.symbols();
    let names = identifiers(&all);
    let is_carried = |symbol: &Symbol| {
        carried.iter().any(|one| matches!(one, Statement::Symbol(known, _) if known == symbol))
    };
    let kept: Vec<Symbol> = all.iter().filter(|symbol| !is_carried(symbol)).cloned().collect();
    let bound = pattern(&all, &kept);
    let lets = statements(context, carried, &all);
    quote! {
        fn renewed<#t: #rt::Real>(&self, reduced: &Self::Reduced<#t>) -> Self::Reduced<#t> {
            let #bound = *reduced;
            #lets
            [#(#names),*]
        }
    }
}
