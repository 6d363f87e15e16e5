//! Names for values that the derivation has no word for: they say what is computed, `phi_11_phi_22`, or what for.

use rustc_hash::{FxHashMap, FxHashSet};

use crate::algebra::Rational;

use super::{Op, Program, Value};

/// A longer formula says less than what it is part of.
const LONGEST: usize = 30;
/// How names begin that say what for.
const PART: &str = "part";
/// How far a formula is followed through values without a name.
const DEEPEST: usize = 2;

/// Gives names that nothing in a program has.
pub struct Namer<'p> {
    program: &'p Program,
    names: FxHashMap<Value, String>,
    taken: FxHashSet<String>,
    /// The named value that each value is first read for.
    purposes: Vec<Option<Value>>,
}

impl<'p> Namer<'p> {
    /// For values of a program.
    #[must_use]
    pub fn new(program: &'p Program) -> Self {
        Self::of(program, &program.names)
    }

    /// For values of a program of whose names these mean something.
    fn of<'n>(program: &'p Program, names: impl IntoIterator<Item = &'n (Value, String)>) -> Self {
        let outputs = program.outputs.iter().map(|(name, v)| (*v, name.clone()));
        let mut known: FxHashMap<Value, String> = outputs.collect();
        known.extend(names.into_iter().cloned());
        let taken = known.values().cloned().chain(program.inputs()).collect();
        let mut purposes = vec![None; program.steps.len()];
        for (v, step) in program.steps.iter().enumerate().rev() {
            let purpose = if known.contains_key(&v) { Some(v) } else { purposes[v] };
            step.operands().into_iter().for_each(|operand| purposes[operand] = purpose);
        }
        Self { program, names: known, taken, purposes }
    }

    /// A name for a value: its formula where that is short, else what it is a part of.
    pub fn name(&mut self, value: Value) -> String {
        let stem = self.formula(value, DEEPEST).unwrap_or_else(|| {
            let purpose = self.purposes[value].and_then(|purpose| self.names.get(&purpose));
            match purpose {
                Some(part) if part.starts_with(PART) => part.clone(),
                Some(whole) => format!("{PART}_of_{whole}"),
                None => PART.to_owned(),
            }
        });
        let numbered = (2..).map(|k| format!("{stem}_{k}"));
        let free = std::iter::once(stem.clone()).chain(numbered).find(|name| !self.taken.contains(name));
        let name = free.unwrap_or(stem);
        self.taken.insert(name.clone());
        self.names.insert(value, name.clone());
        name
    }

    /// What a value is called as an operand.
    fn operand(&self, value: Value, depth: usize) -> Option<String> {
        match (&self.program.steps[value], self.names.get(&value)) {
            // What fields are called changes nothing but the places where they stand.
            (Op::Input(symbol), _) => (!symbol.is_parameter()).then(|| symbol.to_string()),
            (Op::Constant(number), _) => of_number(number),
            (_, Some(name)) => Some(name.clone()),
            _ => self.formula(value, depth.checked_sub(1)?),
        }
    }

    /// The formula of a value as a name, unless it is long.
    fn formula(&self, value: Value, depth: usize) -> Option<String> {
        let steps = &self.program.steps;
        let of = |value: Value| self.operand(value, depth);
        let is_number = |value: Value| matches!(steps[value], Op::Constant(_));
        let is_one = |value: Value| steps[value] == Op::Constant(Rational::ONE);
        let name = match steps[value] {
            Op::Mul(a, b) if a == b => format!("{}_squared", of(a)?),
            Op::Mul(a, b) if is_number(b) => format!("{}_{}", of(b)?, of(a)?),
            Op::Mul(a, b) => format!("{}_{}", of(a)?, of(b)?),
            Op::Add(a, b) => match self.trace(a, b).or_else(|| self.trace(b, a)) {
                Some(trace) => trace,
                None => format!("{}_plus_{}", of(a)?, of(b)?),
            },
            Op::Sub(a, b) => format!("{}_minus_{}", of(a)?, of(b)?),
            Op::Div(a, b) if is_one(a) => format!("inverse_{}", of(b)?),
            Op::Div(a, b) => format!("{}_over_{}", of(a)?, of(b)?),
            Op::Neg(a) => format!("minus_{}", of(a)?),
            Op::Call(function, a) => format!("{}_{}", function.name(), of(a)?),
            Op::Input(_) | Op::Constant(_) | Op::MulAdd(..) => return None,
        };
        (name.len() <= LONGEST).then_some(name)
    }

    /// The sum of `x_11`, `x_22` and `x_33`, in any order.
    fn trace(&self, inner: Value, last: Value) -> Option<String> {
        let Op::Add(first, second) = self.program.steps[inner] else { return None };
        let names: Option<Vec<String>> =
            [first, second, last].into_iter().map(|v| self.operand(v, 0)).collect();
        let mut names = names.filter(|_| !self.names.contains_key(&inner))?;
        names.sort_unstable();
        let stem = names[0].strip_suffix("_11")?;
        let is_trace = names[1] == format!("{stem}_22") && names[2] == format!("{stem}_33");
        is_trace.then(|| format!("trace_{stem}"))
    }
}

impl Program {
    /// With names of this kind in place of some that say nothing.
    #[must_use]
    pub fn named_by_formulas(mut self, nameless: &FxHashSet<String>) -> Self {
        let is_kept = |(_, name): &&(Value, String)| !nameless.contains(name);
        let mut namer = Namer::of(&self, self.names.iter().filter(is_kept));
        let mut named: Vec<(Value, String)> = self.names.clone();
        named.sort_unstable();
        for (value, name) in named.iter_mut().filter(|(_, name)| nameless.contains(name)) {
            *name = namer.name(*value);
        }
        self.names = named;
        self
    }
}

/// The name of an exact number; none where it is long.
#[must_use]
pub fn of_number(number: &Rational) -> Option<String> {
    (!number.is_long()).then(|| format!("r{}", number.to_string().replace('/', "_").replace('-', "m")))
}
