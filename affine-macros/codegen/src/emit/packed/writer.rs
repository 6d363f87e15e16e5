//! Statements and expressions over vectors and numbers.

use std::collections::HashMap;

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::names;
use crate::emit::body::DEEPEST;
use crate::emit::context::Context;
use crate::emit::expression::{Expression, Strength, at_least, difference, negative, product, quotient, sum};
use crate::emit::number::{Number, name_of, number};
use crate::emit::pattern::ident;
use crate::ir::naming::Namer;
use crate::ir::packed::{Four, Index, Lane, Packed, Step};
use crate::ir::{Op, Value};

/// The equations, written down.
pub(super) struct Written {
    /// Names of the vectors of the state.
    pub state: Vec<TokenStream>,
    /// `let` statements.
    pub lets: TokenStream,
    /// The rates of the vectors of the state.
    pub rates: Vec<TokenStream>,
    /// Does a number go to all lanes?
    pub broadcasts: bool,
    /// Are lanes gathered?
    pub gathers: bool,
}

/// Writes the equations down.
pub(super) fn written(context: &Context, packed: &Packed) -> Written {
    let mut writer = Writer {
        context,
        packed,
        names: names::of_vectors(packed, &context.model.dynamics.reduced.symbols()),
        uses: uses(packed),
        depth: HashMap::new(),
        bound: HashMap::new(),
        lets: TokenStream::new(),
        namer: Namer::new(&packed.program),
        partial: 0,
    };
    let state = writer.state();
    writer.constants();
    packed.steps.iter().for_each(|step| writer.bind(*step));
    let rates = packed.rates.iter().map(|rate| writer.expression(Step::Vector(*rate)).0).collect();
    let makes = |wanted: &dyn Fn(Four) -> bool| {
        packed.steps.iter().any(|step| matches!(step, Step::Vector(k) if wanted(packed.vectors[*k].made)))
    };
    Written {
        state,
        lets: writer.lets,
        rates,
        broadcasts: makes(&|four| matches!(four, Four::All(_))),
        gathers: makes(&|four| matches!(four, Four::Gathered(_))),
    }
}

/// How often each step is read.
fn uses(packed: &Packed) -> HashMap<Step, usize> {
    let mut uses = HashMap::new();
    let mut read = |step: Step| *uses.entry(step).or_default() += 1;
    for step in &packed.steps {
        packed.operands(*step).into_iter().for_each(&mut read);
    }
    packed.rates.iter().for_each(|rate| read(Step::Vector(*rate)));
    uses
}

struct Writer<'a> {
    context: &'a Context<'a>,
    packed: &'a Packed,
    /// Names of vectors.
    names: Vec<Option<Ident>>,
    uses: HashMap<Step, usize>,
    /// How deep the expression of each step is nested.
    depth: HashMap<Step, usize>,
    bound: HashMap<Step, Ident>,
    lets: TokenStream,
    namer: Namer<'a>,
    /// Vectors without a name.
    partial: usize,
}

