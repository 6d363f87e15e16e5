//! What several programs compute alike, as a program of its own that they call.

use rustc_hash::{FxHashMap, FxHashSet};

use crate::symbol::Symbol;

use super::{Op, Program, Value};

/// A program is worth a call where that takes so much out of it, by weight.
const LEAST: usize = 100;

/// The steps of a program that others have too.
#[derive(Clone, Debug)]
pub struct Common {
    /// Their results: those of the program, and what the others go on with.
    pub program: Program,
}

impl Common {
    /// What `others` share with `base`; `None` where none of them shares much.
    pub fn of<'p>(base: &Program, others: impl IntoIterator<Item = &'p Program>) -> Option<Self> {
        if base.operations().weight() < LEAST {
            return None;
        }
        let own = Alike::new(base, base).results();
        let read: Vec<Vec<Value>> = others
            .into_iter()
            .map(|other| Alike::new(base, other))
            .filter(|alike| alike.saved() >= LEAST)
            .map(|alike| alike.results())
            .collect();
        if read.is_empty() {
            return None;
        }
        let mut results = own;
        let mut rest: Vec<Value> = read.concat().into_iter().filter(|v| !results.contains(v)).collect();
        rest.sort_unstable();
        rest.dedup();
        results.extend(rest);
        let name = |k: usize, v: Value| base.own_name(v).cloned().unwrap_or(Symbol::Part(None, k));
        let named = results.iter().enumerate().map(|(k, v)| (name(k, *v), *v));
        let program = Program { outputs: named.collect(), ..base.clone() };
        Some(Self { program: program.without_dead_steps() })
    }

    /// The program with the common results as inputs; `None` where it has too little in common, or computes on with something
    /// that is no result.
    pub fn taken_from(&self, program: &Program) -> Option<Program> {
        let alike = Alike::new(&self.program, program);
        let results: FxHashMap<Value, &Symbol> =
            self.program.outputs.iter().map(|(name, v)| (*v, name)).collect();
        let inputs = program.inputs();
        let is_fit = alike.saved() >= LEAST
            && alike.results().iter().all(|v| results.contains_key(v))
            && self.program.inputs().iter().all(|input| inputs.contains(input));
        is_fit.then(|| alike.rest(&results))
    }
}

/// A program beside one that may have computed some of its steps.
struct Alike<'p> {
    program: &'p Program,
    /// The value of the other program that equals a step.
    equal: Vec<Option<Value>>,
    /// The steps that the program computes itself.
    kept: Vec<bool>,
    /// The steps that it takes over, because a step that it keeps reads them.
    taken: Vec<Value>,
}

impl<'p> Alike<'p> {
    fn new(base: &Program, program: &'p Program) -> Self {
        let mut known: FxHashMap<Op, Value> = FxHashMap::default();
        places(base, |op, v| Some(*known.entry(op).or_insert(v)));
        let equal = places(program, |op, _| known.get(&op).copied());
        let mut alike = Self { program, equal, kept: vec![false; program.steps.len()], taken: Vec::new() };
        program.outputs.iter().for_each(|(_, v)| alike.read(*v));
        alike
    }

    fn read(&mut self, value: Value) {
        let step = &self.program.steps[value];
        let is_work = match step {
            Op::Input(_) | Op::Constant(_) => false,
            Op::Neg(_) => self.program.own_name(value).is_some(),
            _ => true,
        };
        if is_work && self.equal[value].is_some() {
            if !self.taken.contains(&value) {
                self.taken.push(value);
            }
        } else if !self.kept[value] {
            self.kept[value] = true;
            step.operands().into_iter().for_each(|v| self.read(v));
            let call = self.program.call_before(value);
            call.into_iter().flat_map(|call| call.operands()).for_each(|v| self.read(v));
        }
    }

    /// The values of the other program that this one goes on with.
    fn results(&self) -> Vec<Value> {
        self.taken.iter().filter_map(|v| self.equal[*v]).collect()
    }

    /// The weight of what is not computed again.
    fn saved(&self) -> usize {
        let all = self.program.operations().weight();
        let kept = |v: &Value| self.kept[*v];
        let steps = (0..self.program.steps.len()).filter(kept).map(|v| self.program.steps[v].clone());
        let rest =
            Program { steps: steps.collect(), calls: self.program.calls.clone(), ..Program::default() };
        all.saturating_sub(rest.operations().weight())
    }

    /// What is left of the program, with inputs of these names.
    fn rest(&self, results: &FxHashMap<Value, &Symbol>) -> Program {
        let mut program = self.program.clone();
        for v in &self.taken {
            if let Some(name) = self.equal[*v].and_then(|equal| results.get(&equal)) {
                program.steps[*v] = Op::Input((*name).clone());
            }
        }
        let inputs: FxHashSet<&Symbol> = results.values().copied().collect();
        // A name stands for one thing; steps without one are named by their number.
        program.names.retain(|(_, name)| !inputs.contains(name));
        program.without_dead_steps()
    }
}

/// What each step is among known operations on what its operands are; nothing for what a call provides.
fn places(program: &Program, mut find: impl FnMut(Op, Value) -> Option<Value>) -> Vec<Option<Value>> {
    let mut found: Vec<Option<Value>> = Vec::new();
    let mut places: Vec<Value> = Vec::new();
    for (v, step) in program.steps.iter().enumerate() {
        let is_known =
            program.call_before(v).is_none() && step.operands().into_iter().all(|v| found[v].is_some());
        let place = is_known.then(|| find(ordered(step.renumbered(&places)), v)).flatten();
        found.push(place);
        places.push(place.unwrap_or_default());
    }
    found
}

/// The operation with its operands in their order where that makes no difference.
fn ordered(op: Op) -> Op {
    match op {
        Op::Add(a, b) => Op::Add(a.min(b), a.max(b)),
        Op::Mul(a, b) => Op::Mul(a.min(b), a.max(b)),
        Op::MulAdd(a, b, c) => Op::MulAdd(a.min(b), a.max(b), c),
        op => op,
    }
}
