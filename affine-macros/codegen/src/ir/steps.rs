//! The steps of a program under construction.

use rustc_hash::FxHashMap;

use super::{Op, Value};

/// Steps, each one once.
#[derive(Debug, Default)]
pub(super) struct Steps {
    pub(super) list: Vec<Op>,
    known: FxHashMap<Op, Value>,
}

impl Steps {
    /// These, before others are added.
    pub(super) fn of(list: Vec<Op>) -> Self {
        let mut known = FxHashMap::default();
        for (value, op) in list.iter().enumerate() {
            known.entry(op.clone()).or_insert(value);
        }
        Self { list, known }
    }

    /// The value of a step, which is added where it is not there yet.
    pub(super) fn step(&mut self, op: Op) -> Value {
        if let Some(&known) = self.known.get(&op) {
            return known;
        }
        let value = self.list.len();
        self.list.push(op.clone());
        self.known.insert(op, value);
        value
    }
}
