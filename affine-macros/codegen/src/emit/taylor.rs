//! `emit(taylor)`: the recurrence of Taylor coefficients, order by order.

mod columns;
mod convolutions;
mod reads;
mod rows;
mod rules;
mod writer;

use crate::algebra::fault::never_missing;
use proc_macro2::TokenStream;
use quote::quote;

use crate::ir::Value;
use crate::ir::taylor::Rule;

use super::body::Body;
use super::context::{Coefficients, Context};
use super::number::number;
use writer::Writer;

/// The implementation of the capability.
pub(super) fn taylor_impl(context: &Context) -> TokenStream {
    let Some(recurrence) = &context.model.methods.taylor else { return TokenStream::new() };
    let rt = &context.names.rt;
    let t = &context.names.scalar;
    let slots = number(recurrence.row.len());
    let mut writer = Writer { context, recurrence, fixed: Vec::new() };
    let (columns, start, ready, next) = (writer.columns(), writer.start(), writer.ready(), writer.next());
    let roots = recurrence.has_roots();
    let items = quote! {
        type Row<#t: #rt::Scalar> = [#t; #slots];
        const ROOTS: ::core::primitive::bool = #roots;
        #columns
        #start
        #ready
        #next
    };
    context.implementation("Taylor", &items)
}

impl Writer<'_> {
    /// `start`: order zero of the row, and the slope.
    fn start(&self) -> TokenStream {
        let (rt, t) = (&self.context.names.rt, &self.context.names.scalar);
        let program = &self.recurrence.start;
        let time = super::pattern::time(program);
        let (read, constants) = self.constants(program);
        let (bind, state) = self.bind(&program.inputs(), "state");
        let Body { lets, results } = self.context.generic(program, Coefficients::Own);
        let (rates, kept) = results.split_at(self.recurrence.program.outputs.len());
        let mut kept = kept.iter();
        let entries = self.recurrence.row.iter().map(|series| match series {
            Some(series) if !series.rate => never_missing(
                kept.next().cloned(),
                "every series that is kept has a start",
                quote!(#t::zero()),
            ),
            _ => quote!(#t::zero()),
        });
        quote! {
            #[inline(always)]
            fn start<#t: #rt::Scalar>(
                &self,
                #time: #t,
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
        let (bind, coefficient) = self.bind(&states, "coefficient");
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
        let order = if recurrence.reads_order() { quote!(order) } else { quote!(_) };
        let moves = recurrence.program.outputs.iter().any(|(_, v)| recurrence.moving[*v])
            || recurrence.rules.iter().any(|(_, rule)| matches!(rule, Rule::Time));
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
}
