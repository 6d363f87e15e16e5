//! The rules of the recurrence: sums, quotients, functions.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::reads;
use super::writer::Writer;
use crate::algebra::Function;
use crate::algebra::fault::never_missing;
use crate::emit::body::Body;
use crate::emit::context::Coefficients;
use crate::emit::number::{double, number};
use crate::ir::Value;
use crate::ir::naming::digits;
use crate::ir::taylor::{Place, Rule, Series, Term};

impl Writer<'_> {
    /// The values that do not move and that rules read, as statements; the parameter that they read.
    pub(super) fn fix(&mut self, rules: &[&(Value, Rule)]) -> (TokenStream, TokenStream) {
        let values = reads::fixed(rules);
        let program = self.with_results(values.iter().copied());
        let (read, constants) = self.constants(&program);
        let Body { lets, results } = self.context.generic(&program, Coefficients::Own);
        self.fixed = values.into_iter().zip(results).collect();
        let divisors = self.divisors(rules);
        (quote!(#read #lets #divisors), constants)
    }

    /// The coefficient of order zero.
    fn first(&self, series: Series) -> TokenStream {
        let slot = self.recurrence.slot(series);
        let slot = number(never_missing(slot, "every factor of an inner convolution has a slot", 0));
        quote!(first[#slot])
    }

    fn of_order_zero(&self, value: Value) -> TokenStream {
        self.first(Series { value, rate: false })
    }

    /// The rule as a `let`. Divisors are known long before: their reciprocals are not waited for.
    pub(super) fn statement(&self, value: Value, rule: &Rule) -> TokenStream {
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
            // 1 at order 1 and 0 beyond, in units of time: the divisor of order 1 is 2.
            Rule::Time => {
                let rt = &self.context.names.rt;
                quote!({
                    let first = (#t::constant(2.0, 0.0) - order).max(#t::zero());
                    #rt::over(first + first, divisor)
                })
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
            Term::Divided(..) | Term::Over(..) => (1, *negative),
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
                Term::Over(v, c) => {
                    let (rt, v, divisor) = (&self.context.names.rt, self.ident(v), self.divisor(c));
                    quote!(#rt::over(#v, #divisor))
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

    /// The reciprocal of a number, to be divided by.
    fn divisor(&self, value: Value) -> Ident {
        let reciprocal = self.recurrence.number(value).recip().map(|number| digits(&number));
        let reciprocal = never_missing(reciprocal, "no number that divides is zero", String::new());
        format_ident!("divisor_{reciprocal}")
    }

    /// All that are divided by, as statements.
    pub(super) fn divisors(&self, rules: &[&(Value, Rule)]) -> TokenStream {
        let rt = &self.context.names.rt;
        let terms = rules.iter().flat_map(|(_, rule)| match rule {
            Rule::Sum(terms) => terms.as_slice(),
            _ => &[],
        });
        let mut divisors: Vec<Value> = Vec::new();
        for (_, term) in terms {
            if let Term::Over(_, c) = term
                && !divisors.contains(c)
            {
                divisors.push(*c);
            }
        }
        let written = |c: &Value| {
            let name = self.divisor(*c);
            let [half, rest, left] = self.recurrence.number(*c).to_halves().map(double);
            quote!(let #name = #rt::Divisor::with_reciprocal(#half, #rest, #left);)
        };
        divisors.iter().map(written).collect()
    }

    /// The expression of a value that does not move.
    fn fixed_value(&self, value: Value) -> TokenStream {
        let fixed = self.fixed.iter().find(|(v, _)| *v == value).map(|(_, tokens)| tokens.clone());
        never_missing(fixed, "what does not move is bound before it is read", TokenStream::new())
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
        // Not every equation reads them, and what none reads has no slot.
        let y0 = || self.of_order_zero(value);
        let u0 = || self.of_order_zero(argument);
        let inner: Vec<TokenStream> = inner.iter().map(|place| self.place(*place)).collect();
        match (function, inner.as_slice(), companion) {
            // y' = y u'
            (Function::Exp, [m], _) => {
                let y0 = y0();
                quote!(#u.fma(#y0, #m / order))
            }
            // u y' = u'
            (Function::Ln, [m], _) => {
                let u0 = u0();
                quote!((#u - #m / order) * (#t::one() / #u0))
            }
            // y^2 = u
            (Function::Sqrt, [m], _) => {
                let y0 = y0();
                quote!((#u - #m) * (#t::one() / (#y0 + #y0)))
            }
            // 3 u y' = y u'
            (Function::Cbrt, [m, weighted], _) => {
                let (y0, u0) = (y0(), u0());
                let (three, four) = (quote!(#t::constant(3.0, 0.0)), quote!(#t::constant(4.0, 0.0)));
                quote!((#u.fma(#y0, #m) * order - #weighted * #four) * (#t::one() / (#u0 * order * #three)))
            }
            // 3 u y' = -y u'
            (Function::InverseCbrt, [m, weighted], _) => {
                let (y0, u0) = (y0(), u0());
                let (two, three) = (quote!(#t::constant(2.0, 0.0)), quote!(#t::constant(3.0, 0.0)));
                quote!((#u.fma(#y0, #m) * order + #weighted * #two) * (-#t::one() / (#u0 * order * #three)))
            }
            // y' = z u' or y' = -z u'
            (function, [m], Some(other)) => {
                let z0 = self.of_order_zero(other);
                let sum = quote!(#u.fma(#z0, #m / order));
                if function == Function::Cos { quote!(-#sum) } else { sum }
            }
            // |u| = (|u_0|/u_0) u
            (Function::Abs, ..) => {
                let (y0, u0) = (y0(), u0());
                quote!(#u * (#y0 / #u0))
            }
            _ => never_missing(None, "a function with a rule has a differential equation", quote!(#u)),
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
