//! `emit(taylor)`: the recurrence of Taylor coefficients, order by order.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use crate::algebra::Function;
use crate::ir::taylor::{Factor, Pass, Place, Recurrence, Rule, Series, Term, sums};
use crate::ir::{Op, Program, Value};

use super::body::{Body, inputs};
use super::{Context, number, pattern};

/// Sums that are formed in one loop: with four lanes each, twelve registers of the narrowest vector unit.
const SUMS_PER_LOOP: usize = 6;

/// The implementation of the capability.
pub(super) fn taylor_impl(context: &Context) -> TokenStream {
    let Some(recurrence) = &context.model.taylor else { return TokenStream::new() };
    let (prepared, rt, n) = (&context.names.prepared, &context.names.rt, context.dim());
    let (generics, types, clause) = context.generics();
    let t = &context.names.scalar;
    let slots = number(recurrence.row.len());
    let mut writer = Writer { context, recurrence, fixed: Vec::new() };
    let (start, next) = (writer.start(), writer.next());
    quote! {
        impl #generics #rt::Taylor<#n> for #prepared #types #clause {
            type Row<#t: #rt::Scalar> = [#t; #slots];
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
        let late = late.iter().map(|(value, rule)| self.statement(*value, rule));
        let (early_vectors, late_vectors) = (self.vectors(true), self.vectors(false));
        let stored = self.stored();
        let middle = self.loops();
        let ends = self.recurrence.full.iter().map(|pass| self.ends(pass));
        let rates = self.recurrence.program.outputs.iter().map(|(_, v)| match self.recurrence.moving[*v] {
            true => {
                let rate = self.ident(*v);
                quote!(#rate)
            }
            false => quote!(#t::zero()),
        });
        let zeros = number(self.states().len());
        let open = (!self.recurrence.row.is_empty())
            .then(|| quote!(let [first, middle @ .., row] = rows else { return [#t::zero(); #zeros] };));
        let rows = if self.recurrence.row.is_empty() { quote!(_rows) } else { quote!(rows) };
        let passes = self.recurrence.full.len() + self.recurrence.inner.len();
        let vectors = if passes > 0 { quote!(vectors) } else { quote!(_vectors) };
        let order = if self.reads_order() { quote!(order) } else { quote!(_order) };
        quote! {
            #[inline(always)]
            fn next<#t: #rt::Scalar>(
                &self,
                #vectors: impl #rt::Vectors,
                #order: #t,
                #constants: &Self::Constants<#t>,
                #coefficient: &Self::Reduced<#t>,
                #rows: &mut [Self::Row<#t>],
            ) -> Self::Reduced<#t> {
                #read
                #lets
                #open
                #middle
                #bind
                #(#early)*
                #early_vectors
                #(#ends)*
                #(#late)*
                #late_vectors
                #stored
                [#(#rates),*]
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
        let mut read: Vec<Value> = self.recurrence.row.iter().flatten().map(|s| s.value).collect();
        read.extend(self.recurrence.program.outputs.iter().map(|(_, v)| *v));
        for (_, rule) in &self.recurrence.rules {
            match rule {
                Rule::Sum(terms) => read.extend(terms.iter().flat_map(|(_, term)| match *term {
                    Term::Value(v) | Term::Scaled(_, v) | Term::Divided(v, _) => vec![v],
                    Term::Ends(a, b) => vec![a, b],
                    Term::Lane(_) => Vec::new(),
                })),
                Rule::Quotient { numerator, denominator, .. } => {
                    read.extend(numerator.iter().chain([denominator]));
                }
                Rule::Function { argument, .. } => read.push(*argument),
            }
        }
        let inputs = read.into_iter().filter(|v| self.recurrence.moving[*v]);
        inputs
            .filter(|v| matches!(self.recurrence.program.steps[*v], Op::Input(_)))
            .map(|v| self.name(v))
            .collect()
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

    /// The vectors of ready series, or the others: all lanes of a row that begin at `slot`.
    fn vectors(&self, ready: bool) -> TokenStream {
        let t = &self.context.names.scalar;
        let is_ready =
            |series: &Option<Series>| series.is_none_or(|s| self.recurrence.ready[s.value] && !s.rate);
        let vectors =
            self.recurrence.row[..self.recurrence.vectors].chunks(self.recurrence.lanes).enumerate();
        vectors
            .filter(|(_, vector)| vector.iter().all(is_ready) == ready)
            .map(|(index, vector)| {
                let name = self.vector(index * self.recurrence.lanes);
                let entries = vector.iter().map(|series| match series {
                    Some(series) => self.current(*series),
                    None => quote!(#t::zero()),
                });
                quote!(let #name = [#(#entries),*];)
            })
            .collect()
    }

    fn vector(&self, slot: usize) -> Ident {
        format_ident!("lanes_{}", slot / self.recurrence.lanes + 1)
    }

    /// Fills the row of order `k`.
    fn stored(&self) -> TokenStream {
        let Recurrence { row, vectors, lanes, .. } = self.recurrence;
        if row.is_empty() {
            return TokenStream::new();
        }
        let names = (0..*vectors).step_by(*lanes).map(|slot| self.vector(slot));
        let singles = row[*vectors..].iter().flatten().map(|series| self.current(*series));
        let entries = names
            .flat_map(|name| {
                (0..*lanes).map(move |lane| {
                    let lane = number(lane);
                    quote!(#name[#lane])
                })
            })
            .chain(singles);
        quote!(*row = [#(#entries),*];)
    }

    /// The terms `j = 1..k` of all convolutions.
    fn loops(&self) -> TokenStream {
        let t = &self.context.names.scalar;
        let lanes = number(self.recurrence.lanes);
        let all = [("full", &self.recurrence.full), ("inner", &self.recurrence.inner)];
        let sums: Vec<(&str, usize)> =
            all.iter().flat_map(|(stem, passes)| (0..sums(passes)).map(move |sum| (*stem, sum))).collect();
        let passes: Vec<(&str, &Pass)> =
            all.iter().flat_map(|(stem, passes)| passes.iter().map(move |pass| (*stem, pass))).collect();
        let blocks = sums.chunks(SUMS_PER_LOOP).map(|block| {
            let names = block.iter().map(|(stem, sum)| self.sum(stem, *sum));
            let own = passes.iter().filter(|(stem, pass)| block.contains(&(*stem, pass.sum)));
            let statements = own.map(|(stem, pass)| {
                let (left, right) = self.factors(pass, &quote!(left), &quote!(right));
                self.pass(stem, pass, &left, &right)
            });
            quote! {
                #(let mut #names = [#t::zero(); #lanes];)*
                for (left, right) in middle.iter().zip(middle.iter().rev()) {
                    #(#statements)*
                }
            }
        });
        blocks.collect()
    }

    /// The terms `j = 0` and `j = k` of a full convolution.
    fn ends(&self, pass: &Pass) -> TokenStream {
        let (first_left, first_right) = self.factors(pass, &quote!(first), &quote!(first));
        let left = self.vector(pass.left);
        let right = match pass.right {
            Factor::Vector(slot) => {
                let right = self.vector(slot);
                quote!(#right)
            }
            Factor::Slot(slot) => {
                self.recurrence.row[slot].map(|series| self.current(series)).unwrap_or_default()
            }
        };
        let one = self.pass("full", pass, &first_left, &right);
        let other = self.pass("full", pass, &quote!(#left), &first_right);
        quote!(#one #other)
    }

    fn sum(&self, stem: &str, sum: usize) -> Ident {
        format_ident!("{stem}_{}", sum + 1)
    }

    /// The factors of a multiplication from two rows.
    fn factors(&self, pass: &Pass, left: &TokenStream, right: &TokenStream) -> (TokenStream, TokenStream) {
        let rt = &self.context.names.rt;
        let vector = |row: &TokenStream, slot: usize| {
            let slot = number(slot);
            quote!(#rt::lanes(#row, #slot))
        };
        let right = match pass.right {
            Factor::Vector(slot) => vector(right, slot),
            Factor::Slot(slot) => {
                let slot = number(slot);
                quote!(#right[#slot])
            }
        };
        (vector(left, pass.left), right)
    }

    fn pass(&self, stem: &str, pass: &Pass, left: &TokenStream, right: &TokenStream) -> TokenStream {
        let rt = &self.context.names.rt;
        let sum = self.sum(stem, pass.sum);
        let name = match (pass.negative, pass.right) {
            (false, Factor::Vector(_)) => "add_products",
            (true, Factor::Vector(_)) => "subtract_products",
            (false, Factor::Slot(_)) => "add_multiple",
            (true, Factor::Slot(_)) => "subtract_multiple",
        };
        let function = format_ident!("{name}");
        quote!(#rt::#function(vectors, &mut #sum, #left, #right);)
    }

    fn place(&self, place: Place) -> TokenStream {
        let sum = self.sum(if place.full { "full" } else { "inner" }, place.sum);
        let lane = number(place.lane);
        quote!(#sum[#lane])
    }

    /// The coefficient of order zero.
    fn first(&self, series: Series) -> TokenStream {
        // Every factor of an inner convolution has a slot.
        let slot = number(self.recurrence.slot(series).unwrap_or(0));
        quote!(first[#slot])
    }

    fn of_order_zero(&self, value: Value) -> TokenStream {
        self.first(Series { value, rate: false })
    }

    /// The rule as a `let`. Divisors are known long before: their reciprocals are not waited for.
    fn statement(&self, value: Value, rule: &Rule) -> TokenStream {
        let t = &self.context.names.scalar;
        let name = self.ident(value);
        let expression = match rule {
            Rule::Sum(terms) => self.summed(terms),
            Rule::Quotient { numerator, denominator, inner } => {
                let (b, inner) = (self.ident(*denominator), self.place(*inner));
                let (y0, b0) = (self.of_order_zero(value), self.of_order_zero(*denominator));
                let rest = quote!(#b.fma(#y0, #inner));
                match numerator {
                    Some(a) => {
                        let a = self.ident(*a);
                        quote!((#a - #rest) * (#t::one() / #b0))
                    }
                    None => quote!(-#rest * (#t::one() / #b0)),
                }
            }
            Rule::Function { function, argument, companion, inner } => {
                self.function(*function, value, *argument, *companion, inner)
            }
        };
        quote!(let #name = #expression;)
    }

    /// Products as multiply-adds behind the sum of the rest.
    fn summed(&self, terms: &[(bool, Term)]) -> TokenStream {
        let t = &self.context.names.scalar;
        let mut sorted: Vec<&(bool, Term)> = terms.iter().collect();
        sorted.sort_by_key(|(negative, term)| match term {
            Term::Value(_) | Term::Lane(_) => (0, *negative),
            Term::Divided(..) => (1, *negative),
            Term::Scaled(..) | Term::Ends(..) => (2, false),
        });
        let mut sum: Option<TokenStream> = None;
        for (negative, term) in sorted {
            let plain = match *term {
                Term::Value(v) => {
                    let v = self.ident(v);
                    quote!(#v)
                }
                Term::Lane(place) => self.place(place),
                Term::Divided(v, c) => {
                    let (v, c) = (self.ident(v), self.fixed_value(c));
                    quote!(#v / #c)
                }
                Term::Scaled(c, v) => {
                    let (c, v) = (self.fixed_value(c), self.ident(v));
                    sum = Some(product(sum, *negative, quote!(#v), quote!(#c)));
                    continue;
                }
                Term::Ends(a, b) => {
                    let (a0, ak) = (self.of_order_zero(a), self.ident(a));
                    if a == b {
                        sum = Some(product(sum, *negative, quote!((#a0 + #a0)), quote!(#ak)));
                        continue;
                    }
                    let (b0, bk) = (self.of_order_zero(b), self.ident(b));
                    sum = Some(product(sum, *negative, quote!(#bk), a0));
                    sum = Some(product(sum, *negative, quote!(#ak), b0));
                    continue;
                }
            };
            sum = Some(match (sum, negative) {
                (None, false) => plain,
                (None, true) => quote!(-#plain),
                (Some(sum), false) => quote!(#sum + #plain),
                (Some(sum), true) => quote!(#sum - #plain),
            });
        }
        sum.unwrap_or_else(|| quote!(#t::zero()))
    }

    /// The expression of a value that does not move.
    fn fixed_value(&self, value: Value) -> TokenStream {
        self.fixed.iter().find(|(v, _)| *v == value).map(|(_, tokens)| tokens.clone()).unwrap_or_default()
    }

    /// The differential equation of each function, solved for the coefficient of order `k`.
    fn function(
        &self,
        function: Function,
        value: Value,
        argument: Value,
        companion: Option<Value>,
        inner: &[Place],
    ) -> TokenStream {
        let t = &self.context.names.scalar;
        let u = self.ident(argument);
        let (y0, u0) = (self.of_order_zero(value), self.of_order_zero(argument));
        let inner: Vec<TokenStream> = inner.iter().map(|place| self.place(*place)).collect();
        match (function, inner.as_slice(), companion) {
            // y' = y u'
            (Function::Exp, [m], _) => quote!(#u.fma(#y0, #m / order)),
            // u y' = u'
            (Function::Ln, [m], _) => quote!((#u - #m / order) * (#t::one() / #u0)),
            // y^2 = u
            (Function::Sqrt, [m], _) => quote!((#u - #m) * (#t::one() / (#y0 + #y0))),
            // 3 u y' = y u'
            (Function::Cbrt, [m, weighted], _) => {
                let (three, four) = (quote!(#t::constant(3.0, 0.0)), quote!(#t::constant(4.0, 0.0)));
                quote!((#u.fma(#y0, #m) * order - #weighted * #four) * (#t::one() / (#u0 * order * #three)))
            }
            // y' = z u' or y' = -z u'
            (function, [m], Some(other)) => {
                let z0 = self.of_order_zero(other);
                let sum = quote!(#u.fma(#z0, #m / order));
                if function == Function::Cos { quote!(-#sum) } else { sum }
            }
            // |u| = (|u_0|/u_0) u
            _ => quote!(#u * (#y0 / #u0)),
        }
    }
}

/// `sum + a b` or `sum - a b`.
fn product(sum: Option<TokenStream>, negative: bool, a: TokenStream, b: TokenStream) -> TokenStream {
    match (sum, negative) {
        (None, false) => quote!(#a * #b),
        (None, true) => quote!(-#a * #b),
        (Some(sum), false) => quote!(#a.fma(#b, #sum)),
        (Some(sum), true) => quote!((-#a).fma(#b, #sum)),
    }
}
