//! The convolutions of one order: vectors of factors, loops over the orders before, the terms at both ends.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::super::number;
use super::Writer;
use crate::ir::taylor::{Factor, Pass, Place, Recurrence, Series, sums};

/// Sums that are formed in one loop: with four lanes each, twelve registers of the narrowest vector unit. Nine in one loop,
/// several accumulators to a sum, and the newest row behind the loop were all measured, and no faster: some of these
/// registers then live on the stack.
const SUMS_PER_LOOP: usize = 6;

impl Writer<'_> {
    /// The vectors of ready series, or the others: all lanes of a row that begin at `slot`.
    pub(super) fn vectors(&self, ready: bool) -> TokenStream {
        let t = &self.context.names.scalar;
        let is_ready =
            |series: &Option<Series>| series.is_none_or(|s| self.recurrence.ready[s.value] && !s.rate);
        let vectors =
            self.recurrence.row[..self.recurrence.vectors].chunks(self.recurrence.lanes).enumerate();
        vectors
            .filter(|(index, vector)| {
                !self.is_in_column(index * self.recurrence.lanes) && vector.iter().all(is_ready) == ready
            })
            .map(|(index, vector)| {
                let name = self.vector(index * self.recurrence.lanes);
                let entries = vector.iter().map(|series| match series {
                    Some(series) => self.current(*series),
                    None => quote!(#t::zero()),
                });
                quote!(let #name = [#(#entries),*];)
            })
            .collect()
    }

    pub(super) fn vector(&self, slot: usize) -> Ident {
        format_ident!("lanes_{}", slot / self.recurrence.lanes + 1)
    }

    /// Fills the row of order `k`.
    pub(super) fn stored(&self) -> TokenStream {
        let Recurrence { row, vectors, lanes, .. } = self.recurrence;
        if row.is_empty() {
            return TokenStream::new();
        }
        let rt = &self.context.names.rt;
        let columns = (0..*vectors).step_by(*lanes).map(|slot| {
            let (name, slot) = (self.vector(slot), number(slot));
            quote!(#rt::set_lanes(row, #slot, #name);)
        });
        let singles = row.iter().enumerate().skip(*vectors).filter_map(|(slot, series)| {
            let (slot, entry) = (number(slot), self.current((*series)?));
            Some(quote!(row[#slot] = #entry;))
        });
        quote!(#(#columns)* #(#singles)*)
    }

    /// The terms `j = 1..k` of all convolutions.
    pub(super) fn loops(&self) -> TokenStream {
        let t = &self.context.names.scalar;
        let lanes = number(self.recurrence.lanes);
        let all = [("full", &self.recurrence.full), ("inner", &self.recurrence.inner)];
        let sums: Vec<(&str, usize)> =
            all.iter().flat_map(|(stem, passes)| (0..sums(passes)).map(move |sum| (*stem, sum))).collect();
        let passes: Vec<(&str, &Pass)> =
            all.iter().flat_map(|(stem, passes)| passes.iter().map(move |pass| (*stem, pass))).collect();
        let blocks = sums.chunks(SUMS_PER_LOOP).map(|block| {
            let names = block.iter().map(|(stem, sum)| self.sum(stem, *sum));
            let own = passes.iter().filter(|(stem, pass)| block.contains(&(*stem, pass.sum)));
            let statements = own.map(|(stem, pass)| {
                let (left, right) = self.factors(pass, &quote!(left), &quote!(right));
                self.pass(stem, pass, &left, &right)
            });
            quote! {
                #(let mut #names = [#t::zero(); #lanes];)*
                for (left, right) in middle.iter().zip(middle.iter().rev()) {
                    #(#statements)*
                }
            }
        });
        blocks.collect()
    }

    /// The terms `j = 0` and `j = k` of a full convolution.
    pub(super) fn ends(&self, pass: &Pass) -> TokenStream {
        let (first_left, first_right) = self.factors(pass, &quote!(first), &quote!(first));
        let left = self.vector(pass.left);
        let right = match pass.right {
            Factor::Vector(slot) => {
                let right = self.vector(slot);
                quote!(#right)
            }
            Factor::Slot(slot) if self.is_in_column(slot) => {
                let (vector, lane) = (self.vector(slot), number(slot % self.recurrence.lanes));
                quote!(#vector[#lane])
            }
            Factor::Slot(slot) => {
                self.recurrence.row[slot].map(|series| self.current(series)).unwrap_or_default()
            }
        };
        let one = self.pass("full", pass, &first_left, &right);
        let other = self.pass("full", pass, &quote!(#left), &first_right);
        quote!(#one #other)
    }

    /// The factors of a multiplication from two rows.
    fn factors(&self, pass: &Pass, left: &TokenStream, right: &TokenStream) -> (TokenStream, TokenStream) {
        let rt = &self.context.names.rt;
        let vector = |row: &TokenStream, slot: usize| {
            let slot = number(slot);
            quote!(#rt::lanes(#row, #slot))
        };
        let right = match pass.right {
            Factor::Vector(slot) => vector(right, slot),
            Factor::Slot(slot) => {
                let slot = number(slot);
                quote!(#right[#slot])
            }
        };
        (vector(left, pass.left), right)
    }

    pub(super) fn sum(&self, stem: &str, sum: usize) -> Ident {
        format_ident!("{stem}_{}", sum + 1)
    }

    fn pass(&self, stem: &str, pass: &Pass, left: &TokenStream, right: &TokenStream) -> TokenStream {
        let rt = &self.context.names.rt;
        let sum = self.sum(stem, pass.sum);
        let name = match (pass.negative, pass.right) {
            (false, Factor::Vector(_)) => "add_products",
            (true, Factor::Vector(_)) => "subtract_products",
            (false, Factor::Slot(_)) => "add_multiple",
            (true, Factor::Slot(_)) => "subtract_multiple",
        };
        let function = format_ident!("{name}");
        quote!(#rt::#function(vectors, &mut #sum, #left, #right);)
    }

    /// A convolution that has been formed.
    pub(super) fn place(&self, place: Place) -> TokenStream {
        let sum = self.sum(if place.full { "full" } else { "inner" }, place.sum);
        let lane = number(place.lane);
        quote!(#sum[#lane])
    }
}