impl Writer<'_> {
    /// The vectors of the state: those that are read have names.
    fn state(&mut self) -> Vec<TokenStream> {
        let mut bound = Vec::new();
        for (k, _) in self.packed.state.iter().enumerate() {
            let step = Step::Vector(k);
            match (&self.names[k], self.uses.contains_key(&step)) {
                (Some(name), true) => {
                    bound.push(quote!(#name));
                    self.bound.insert(step, name.clone());
                }
                _ => bound.push(quote!(_)),
            }
        }
        bound
    }

    /// Numbers first, named by their exact value; none and one stand where they are read.
    fn constants(&mut self) {
        let mut roots = 0;
        for step in &self.packed.steps {
            if let Step::Scalar(value) = step
                && let Op::Constant(exact) = &self.packed.program.steps[*value]
                && !(exact.is_zero() || exact.is_one())
            {
                let (name, exact) = (name_of(exact, &mut roots), Number::Double.exact(exact));
                self.lets.extend(quote!(let #name = #exact;));
                self.bound.insert(*step, name);
            }
        }
    }

    fn bind(&mut self, step: Step) {
        if self.bound.contains_key(&step) {
            return;
        }
        let is_light = match step {
            Step::Scalar(value) => matches!(self.packed.program.steps[value], Op::Neg(_)),
            Step::Vector(index) => {
                matches!(self.packed.vectors[index].made, Four::All(_) | Four::Neg(_))
            }
        };
        let nested = self.packed.operands(step).into_iter().filter(|s| !self.bound.contains_key(s));
        let depth = nested.filter_map(|s| self.depth.get(&s)).max().copied().unwrap_or(0);
        self.depth.insert(step, depth + usize::from(!is_light));
        let uses = self.uses.get(&step).copied().unwrap_or(0);
        let name = match self.name(step) {
            Some(name) => name,
            None if is_light || (uses < 2 && depth + 1 < DEEPEST) => return,
            None => match step {
                Step::Scalar(value) => ident(&self.namer.name(value)),
                Step::Vector(_) => {
                    self.partial += 1;
                    format_ident!("partial_{}", self.partial)
                }
            },
        };
        let (expression, _) = self.expression(step);
        self.lets.extend(quote!(let #name = #expression;));
        self.bound.insert(step, name);
    }

    /// The name of what a step computes.
    fn name(&self, step: Step) -> Option<Ident> {
        match step {
            Step::Scalar(value) => self.packed.program.own_name(value).map(ident),
            Step::Vector(index) => self.names[index].clone(),
        }
    }

    /// A value of the scalar program, from its lane if it has one.
    fn value(&self, value: Value) -> Expression {
        if let Op::Input(symbol) = &self.packed.program.steps[value]
            && self.packed.lane(value).is_none()
        {
            let name = ident(symbol);
            return (quote!(#name), Strength::Atom);
        }
        match self.packed.lane(value) {
            Some((index, lane)) => {
                let (vector, lane) = (self.at_least(Step::Vector(index), Strength::Atom), number(lane));
                (quote!(#vector[#lane]), Strength::Atom)
            }
            None => self.expression(Step::Scalar(value)),
        }
    }

    fn expression(&self, step: Step) -> Expression {
        if let Some(name) = self.bound.get(&step) {
            return (quote!(#name), Strength::Atom);
        }
        match step {
            Step::Scalar(value) => self.scalar(&self.packed.program.steps[value]),
            Step::Vector(index) => self.vector(index),
        }
    }

    fn scalar(&self, op: &Op) -> Expression {
        let rt = &self.context.names.rt;
        let operand = |value: &Value| self.value(*value);
        match op {
            Op::Input(symbol) => {
                let name = ident(symbol);
                (quote!(#name), Strength::Atom)
            }
            Op::Constant(exact) => (Number::Double.exact(exact), Strength::Sign),
            Op::Call(function, a) => {
                let (name, a) = (format_ident!("{}", function.name()), operand(a).0);
                (quote!(#rt::Scalar::#name(#a)), Strength::Atom)
            }
            Op::Neg(a) => negative(operand(a)),
            Op::Add(a, b) => sum(operand(a), operand(b)),
            Op::Sub(a, b) => difference(operand(a), operand(b)),
            Op::Mul(a, b) => product(operand(a), operand(b)),
            Op::Div(a, b) => quotient(operand(a), operand(b)),
            Op::MulAdd(a, b, rest) => match &self.packed.program.steps[*a] {
                Op::Neg(inner) if !self.bound.contains_key(&Step::Scalar(*a)) => {
                    added_to_one(operand(rest), "minus_one", operand(inner), operand(b))
                }
                _ => added_to_one(operand(rest), "plus_one", operand(a), operand(b)),
            },
        }
    }

    fn vector(&self, index: Index) -> Expression {
        let operand = |index: Index| self.expression(Step::Vector(index));
        match self.packed.vectors[index].made {
            // Bound where it is read.
            Four::State(_) => (TokenStream::new(), Strength::Atom),
            Four::All(value) => {
                let value = self.value(value).0;
                (quote!(all(#value)), Strength::Atom)
            }
            Four::Gathered(lanes) => {
                let lanes = lanes.map(|lane| match lane {
                    Lane::Free => quote!(0.0),
                    Lane::MinusZero => quote!(-0.0),
                    Lane::Of(value) => self.value(value).0,
                    Lane::Minus(value) => negative(self.value(value)).0,
                });
                (quote!(four([#(#lanes),*])), Strength::Atom)
            }
            Four::Neg(a) => negative(operand(a)),
            Four::Add(a, b) => sum(operand(a), operand(b)),
            Four::Sub(a, b) => difference(operand(a), operand(b)),
            Four::Mul(a, b) => product(operand(a), operand(b)),
            Four::MulAdd(a, b, rest) => match self.packed.vectors[a].made {
                Four::Neg(inner) if !self.bound.contains_key(&Step::Vector(a)) => {
                    added(operand(rest), "minus", operand(inner), operand(b))
                }
                _ => added(operand(rest), "plus", operand(a), operand(b)),
            },
        }
    }

    fn at_least(&self, step: Step, least: Strength) -> TokenStream {
        at_least(self.expression(step), least)
    }
}

/// A sum and one product more, of vectors.
fn added(sum: Expression, method: &str, (a, _): Expression, (b, _): Expression) -> Expression {
    let (sum, method) = (at_least(sum, Strength::Atom), format_ident!("{method}"));
    (quote!(#sum.#method(#a, #b)), Strength::Atom)
}

/// The same of numbers, rounded as in a vector.
fn added_to_one((sum, _): Expression, function: &str, (a, _): Expression, (b, _): Expression) -> Expression {
    let function = format_ident!("{function}");
    (quote!(vectors.#function(#sum, #a, #b)), Strength::Atom)
}
