//! `emit(taylor)`: the recurrence of Taylor coefficients, order by order.

mod columns;
mod convolutions;
mod reads;
mod rows;
mod rules;

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use crate::algebra::Function;
use crate::ir::taylor::{Recurrence, Rule, Series};
use crate::ir::{Program, Value};

use super::body::{Body, inputs};
use super::{Context, number, pattern};

/// The implementation of the capability.
pub(super) fn taylor_impl(context: &Context) -> TokenStream {
    let Some(recurrence) = &context.model.taylor else { return TokenStream::new() };
    let (prepared, rt, n) = (&context.names.prepared, &context.names.rt, context.dim());
    let (generics, types, clause) = context.generics();
    let t = &context.names.scalar;
    let slots = number(recurrence.row.len());
    let mut writer = Writer { context, recurrence, fixed: Vec::new() };
    let (columns, start, ready, next) = (writer.columns(), writer.start(), writer.ready(), writer.next());
    quote! {
        impl #generics #rt::Taylor<#n> for #prepared #types #clause {
            type Row<#t: #rt::Scalar> = [#t; #slots];
            #columns
            #start
            #ready
            #next
        }
    }
}

/// The hook by which a simulation finds the capability.
pub(super) fn capability(context: &Context) -> TokenStream {
    if context.model.taylor.is_none() {
        return TokenStream::new();
    }
    let rt = &context.names.rt;
    quote! {
        fn taylor(
            &self,
        ) -> ::core::option::Option<impl #rt::Series<Self::Reduced<#rt::f64>, Self::Constants<#rt::f64>>> {
            ::core::option::Option::Some(#rt::Emitted(self))
        }
    }
}

struct Writer<'a> {
    context: &'a Context<'a>,
    recurrence: &'a Recurrence,
    /// Values that do not move and that rules read, with their expressions.
    fixed: Vec<(Value, TokenStream)>,
}

