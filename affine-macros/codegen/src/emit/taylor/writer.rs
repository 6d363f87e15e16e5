//! The recurrence of a model on its way to code, and the names of its values.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use crate::emit::context::Context;
use crate::emit::pattern::{bound, ident};
use crate::emit::trajectory;
use crate::ir::taylor::{Recurrence, Series};
use crate::ir::{Program, Value};
use crate::symbol::Symbol;

/// The recurrence, written down piece by piece.
pub(super) struct Writer<'a> {
    pub(super) context: &'a Context<'a>,
    pub(super) recurrence: &'a Recurrence,
    /// Values that do not move and that rules read, with their expressions.
    pub(super) fixed: Vec<(Value, TokenStream)>,
}

impl Writer<'_> {
    pub(super) fn states(&self) -> Vec<Symbol> {
        self.context.model.dynamics.reduced.symbols()
    }

    /// The statement that binds the coefficients of the trajectory that a program reads, and the parameter.
    pub(super) fn constants(&self, program: &Program) -> (TokenStream, TokenStream) {
        trajectory::coefficients(self.context, &program.inputs())
    }

    /// A state vector's components that are read, bound to their names, and the parameter.
    pub(super) fn bind(&self, used: &[Symbol], from: &str) -> (TokenStream, Ident) {
        bound(&self.states(), used, from)
    }

    /// The program with other results.
    pub(super) fn with_results(&self, results: impl Iterator<Item = Value>) -> Program {
        let mut program = self.recurrence.program.clone();
        program.outputs = results.map(|v| (self.name(v), v)).collect();
        program.without_dead_steps()
    }

    /// What the derivation calls a value, or its place.
    pub(super) fn name(&self, value: Value) -> Symbol {
        self.recurrence.program.name(value)
    }

    pub(super) fn ident(&self, value: Value) -> Ident {
        ident(&self.name(value))
    }

    /// A series at order `k`.
    pub(super) fn current(&self, series: Series) -> TokenStream {
        let value = self.ident(series.value);
        if series.rate { quote!(#value * order) } else { quote!(#value) }
    }
}
