//! Names for values that the derivation has no word for: they say what is computed, `phi_11_phi_22`, or what for.

use rustc_hash::{FxHashMap, FxHashSet};

use crate::algebra::Rational;
use crate::symbol::Symbol;

use super::{Op, Program, Value};

/// A longer formula says less than what it is part of.
const LONGEST: usize = 30;
/// How far a formula is followed through values without a name.
const DEEPEST: usize = 2;

/// Gives names that nothing in a program has.
pub struct Namer<'p> {
    program: &'p Program,
    names: FxHashMap<Value, Symbol>,
    /// As they are written: different symbols may be written alike.
    taken: FxHashSet<String>,
    /// The named value that each value is first read for.
    purposes: Vec<Option<Value>>,
}

impl<'p> Namer<'p> {
    /// For values of a program.
    pub fn new(program: &'p Program) -> Self {
        Self::of(program, &program.names)
    }

    /// For values of a program of whose names these mean something.
    fn of<'n>(program: &'p Program, names: impl IntoIterator<Item = &'n (Value, Symbol)>) -> Self {
        let outputs = program.outputs.iter().map(|(name, v)| (*v, name.clone()));
        let mut known: FxHashMap<Value, Symbol> = outputs.collect();
        known.extend(names.into_iter().cloned());
        let taken = known.values().chain(program.symbols()).map(Symbol::to_string).collect();
        let mut purposes = vec![None; program.steps.len()];
        for (v, step) in program.steps.iter().enumerate().rev() {
            let purpose = if known.contains_key(&v) { Some(v) } else { purposes[v] };
            step.operands().into_iter().for_each(|operand| purposes[operand] = purpose);
        }
        Self { program, names: known, taken, purposes }
    }

    /// A name for a value: its formula where that is short, else what it is a part of.
    pub fn name(&mut self, value: Value) -> Symbol {
        let formula = self.formula(value, DEEPEST);
        let whole = match self.purposes[value].and_then(|purpose| self.names.get(&purpose)) {
            Some(Symbol::Part(whole, _)) => whole.clone(),
            whole => whole.cloned().map(Box::new),
        };
        let name = |k: usize| match (&formula, k) {
            (Some(formula), 1) => formula.clone(),
            (Some(formula), _) => Symbol::Formula(format!("{formula}_{k}"), None),
            (None, _) => Symbol::Part(whole.clone(), k),
        };
        let free = (1..).map(name).find(|name| self.taken.insert(name.to_string()));
        let name = free.unwrap_or(Symbol::Step(value));
        self.names.insert(value, name.clone());
        name
    }

    /// The symbol of a value that has one.
    fn symbol(&self, value: Value) -> Option<&Symbol> {
        match &self.program.steps[value] {
            // What fields are called changes nothing but the places where they stand.
            Op::Input(symbol) => Some(symbol).filter(|symbol| !symbol.is_parameter()),
            _ => self.names.get(&value),
        }
    }

    /// What a value is called as an operand.
    fn operand(&self, value: Value, depth: usize) -> Option<Symbol> {
        match (&self.program.steps[value], self.symbol(value)) {
            (Op::Constant(number), _) => Some(Symbol::Formula(of_number(number)?, None)),
            (_, Some(symbol)) => Some(symbol.clone()),
            (Op::Input(_), None) => None,
            _ => self.formula(value, depth.checked_sub(1)?),
        }
    }

    /// The formula of a value as a name, unless it is long.
    fn formula(&self, value: Value, depth: usize) -> Option<Symbol> {
        let steps = &self.program.steps;
        let of = |value: Value| self.operand(value, depth);
        let is_number = |value: Value| matches!(steps[value], Op::Constant(_));
        let is_one = |value: Value| steps[value] == Op::Constant(Rational::ONE);
        let (first, last) = match steps[value] {
            Op::Mul(a, b) if a == b => return short(Symbol::Formula(format!("{}_squared", of(a)?), None)),
            Op::Mul(a, b) if is_number(b) => (of(b)?.to_string(), of(a)),
            Op::Mul(a, b) => (of(a)?.to_string(), of(b)),
            Op::Add(a, b) => match self.trace(a, b).or_else(|| self.trace(b, a)) {
                Some(whole) => ("trace".to_owned(), Some(whole)),
                None => (format!("{}_plus", of(a)?), of(b)),
            },
            Op::Sub(a, b) => (format!("{}_minus", of(a)?), of(b)),
            Op::Div(a, b) if is_one(a) => ("inverse".to_owned(), of(b)),
            Op::Div(a, b) => (format!("{}_over", of(a)?), of(b)),
            Op::Neg(a) => ("minus".to_owned(), of(a)),
            Op::Call(function, a) => (function.name().to_owned(), of(a)),
            Op::Input(_) | Op::Constant(_) | Op::MulAdd(..) => return None,
        };
        short(Symbol::Formula(first, Some(Box::new(last?))))
    }

    /// `x` where it is the sum of `x_11`, `x_22` and `x_33`, in any order.
    fn trace(&self, inner: Value, last: Value) -> Option<Symbol> {
        let Op::Add(first, second) = self.program.steps[inner] else { return None };
        if self.names.contains_key(&inner) {
            return None;
        }
        let entries: Vec<&Symbol> =
            [first, second, last].into_iter().map(|v| self.symbol(v)).collect::<Option<_>>()?;
        let whole = entries[0].with_indices(&[]);
        let has = |k: usize| entries.iter().any(|entry| **entry == whole.with_indices(&[k, k]));
        (entries[0] != &whole && (1..=3).all(has)).then_some(whole)
    }
}

impl Program {
    /// With names of this kind in place of some that say nothing.
    pub fn named_by_formulas(mut self, nameless: &FxHashSet<Symbol>) -> Self {
        let is_kept = |(_, name): &&(Value, Symbol)| !nameless.contains(name);
        let mut namer = Namer::of(&self, self.names.iter().filter(is_kept));
        let mut named = self.names.clone();
        named.sort_by_key(|(value, _)| *value);
        for (value, name) in named.iter_mut().filter(|(_, name)| nameless.contains(name)) {
            *name = namer.name(*value);
        }
        self.names = named;
        self
    }
}

/// A name unless it is long.
fn short(name: Symbol) -> Option<Symbol> {
    (name.to_string().len() <= LONGEST).then_some(name)
}

/// The name of an exact number; none where it is long.
pub fn of_number(number: &Rational) -> Option<String> {
    (!number.is_long()).then(|| format!("r{}", digits(number)))
}

/// An exact number as a part of a name.
pub fn digits(number: &Rational) -> String {
    number.to_string().replace('/', "_").replace('-', "m")
}