impl Writer<'_> {
    fn states(&self) -> Vec<String> {
        self.context.model.reduced.groups.iter().flat_map(|(_, names)| names.clone()).collect()
    }

    /// `let [k_1, ..] = constants.coefficients;`, and the parameter.
    fn constants(&self, program: &Program) -> (TokenStream, TokenStream) {
        let used = inputs(program);
        let count = self.context.model.trajectory.outputs.len();
        let names: Vec<String> = (1..=count).map(|k| format!("k_{k}")).collect();
        if !names.iter().any(|name| used.contains(&name.as_str())) {
            return (TokenStream::new(), quote!(_constants));
        }
        let bound = pattern(&names, &used);
        (quote!(let #bound = constants.coefficients;), quote!(constants))
    }

    /// A state vector's components that are read, bound to their names, and the parameter.
    fn bind(&self, used: &[&str], from: &str) -> (TokenStream, TokenStream) {
        let names = self.states();
        if !names.iter().any(|name| used.contains(&name.as_str())) {
            let unused = format_ident!("_{from}");
            return (TokenStream::new(), quote!(#unused));
        }
        let (bound, from) = (pattern(&names, used), format_ident!("{from}"));
        (quote!(let #bound = *#from;), quote!(#from))
    }

    /// The program with other results.
    fn with_results(&self, results: impl Iterator<Item = Value>) -> Program {
        let mut program = self.recurrence.program.clone();
        program.outputs = results.map(|v| (self.name(v), v)).collect();
        program.without_dead_steps()
    }

    /// Name of a value: what the derivation calls it, or its number.
    fn name(&self, value: Value) -> String {
        self.recurrence.program.name(value)
    }

    fn ident(&self, value: Value) -> Ident {
        format_ident!("{}", self.name(value))
    }

    /// `start`: order zero of the row, and the slope.
    fn start(&self) -> TokenStream {
        let (rt, t) = (&self.context.names.rt, &self.context.names.scalar);
        let program = &self.recurrence.start;
        let (read, constants) = self.constants(program);
        let (bind, state) = self.bind(&inputs(program), "state");
        let Body { lets, results } = self.context.generic(program);
        let (rates, kept) = results.split_at(self.recurrence.program.outputs.len());
        let mut kept = kept.iter();
        let entries = self.recurrence.row.iter().map(|series| match series {
            Some(series) if !series.rate => kept.next().cloned().unwrap_or_default(),
            _ => quote!(#t::zero()),
        });
        quote! {
            #[inline(always)]
            fn start<#t: #rt::Scalar>(
                &self,
                _t: #t,
                #constants: &Self::Constants<#t>,
                #state: &Self::Reduced<#t>,
                row: &mut Self::Row<#t>,
            ) -> Self::Reduced<#t> {
                #read
                #bind
                #lets
                *row = [#(#entries),*];
                [#(#rates),*]
            }
        }
    }

    /// The values that do not move and that rules read, as statements; the parameter that they read.
    fn fix(&mut self, rules: &[&(Value, Rule)]) -> (TokenStream, TokenStream) {
        let values = reads::fixed(rules);
        let program = self.with_results(values.iter().copied());
        let (read, constants) = self.constants(&program);
        let Body { lets, results } = self.context.generic(&program);
        self.fixed = values.into_iter().zip(results).collect();
        let divisors = self.divisors(rules);
        (quote!(#read #lets #divisors), constants)
    }

    /// `next`: one order more.
    fn next(&mut self) -> TokenStream {
        let recurrence = self.recurrence;
        let (rt, t) = (&self.context.names.rt, &self.context.names.scalar);
        let unread = self.read_by_columns_alone();
        let late = recurrence.rules.iter().filter(|(v, _)| !recurrence.ready[*v] && !unread.contains(v));
        let late: Vec<&(Value, Rule)> = late.collect();
        let outputs = self.outputs_apart();
        let mut wanted: Vec<Value> = late.iter().flat_map(|(_, rule)| reads::of(rule)).collect();
        wanted.extend(self.late_slots().map(|(_, series)| series.value));
        wanted.extend(outputs);
        let rules: Vec<&(Value, Rule)> = self.ready_rules(&wanted).into_iter().chain(late).collect();
        let (fixed, constants) = self.fix(&rules);
        let states = self.states_among(&wanted, &rules);
        let (bind, coefficient) =
            self.bind(&states.iter().map(String::as_str).collect::<Vec<_>>(), "coefficient");
        let statements = rules.iter().map(|(value, rule)| self.statement(*value, rule));
        let (convolutions, stored) = (self.convolutions(), self.stored());
        let rates = recurrence.program.outputs.iter().map(|(_, v)| match recurrence.moving[*v] {
            true => {
                let rate = self.ident(*v);
                quote!(#rt::over(#rate, divisor))
            }
            false => quote!(#t::zero()),
        });
        let states = self.states();
        let coefficients =
            states.iter().zip(rates).map(|(state, rate)| self.column_entry(state).unwrap_or(rate));
        let none = self.no_columns();
        let (next_columns, advanced) = self.advanced_columns();
        let zeros = number(self.states().len());
        let named = match self.row_names() {
            (true, true) => Some(quote!([first, .., row])),
            (true, false) => Some(quote!([first, ..])),
            (false, true) => Some(quote!([.., row])),
            (false, false) => None,
        };
        let open =
            named.map(|named| quote!(let #named = rows else { return ([#t::zero(); #zeros], #none) };));
        let passes = recurrence.passes();
        let rows = if passes > 0 || open.is_some() { quote!(rows) } else { quote!(_rows) };
        let vectors = if passes > 0 { quote!(vectors) } else { quote!(_vectors) };
        let order = if self.reads_order() { quote!(order) } else { quote!(_) };
        let moves = recurrence.program.outputs.iter().any(|(_, v)| recurrence.moving[*v]);
        let divisor = if moves { quote!(divisor) } else { quote!(_) };
        quote! {
            #[inline(always)]
            fn next<#t: #rt::Scalar>(
                &self,
                #vectors: impl #rt::Vectors,
                (#order, #divisor): (#t, #rt::Divisor<#t>),
                #constants: &Self::Constants<#t>,
                #coefficient: &Self::Reduced<#t>,
                #rows: &mut [Self::Row<#t>],
            ) -> (Self::Reduced<#t>, Self::Columns<#t>) {
                #fixed
                #convolutions
                #open
                #bind
                #(#statements)*
                #stored
                #advanced
                ([#(#coefficients),*], #next_columns)
            }
        }
    }

    /// Rates that no column reads.
    fn outputs_apart(&self) -> Vec<Value> {
        let states = self.states();
        let outputs = states.iter().zip(&self.recurrence.program.outputs);
        let apart = outputs.filter(|(state, _)| self.column_entry(state).is_none());
        apart.map(|(_, (_, value))| *value).filter(|v| self.recurrence.moving[*v]).collect()
    }

    /// Rates that only columns read, as the sums that they are the lanes of.
    fn read_by_columns_alone(&self) -> Vec<Value> {
        let elsewhere: Vec<Value> =
            self.recurrence.rules.iter().flat_map(|(_, rule)| reads::of(rule)).collect();
        let in_row = |value: Value| self.recurrence.row.iter().flatten().any(|series| series.value == value);
        let apart = self.outputs_apart();
        let rates = self.recurrence.program.outputs.iter().map(|(_, value)| *value);
        rates.filter(|v| !elsewhere.contains(v) && !in_row(*v) && !apart.contains(v)).collect()
    }

    fn reads_order(&self) -> bool {
        let weighted = |rule: &Rule| matches!(rule, Rule::Function { function, .. } if !matches!(function, Function::Sqrt | Function::Abs));
        self.recurrence.rules.iter().any(|(_, rule)| weighted(rule))
            || self.recurrence.row.iter().flatten().any(|s| s.rate)
    }

    /// A series at order `k`.
    fn current(&self, series: Series) -> TokenStream {
        let value = self.ident(series.value);
        if series.rate { quote!(#value * order) } else { quote!(#value) }
    }
}
