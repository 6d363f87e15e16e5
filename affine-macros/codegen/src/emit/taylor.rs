//! `emit(taylor)`: the recurrence of Taylor coefficients, order by order.

mod columns;
mod convolutions;
mod rules;

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use crate::algebra::Function;
use crate::ir::taylor::{Recurrence, Rule, Series, Term};
use crate::ir::{Op, Program, Value};

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
    let (columns, start, next) = (writer.columns(), writer.start(), writer.next());
    quote! {
        impl #generics #rt::Taylor<#n> for #prepared #types #clause {
            type Row<#t: #rt::Scalar> = [#t; #slots];
            #columns
            #start
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
        let program = &self.recurrence.program;
        if let Op::Input(name) = &program.steps[value] {
            return name.clone();
        }
        let named = program.names.iter().find(|(v, _)| *v == value).map(|(_, n)| n);
        let output = program.outputs.iter().find(|(_, v)| *v == value).map(|(n, _)| n);
        named.or(output).cloned().unwrap_or_else(|| format!("v{value}"))
    }

    fn ident(&self, value: Value) -> Ident {
        format_ident!("{}", self.name(value))
    }

    /// `start`: order zero of the row, and the slope.
    fn start(&self) -> TokenStream {
        let (rt, t) = (&self.context.names.rt, &self.context.names.scalar);
        let rates = self.recurrence.program.outputs.iter().map(|(_, v)| *v);
        let kept = self.recurrence.row.iter().flatten().filter(|s| !s.rate).map(|s| s.value);
        let program = self.with_results(rates.clone().chain(kept));
        let (read, constants) = self.constants(&program);
        let (bind, state) = self.bind(&inputs(&program), "state");
        let Body { lets, results } = self.context.generic(&program);
        let (rates, kept) = results.split_at(rates.count());
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

    /// `next`: one order more.
    fn next(&mut self) -> TokenStream {
        let (rt, t) = (&self.context.names.rt, &self.context.names.scalar);
        let values = self.values_read_fixed();
        let fixed = self.with_results(values.iter().copied());
        let (read, constants) = self.constants(&fixed);
        let Body { lets, results } = self.context.generic(&fixed);
        self.fixed = values.into_iter().zip(results).collect();
        let states = self.used_states();
        let used: Vec<&str> = states.iter().map(String::as_str).collect();
        let (bind, coefficient) = self.bind(&used, "coefficient");
        let (ready, late): (Vec<_>, Vec<_>) =
            self.recurrence.rules.iter().partition(|(value, _)| self.recurrence.ready[*value]);
        let early = ready.iter().map(|(value, rule)| self.statement(*value, rule));
        let unread = self.read_by_columns_alone();
        let late = late.iter().filter(|(value, _)| !unread.contains(value));
        let late = late.map(|(value, rule)| self.statement(*value, rule));
        let (early_vectors, late_vectors) = (self.vectors(true), self.vectors(false));
        let stored = self.stored();
        let middle = self.loops();
        let ends = self.ends();
        let rates = self.recurrence.program.outputs.iter().map(|(_, v)| match self.recurrence.moving[*v] {
            true => {
                let rate = self.ident(*v);
                quote!(#rate / divisor)
            }
            false => quote!(#t::zero()),
        });
        let states = self.states();
        let coefficients =
            states.iter().zip(rates).map(|(state, rate)| self.column_entry(state).unwrap_or(rate));
        let none = self.no_columns();
        let (columns, next_columns, advanced) = self.column_bindings();
        let zeros = number(self.states().len());
        let open = (!self.recurrence.row.is_empty()).then(
            || quote!(let [first, middle @ .., row] = rows else { return ([#t::zero(); #zeros], #none) };),
        );
        let rows = if self.recurrence.row.is_empty() { quote!(_rows) } else { quote!(rows) };
        let passes = self.recurrence.full.len() + self.recurrence.inner.len();
        let vectors = if passes > 0 { quote!(vectors) } else { quote!(_vectors) };
        let order = if self.reads_order() { quote!(order) } else { quote!(_) };
        let moves = self.recurrence.program.outputs.iter().any(|(_, v)| self.recurrence.moving[*v]);
        let divisor = if moves { quote!(divisor) } else { quote!(_) };
        quote! {
            #[inline(always)]
            fn next<#t: #rt::Scalar>(
                &self,
                #vectors: impl #rt::Vectors,
                (#order, #divisor): (#t, #t),
                #constants: &Self::Constants<#t>,
                (#coefficient, #columns): (&Self::Reduced<#t>, Self::Columns<#t>),
                #rows: &mut [Self::Row<#t>],
            ) -> (Self::Reduced<#t>, Self::Columns<#t>) {
                #read
                #lets
                #open
                #middle
                #bind
                #(#early)*
                #early_vectors
                #ends
                #(#late)*
                #late_vectors
                #stored
                #advanced
                ([#(#coefficients),*], #next_columns)
            }
        }
    }

    /// Values that do not move and that rules read.
    fn values_read_fixed(&self) -> Vec<Value> {
        let mut fixed: Vec<Value> = Vec::new();
        for (_, rule) in &self.recurrence.rules {
            let Rule::Sum(terms) = rule else { continue };
            for (_, term) in terms {
                if let Term::Scaled(c, _) | Term::Divided(_, c) = term
                    && !fixed.contains(c)
                {
                    fixed.push(*c);
                }
            }
        }
        fixed
    }

    /// States whose coefficients rules or rows read.
    fn used_states(&self) -> Vec<String> {
        let row = self.recurrence.row.iter().enumerate().filter(|(slot, _)| !self.is_in_column(*slot));
        let mut read: Vec<Value> = row.filter_map(|(_, s)| Some((*s)?.value)).collect();
        read.extend(self.recurrence.program.outputs.iter().map(|(_, v)| *v));
        read.extend(self.read_by_rules());
        let inputs = read.into_iter().filter(|v| self.recurrence.moving[*v]);
        inputs
            .filter(|v| matches!(self.recurrence.program.steps[*v], Op::Input(_)))
            .map(|v| self.name(v))
            .collect()
    }

    /// What rules read of the present order.
    fn read_by_rules(&self) -> Vec<Value> {
        let read = |(_, rule): &(Value, Rule)| match rule {
            Rule::Sum(terms) => terms
                .iter()
                .flat_map(|(_, term)| match *term {
                    Term::Value(v) | Term::Scaled(_, v) | Term::Divided(v, _) => vec![v],
                    Term::Ends(a, b) => vec![a, b],
                    Term::Lane(_) => Vec::new(),
                })
                .collect(),
            Rule::Quotient { numerator, denominator, .. } => {
                numerator.iter().chain([denominator]).copied().collect()
            }
            Rule::Function { argument, .. } => vec![*argument],
        };
        self.recurrence.rules.iter().flat_map(read).collect()
    }

    /// Rates that only columns read, as the sums that they are the lanes of.
    fn read_by_columns_alone(&self) -> Vec<Value> {
        let elsewhere = self.read_by_rules();
        let in_row = |value: Value| self.recurrence.row.iter().flatten().any(|series| series.value == value);
        let (in_columns, apart): (Vec<_>, Vec<_>) = self
            .states()
            .into_iter()
            .zip(&self.recurrence.program.outputs)
            .partition(|(state, _)| self.column_entry(state).is_some());
        let is_output = |value: Value| apart.iter().any(|(_, (_, v))| *v == value);
        let rates = in_columns.into_iter().map(|(_, (_, value))| *value);
        rates.filter(|v| !elsewhere.contains(v) && !in_row(*v) && !is_output(*v)).collect()
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
