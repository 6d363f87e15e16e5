//! Columns of the state that go from order to order as vectors.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::writer::Writer;
use crate::emit::number::number;
use crate::symbol::Symbol;

impl Writer<'_> {
    /// The type of the columns, and how they are taken from a coefficient.
    pub(super) fn columns(&self) -> TokenStream {
        let (rt, t) = (&self.context.names.rt, &self.context.names.scalar);
        let (lanes, count) = (number(self.recurrence.lanes), number(self.recurrence.columns.len()));
        let used: Vec<Symbol> = (0..self.recurrence.vectors)
            .filter(|slot| self.is_in_column(*slot))
            .filter_map(|slot| Some(self.name(self.recurrence.row[slot]?.value)))
            .collect();
        let (bind, coefficient) = self.bind(&used, "coefficient");
        let vectors = self.recurrence.columns.iter().map(|column| {
            let entries = self.recurrence.row[column.slot..][..self.recurrence.lanes].iter().map(|series| {
                series.map_or(quote!(#t::zero()), |series| {
                    let name = self.ident(series.value);
                    quote!(#name)
                })
            });
            quote!([#(#entries),*])
        });
        quote! {
            type Columns<#t: #rt::Scalar> = [[#t; #lanes]; #count];
            #[inline(always)]
            fn columns<#t: #rt::Scalar>(#coefficient: &Self::Reduced<#t>) -> Self::Columns<#t> {
                #bind
                [#(#vectors),*]
            }
        }
    }

    /// Does a slot belong to a column?
    pub(super) fn is_in_column(&self, slot: usize) -> bool {
        self.recurrence
            .columns
            .iter()
            .any(|column| (column.slot..column.slot + self.recurrence.lanes).contains(&slot))
    }

    /// The columns of a state that are all zero.
    pub(super) fn no_columns(&self) -> TokenStream {
        let t = &self.context.names.scalar;
        let lanes = number(self.recurrence.lanes);
        let zeros = self.recurrence.columns.iter().map(|_| quote!([#t::zero(); #lanes]));
        quote!([#(#zeros),*])
    }

    /// The next coefficients of the columns, as a result and as statements.
    pub(super) fn advanced_columns(&self) -> (TokenStream, TokenStream) {
        let rt = &self.context.names.rt;
        let columns = &self.recurrence.columns;
        let next: Vec<Ident> = (1..=columns.len()).map(next_column).collect();
        let sums = columns.iter().map(|column| self.sum("full", column.sum));
        let advanced = quote!(#(let #next = #rt::divided(vectors, #sums, divisor);)*);
        (quote!([#(#next),*]), advanced)
    }

    /// The next coefficient of a state that stands in a column.
    pub(super) fn column_entry(&self, state: &Symbol) -> Option<TokenStream> {
        let lanes = self.recurrence.lanes;
        let slot = (0..self.recurrence.vectors).find(|slot| {
            self.is_in_column(*slot)
                && self.recurrence.row[*slot].is_some_and(|s| self.name(s.value) == *state)
        })?;
        let column = self.recurrence.columns.iter().position(|column| column.slot == slot / lanes * lanes)?;
        let (name, lane) = (next_column(column + 1), number(slot % lanes));
        Some(quote!(#name[#lane]))
    }
}

fn next_column(number: usize) -> Ident {
    format_ident!("column_{number}")
}
