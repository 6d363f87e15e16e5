//! Straight-line programs as Rust: one `let` for what has a name or is read twice, everything else in place.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};
use rustc_hash::FxHashMap;

use crate::ir::call::Call;
use crate::ir::naming::Namer;
use crate::ir::{Op, Program, Value};

use super::expression::{Expression, Strength, at_least, difference, negative, product, quotient, sum};
use super::kernel;
use super::number::{Number, name_of};
use super::pattern::ident;
use super::scope::Scope;

/// A program as statements and result expressions.
pub(super) struct Body {
    /// `let` statements.
    pub lets: TokenStream,
    /// One expression for each result; a name or a number, but for a result that is the only one.
    pub results: Vec<TokenStream>,
}

impl Body {
    /// The expression of a program's only result.
    pub(super) fn result(&self) -> TokenStream {
        self.results.iter().cloned().collect()
    }
}

/// Writes a program down.
pub(super) fn body(program: &Program, scope: &Scope) -> Body {
    let mut writer = Writer {
        program,
        scope,
        uses: program.uses(),
        depth: vec![0; program.steps.len()],
        called: Vec::new(),
        bound: FxHashMap::default(),
        lets: TokenStream::new(),
        namer: Namer::new(program),
        roots: 0,
    };
    writer.constants();
    for value in 0..program.steps.len() {
        writer.call(value);
        writer.bind(value);
    }
    let results = program.outputs.iter().map(|(_, v)| writer.expression(*v).0).collect();
    Body { lets: writer.lets, results }
}

/// Expressions nested deeper than this are cut by a name.
pub(super) const DEEPEST: usize = 4;

struct Writer<'a> {
    program: &'a Program,
    scope: &'a Scope<'a>,
    uses: Vec<usize>,
    /// How deep the expression of each value is nested.
    depth: Vec<usize>,
    /// The calls that are written down.
    called: Vec<&'a Call>,
    bound: FxHashMap<Value, Ident>,
    lets: TokenStream,
    namer: Namer<'a>,
    /// Numbers that have no short name.
    roots: usize,
}

impl Writer<'_> {
    /// Numbers first, named by their exact value; none and one stand where they are read.
    fn constants(&mut self) {
        for (value, step) in self.program.steps.iter().enumerate() {
            if let Op::Constant(number) = step
                && !(number.is_zero() || number.is_one() || self.is_only_result(value))
            {
                let name = name_of(number, &mut self.roots);
                let exact = self.scope.number.exact(number);
                self.lets.extend(quote!(let #name = #exact;));
                self.bound.insert(value, name);
            }
        }
    }

    /// Is the value the only result, and nothing else?
    fn is_only_result(&self, value: Value) -> bool {
        matches!(self.program.outputs.as_slice(), [(_, only)] if *only == value) && self.uses[value] == 1
    }

    /// The call that provides an input, before its first result is read.
    fn call(&mut self, value: Value) {
        let Some(call) = self.program.call_before(value).filter(|call| !self.called.contains(call)) else {
            return;
        };
        let arguments: Vec<TokenStream> =
            call.arguments.iter().map(|group| kernel::written(group, |v| self.expression(*v).0)).collect();
        let read: Vec<_> = self.program.symbols().collect();
        let results = call.results.iter().map(|group| kernel::bound(group, &read));
        self.lets.extend(kernel::statement(self.scope, call.callee, arguments, results));
        self.called.push(call);
    }

    fn bind(&mut self, value: Value) {
        let step = &self.program.steps[value];
        if matches!(step, Op::Input(_) | Op::Constant(_)) {
            return;
        }
        let named = self.program.names.iter().find(|(v, _)| *v == value).map(|(_, n)| n.clone());
        let result = self.program.outputs.iter().find(|(_, v)| *v == value).map(|(n, _)| n.clone());
        let sign_only = matches!(step, Op::Neg(_));
        self.depth[value] = self.nested(step);
        let name = match (named, result) {
            (_, Some(_)) if self.is_only_result(value) => return,
            (_, Some(name)) | (Some(name), None) => name,
            (None, None) if (self.uses[value] > 1 || self.depth[value] >= DEEPEST) && !sign_only => {
                self.namer.name(value)
            }
            _ => return,
        };
        let name = ident(&name);
        let (expression, _) = self.expression(value);
        self.lets.extend(quote!(let #name = #expression;));
        self.bound.insert(value, name);
    }

    /// How deep the expression of a step is nested in those of its operands.
    fn nested(&self, step: &Op) -> usize {
        let depth = |v: &Value| if self.bound.contains_key(v) { 0 } else { self.depth[*v] };
        match (step, self.scope.number) {
            // A sum stands before the product that it gets, not around it.
            (Op::MulAdd(a, b, sum), Number::Generic(_)) => (1 + depth(a).max(depth(b))).max(depth(sum)),
            _ => {
                let deepest = step.operands().iter().map(depth).max().unwrap_or(0);
                deepest + usize::from(!matches!(step, Op::Neg(_)))
            }
        }
    }

    fn expression(&self, value: Value) -> Expression {
        if let Some(name) = self.bound.get(&value) {
            return (quote!(#name), Strength::Atom);
        }
        match &self.program.steps[value] {
            Op::Input(symbol) => ((self.scope.input)(symbol), Strength::Atom),
            Op::Constant(number) => (self.scope.number.exact(number), Strength::Atom),
            Op::Neg(a) => negative(self.expression(*a)),
            Op::Call(function, a) => (self.applied(function.name(), *a), Strength::Atom),
            Op::Add(a, b) => sum(self.expression(*a), self.expression(*b)),
            Op::Sub(a, b) => difference(self.expression(*a), self.expression(*b)),
            Op::Mul(a, b) => product(self.expression(*a), self.expression(*b)),
            Op::Div(a, b) => quotient(self.expression(*a), self.expression(*b)),
            Op::MulAdd(a, b, c) if matches!(self.scope.number, Number::Double) => {
                let [a, b] = [*a, *b].map(|factor| self.at_least(factor, Strength::Product));
                let c = self.expression(*c).0;
                (quote!(#a * #b + #c), Strength::Sum)
            }
            Op::MulAdd(a, b, c) => {
                let sum = self.at_least(*c, Strength::Atom);
                let (a, method) = match &self.program.steps[*a] {
                    Op::Neg(inner) if !self.bound.contains_key(a) => (inner, "minus"),
                    _ => (a, "plus"),
                };
                let (a, b, method) =
                    (self.expression(*a).0, self.expression(*b).0, format_ident!("{method}"));
                (quote!(#sum.#method(#a, #b)), Strength::Atom)
            }
        }
    }

    /// A function of a value. Doubles have methods of their own, not all of them, and none without the standard library.
    fn applied(&self, function: &str, a: Value) -> TokenStream {
        let name = format_ident!("{function}");
        match self.scope.number {
            Number::Generic(_) => {
                let a = self.at_least(a, Strength::Atom);
                quote!(#a.#name())
            }
            Number::Double => {
                let (a, rt) = (self.expression(a).0, self.scope.rt);
                quote!(#rt::Scalar::#name(#a))
            }
        }
    }

    fn at_least(&self, value: Value, least: Strength) -> TokenStream {
        at_least(self.expression(value), least)
    }
}
