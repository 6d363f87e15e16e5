//! Calls of runtime functions: their arguments are values of the program, their results are inputs of it.

use crate::algebra::kernel::{Callee, Group};
use crate::symbol::Symbol;

/// A value: the index of the step that makes it.
pub type Value = usize;

/// A call. It happens before the first step that reads one of its results; every argument is an earlier step.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Call {
    /// The runtime function that is called.
    pub callee: Callee,
    /// The arguments: earlier values, in groups.
    pub arguments: Vec<Group<Value>>,
    /// The inputs that it provides.
    pub results: Vec<Group<Symbol>>,
}

impl Call {
    /// The place of the field that it asks, from 1, where it asks one.
    pub fn field(&self) -> Option<usize> {
        match self.callee {
            Callee::Custom(place, _) => Some(place),
            Callee::Stretches
            | Callee::LogStretches
            | Callee::Elongation
            | Callee::Turn
            | Callee::Fading
            | Callee::Ellipsoidal
            | Callee::EllipsoidalSlopes => None,
        }
    }

    /// Does it provide the input?
    pub fn provides(&self, input: &Symbol) -> bool {
        self.results.iter().any(|group| group.entries().contains(&input))
    }

    /// The values it reads.
    pub fn operands(&self) -> Vec<Value> {
        self.arguments.iter().flat_map(Group::entries).copied().collect()
    }

    /// The same call on renumbered values.
    pub fn renumbered(&self, place: &[Value]) -> Self {
        let arguments = self.arguments.iter().map(|group| group.map(|v| place[*v])).collect();
        Self { callee: self.callee, arguments, results: self.results.clone() }
    }
}
