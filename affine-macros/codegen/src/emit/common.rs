//! What several methods compute alike, in a function: a mass matrix is factorised in one place.

use proc_macro2::TokenStream;
use quote::quote;
use rustc_hash::FxHashMap;

use crate::derive::Model;
use crate::ir::common::Common;
use crate::ir::{Op, Program};
use crate::symbol::{Quantity, Symbol};

use super::body::Body;
use super::names::Names;
use super::number::number;
use super::pattern::{bound_entries, entries, leading_pattern, list, named, reads, table, together};

/// The function that gives the velocity of a momentum, and after it the intermediate results that other methods go on with.
pub(super) struct Function {
    common: Common,
    arguments: Handed,
    results: Handed,
}

/// The entries of a matrix, row by row.
type Rows = Vec<Vec<Symbol>>;

/// What it is given or gives back.
struct Handed {
    /// Matrices of which every entry is handed over, by their names.
    matrices: Vec<(Symbol, Rows)>,
    /// The numbers that are in none of them.
    numbers: Vec<Symbol>,
}

impl Handed {
    fn new(mut numbers: Vec<Symbol>, n: usize) -> Self {
        let mut matrices = Vec::new();
        let quantities: Vec<Quantity> = numbers.iter().filter_map(Symbol::quantity).collect();
        for of in quantities {
            let rows = entries(of, n);
            if rows.iter().flatten().all(|entry| numbers.contains(entry)) {
                numbers.retain(|symbol| !rows.iter().flatten().any(|entry| entry == symbol));
                matrices.push((of.into(), rows));
            }
        }
        Self { matrices, numbers }
    }

    /// Each matrix, and the numbers together where there are any.
    fn each(
        &self,
        matrix: impl Fn(&Symbol, &Rows) -> TokenStream,
        numbers: impl Fn(&[Symbol]) -> TokenStream,
    ) -> Vec<TokenStream> {
        let numbers = (!self.numbers.is_empty()).then(|| numbers(&self.numbers));
        self.matrices.iter().map(|(name, rows)| matrix(name, rows)).chain(numbers).collect()
    }
}

impl Function {
    /// That of a model, where energies or equations share much with the velocity.
    pub(super) fn of(model: &Model) -> Option<Self> {
        let energies = [
            Some(&model.point.hamiltonian),
            model.point.hamiltonian_far_away.as_ref(),
            model.point.power.as_ref(),
        ];
        let equations = [Some(&model.dynamics.full.program), Some(&model.dynamics.reduced.program)];
        let common = Common::of(&model.point.velocity, energies.into_iter().chain(equations).flatten())?;
        let arguments = Handed::new(common.program.inputs(), model.dim);
        let results = Handed::new(common.program.results().cloned().collect(), model.dim);
        Some(Self { common, arguments, results })
    }

    /// The call by a program, and what is left of that program. Matrices that the function is given are in variables of their
    /// names, as rows, or their entries are in variables of their own.
    pub(super) fn called_by(&self, program: &Program, in_rows: bool) -> Option<(TokenStream, Program)> {
        let mut rest = self.common.taken_from(program)?;
        let argument = |name: &Symbol, rows: &Rows| if in_rows { named(name) } else { table(rows) };
        let arguments = self.arguments.each(argument, list);
        // One of its matrices may be all that is asked for: its rows are one result.
        let outputs = rest.outputs.iter().map(|(_, value)| rest.steps[*value].clone());
        let outputs: Vec<Op> = outputs.collect();
        let is_all = |rows: &Rows| rows.iter().flatten().cloned().map(Op::Input).eq(outputs.iter().cloned());
        if in_rows && let Some((name, _)) = self.results.matrices.iter().find(|(_, rows)| is_all(rows)) {
            rest = Program { steps: vec![Op::Input(name.clone())], outputs: vec![(name.clone(), 0)], ..rest };
        }
        let used = rest.inputs();
        let is_read = |name: &Symbol, rows: &Rows| used.contains(name) || reads(&used, &rows.concat());
        let result = |name: &Symbol, rows: &Rows| if is_read(name, rows) { named(name) } else { quote!(_) };
        let results = together(&self.results.each(result, |numbers| leading_pattern(numbers, &used)));
        let entries = self.results.matrices.iter().map(|(name, rows)| bound_entries(name, rows, &used));
        Some((quote!(let #results = velocity_of_momentum(#(#arguments),*); #(#entries)*), rest))
    }

    /// What it computes.
    pub(super) fn program(&self) -> &Program {
        &self.common.program
    }

    /// Is it given this matrix as a whole?
    pub(super) fn takes(&self, of: Quantity) -> bool {
        self.arguments.matrices.iter().any(|(name, _)| *name == of.into())
    }

    /// What it is given beside matrices.
    pub(super) fn numbers(&self) -> &[Symbol] {
        &self.arguments.numbers
    }

    /// The function as an item, from its body.
    pub(super) fn item(&self, Body { lets, results }: &Body, names: &Names) -> TokenStream {
        let (rt, t) = (&names.rt, &names.scalar);
        let rows = |rows: &Rows| {
            let n = number(rows.len());
            quote!([[#t; #n]; #n])
        };
        let numbers = |numbers: &[Symbol]| {
            let count = number(numbers.len());
            quote!([#t; #count])
        };
        let parameter = |own: TokenStream, of: TokenStream| quote!(#own: #of);
        let parameters = self
            .arguments
            .each(|name, own| parameter(named(name), rows(own)), |own| parameter(list(own), numbers(own)));
        let given = together(&self.results.each(|_, own| rows(own), numbers));
        let used = self.program().inputs();
        let bound = self.arguments.matrices.iter().map(|(name, rows)| bound_entries(name, rows, &used));
        let values: FxHashMap<&Symbol, &TokenStream> = self.program().results().zip(results).collect();
        let list = |own: &[Symbol]| {
            let own = own.iter().filter_map(|symbol| values.get(symbol));
            quote!([#(#own),*])
        };
        let results = together(&self.results.each(
            |_, rows| {
                let rows = rows.iter().map(|row| list(row));
                quote!([#(#rows),*])
            },
            list,
        ));
        quote! {
            /// The velocity that belongs to a momentum, and after it the intermediate results that other methods go on with.
            // Its results stay in registers only inside of what reads them.
            #[inline(always)]
            fn velocity_of_momentum<#t: #rt::Scalar>(#(#parameters),*) -> #given {
                #(#bound)*
                #lets
                #results
            }
        }
    }
}
