//! The convolutions of one order: vectors of factors, loops over the orders before, the terms at both ends.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::super::number;
use super::Writer;
use crate::ir::taylor::{Factor, Pass, Place, Recurrence, Series, sums};

/// Sums that are formed in one loop.
const SUMS_PER_LOOP: usize = 9;

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

    /// The terms `0 < j < k` of all convolutions, in pairs `j` and `k - j`. The pair that has the newest row comes last: no
    /// other waits for it.
    pub(super) fn loops(&self) -> TokenStream {
        let (rt, t) = (&self.context.names.rt, &self.context.names.scalar);
        let lanes = number(self.recurrence.lanes);
        let all = [("full", &self.recurrence.full), ("inner", &self.recurrence.inner)];
        let sums: Vec<(&str, usize)> =
            all.iter().flat_map(|(stem, passes)| (0..sums(passes)).map(move |sum| (*stem, sum))).collect();
        let passes: Vec<(&str, &Pass)> =
            all.iter().flat_map(|(stem, passes)| passes.iter().map(move |pass| (*stem, pass))).collect();
        let blocks = sums.chunks(SUMS_PER_LOOP).map(|block| {
            let names = block.iter().map(|(stem, sum)| self.sum(stem, *sum));
            let own = || passes.iter().filter(|(stem, pass)| block.contains(&(*stem, pass.sum)));
            let centres = own().map(|(stem, pass)| self.centre(stem, pass));
            let pairs = own().map(|(stem, pass)| {
                let [left, right] = [quote!(left), quote!(right)].map(|row| self.factors(pass, &row));
                self.pair(stem, pass, left, right)
            });
            quote! {
                #(let mut #names = [#t::zero(); #lanes];)*
                if let ::core::option::Option::Some(centre) = centre {
                    #(#centres)*
                }
                for (left, right) in low.iter().rev().zip(high) {
                    #(#pairs)*
                }
            }
        });
        let halves = (!sums.is_empty()).then(|| quote!(let (low, centre, high) = #rt::halves(middle);));
        let doubled = self.doubled("inner", &self.recurrence.inner);
        quote!(#halves #(#blocks)* #doubled)
    }

    /// The terms `j = 0` and `j = k` of the full convolutions.
    pub(super) fn ends(&self) -> TokenStream {
        let ends = self.recurrence.full.iter().map(|pass| {
            let left = self.vector(pass.left);
            let right = match pass.right {
                Factor::Vector(slot) => {
                    let right = self.vector(slot);
                    quote!(#right)
                }
                Factor::Slot(slot) => {
                    let entry = self.newest(slot);
                    self.in_all_lanes(&entry)
                }
            };
            self.pair("full", pass, self.factors(pass, &quote!(first)), [quote!(#left), right])
        });
        let doubled = self.doubled("full", &self.recurrence.full);
        quote!(#(#ends)* #doubled)
    }

    /// What a slot holds at order `k`.
    fn newest(&self, slot: usize) -> TokenStream {
        if self.is_in_column(slot) {
            let (vector, lane) = (self.vector(slot), number(slot % self.recurrence.lanes));
            return quote!(#vector[#lane]);
        }
        self.recurrence.row[slot].map(|series| self.current(series)).unwrap_or_default()
    }

    /// The factors of a multiplication, both from one row.
    fn factors(&self, pass: &Pass, row: &TokenStream) -> [TokenStream; 2] {
        let rt = &self.context.names.rt;
        let vector = |slot: usize| {
            let slot = number(slot);
            quote!(#rt::lanes(#row, #slot))
        };
        let right = match pass.right {
            Factor::Vector(slot) => vector(slot),
            Factor::Slot(slot) => {
                let slot = number(slot);
                self.in_all_lanes(&quote!(#row[#slot]))
            }
        };
        [vector(pass.left), right]
    }

    fn in_all_lanes(&self, entry: &TokenStream) -> TokenStream {
        let lanes = number(self.recurrence.lanes);
        quote!([#entry; #lanes])
    }

    /// The terms `j` and `k - j` from the factors of two rows; of a square, one of two that are equal.
    fn pair(&self, stem: &str, pass: &Pass, one: [TokenStream; 2], other: [TokenStream; 2]) -> TokenStream {
        let rt = &self.context.names.rt;
        let (sum, [a, b], [c, d]) = (self.sum(stem, pass.sum), one, other);
        if pass.is_square() {
            return self.product(pass, &sum, &a, &c);
        }
        let function = if pass.negative { quote!(subtract_pair) } else { quote!(add_pair) };
        quote!(#rt::#function(vectors, &mut #sum, [#a, #d], [#c, #b]);)
    }

    /// The term `j = k/2`; of a square, half of it.
    fn centre(&self, stem: &str, pass: &Pass) -> TokenStream {
        let rt = &self.context.names.rt;
        let [left, right] = self.factors(pass, &quote!(centre));
        let left = if pass.is_square() { quote!(#rt::halved(vectors, #left)) } else { left };
        self.product(pass, &self.sum(stem, pass.sum), &left, &right)
    }

    fn product(&self, pass: &Pass, sum: &Ident, left: &TokenStream, right: &TokenStream) -> TokenStream {
        let rt = &self.context.names.rt;
        let function = if pass.negative { quote!(subtract_products) } else { quote!(add_products) };
        quote!(#rt::#function(vectors, &mut #sum, #left, #right);)
    }

    /// Squares from their halves.
    fn doubled(&self, stem: &str, passes: &[Pass]) -> TokenStream {
        let rt = &self.context.names.rt;
        let mut squares: Vec<usize> = passes.iter().filter(|p| p.is_square()).map(|p| p.sum).collect();
        squares.dedup();
        let squares = squares.into_iter().map(|sum| self.sum(stem, sum));
        quote!(#(let #squares = #rt::doubled(vectors, #squares);)*)
    }

    pub(super) fn sum(&self, stem: &str, sum: usize) -> Ident {
        format_ident!("{stem}_{}", sum + 1)
    }

    /// A convolution that has been formed.
    pub(super) fn place(&self, place: Place) -> TokenStream {
        let sum = self.sum(if place.full { "full" } else { "inner" }, place.sum);
        let lane = number(place.lane);
        quote!(#sum[#lane])
    }
}
