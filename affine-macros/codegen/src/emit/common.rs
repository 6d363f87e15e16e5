//! What several methods compute alike, in a function: a mass matrix is factorised in one place.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use crate::derive::Model;
use crate::ir::Program;
use crate::ir::common::Common;
use crate::symbol::{Quantity, Symbol};

use super::body::Body;
use super::names::Names;
use super::number::number;
use super::pattern::{entries, ident, leading_pattern, table};

/// The function that gives the velocity of a momentum, and after it the intermediate results that other methods go on with.
pub(super) struct Function {
    common: Common,
    /// The matrices that it reads, with their entries, row by row.
    matrices: Vec<(Ident, Vec<Vec<Symbol>>)>,
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
        let places = || (1..=model.dim).flat_map(|i| (1..=model.dim).map(move |j| [i, j]));
        let is_read = |matrix: &Quantity| {
            places().all(|place| common.program.symbols().any(|read| *read == matrix.at(place)))
        };
        let matrices = [Quantity::Placement, model.frame.momentum()]
            .into_iter()
            .filter(is_read)
            .map(|matrix| (ident(&matrix.into()), entries(matrix, model.dim)))
            .collect();
        Some(Self { common, matrices })
    }

    /// The call by a program, and what is left of it.
    pub(super) fn called_by(&self, program: &Program) -> Option<(TokenStream, Program)> {
        let rest = self.common.taken_from(program)?;
        let results: Vec<Symbol> = self.common.program.results().cloned().collect();
        let results = leading_pattern(&results, &rest.inputs());
        let numbers = self.numbers();
        let numbers = (!numbers.is_empty()).then(|| quote!([#(#numbers),*]));
        let arguments = self.matrices.iter().map(|(_, rows)| table(rows)).chain(numbers);
        Some((quote!(let #results = velocity_of_momentum(#(#arguments),*);), rest))
    }

    /// What it computes.
    pub(super) fn program(&self) -> &Program {
        &self.common.program
    }

    /// The function as an item, from its body.
    pub(super) fn item(&self, Body { lets, results }: &Body, names: &Names) -> TokenStream {
        let (rt, t, read) = (&names.rt, &names.scalar, self.numbers());
        let (count, given) = (number(read.len()), number(results.len()));
        let bound = self.matrices.iter().map(|(matrix, rows)| {
            let rows = table(rows);
            quote!(let #rows = #matrix;)
        });
        let matrices = self.matrices.iter().map(|(matrix, rows)| {
            let n = number(rows.len());
            quote!(#matrix: [[#t; #n]; #n])
        });
        let numbers = (!read.is_empty()).then(|| quote!([#(#read),*]: [#t; #count]));
        let parameters = matrices.chain(numbers);
        quote! {
            /// The velocity that belongs to a momentum, and after it the intermediate results that other methods go on with.
            // Its results stay in registers only inside of what reads them.
            #[inline(always)]
            fn velocity_of_momentum<#t: #rt::Scalar>(#(#parameters),*) -> [#t; #given] {
                #(#bound)*
                #lets
                [#(#results),*]
            }
        }
    }

    /// What it reads beside matrices.
    fn numbers(&self) -> Vec<Ident> {
        let entries: Vec<&Symbol> =
            self.matrices.iter().flat_map(|(_, rows)| rows.iter().flatten()).collect();
        self.common.program.symbols().filter(|symbol| !entries.contains(symbol)).map(ident).collect()
    }
}
